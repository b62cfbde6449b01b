// What the grids are colored by, and the legend.
import { el } from "./dom";
import type { Frame, Link } from "./link";
import type { Scale } from "./messages";
import { bands } from "./palette";
import type { Store } from "./store";
import type { Views } from "./views";

export class Coloring {
  readonly select = el("select", { "aria-label": "Color by", id: "color" }, [
    el("option", { value: "" }, ["No color"]),
  ]);
  readonly legend = el("div", { class: "legend", hidden: true });

  constructor(
    private readonly store: Store,
    private readonly link: Link,
    private readonly views: Views,
  ) {
    const { select, legend } = this;
    link.on("hello", ({ colorings }) => {
      if (select.options.length > 1) return;
      select.append(...colorings.map((c) => el("option", { value: c.name, title: c.help }, [c.label])));
    });
    select.onchange = () => this.choose();
    store.on("beside", (run) => this.ask(run));
    link.onFrame("grid", ({ run }) => {
      if (run !== store.now.shown) return;
      if (select.value) this.ask(run);
      else legend.hidden = true;
    });
    link.onFrame("colors", (frame) => this.show(frame));
  }

  private choose(): void {
    const { shown, beside } = this.store.now;
    if (this.select.value && shown) {
      this.ask(shown);
      this.ask(beside);
      return;
    }
    this.legend.hidden = true;
    for (const view of this.views.all) {
      view.grid.plain();
      view.redraw();
    }
  }

  private ask(run: number): void {
    const by = this.select.value;
    if (run && by) this.link.send({ kind: "color", run, by });
  }

  private show(frame: Frame): void {
    const { first, second } = this.views;
    const { shown, beside } = this.store.now;
    if (frame.run === beside) {
      second?.grid.color(frame);
      second?.redraw();
    }
    if (frame.run !== shown || frame.scale?.by !== this.select.value) return;
    first.grid.color(frame);
    first.redraw();
    this.explain(frame.scale);
  }

  private explain(scale: Scale): void {
    this.legend.replaceChildren(
      el("b", {}, [scale.title]),
      el("div", { class: "bar", style: `background:${bands(scale)}` }),
      el(
        "div",
        { class: "ends" },
        scale.labels.map((label) => el("span", {}, [label.text])),
      ),
      scale.note && el("small", {}, [scale.note]),
      scale.all_nodes
        ? ""
        : el("div", { class: "odd" }, [
            el("i", { class: "black" }),
            "too few members",
            el("i", { class: "white" }),
            "too many",
          ]),
    );
    this.legend.hidden = false;
  }
}
