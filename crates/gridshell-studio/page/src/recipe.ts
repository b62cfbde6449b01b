// What grid is wanted: on which parts, by which recipe, about how large; and the wish for it.
import { Choosing } from "./choosing";
import { el, figure } from "./dom";
import { Form } from "./form";
import type { Link } from "./link";
import type { Store } from "./store";
import type { Views } from "./views";

/** The estimate waits until nothing has been typed for so long, milliseconds. */
const PAUSE = 150;

export class Recipe {
  readonly form = new Form();
  readonly choosing = new Choosing();
  readonly estimate = el("p", { class: "estimate" }, ["–"]);
  readonly generate = el("button", { type: "button", class: "primary", id: "generate" }, ["Generate"]);
  /** The grid whose recipe the form began with. */
  private of = 0;
  private estimating: ReturnType<typeof setTimeout> | undefined;

  constructor(
    private readonly store: Store,
    private readonly link: Link,
    views: Views,
  ) {
    const { form, choosing, estimate, generate } = this;
    link.on("hello", (hello) => form.build(hello.form));
    link.on("surface", (surface) => {
      choosing.show(surface);
      form.parts(surface.parts.map((p) => p.name));
      if (surface.parts.length) form.set("part", "all");
      this.ask();
    });
    link.on("recipe", (event) => {
      form.file();
      // The same again after a broken connection: what was typed since then stays.
      if (event.run !== this.of) form.apply(event.values);
      choosing.chosen(form.get("part"));
      this.of = event.run;
      this.ask();
    });
    link.on("estimate", ({ nodes, edge_length }) => {
      estimate.textContent = `about ${nodes.toLocaleString("en")} nodes, members of ${figure(edge_length)} m`;
      form.suggest("edge_length", figure(edge_length));
      form.suggest("nodes", `about ${nodes}`);
    });
    form.onChange = () => {
      choosing.chosen(form.get("part"));
      this.ask();
    };
    choosing.onPart = (part) => {
      form.set("part", part);
      this.ask();
    };
    choosing.onPoint = (part) => views.first.pointAt(part);
    choosing.onChoose = (layers, objects) => {
      this.anew();
      link.send({ kind: "choose", layers, objects });
    };
    generate.onclick = () => this.start();
    store.on("going", (going) => (generate.disabled = going !== null));
  }

  /** Another surface: its own recipe, and an edge length that suits it. */
  anew(): void {
    this.form.set("edge_length", "");
    this.form.noFile();
    this.of = 0;
  }

  start(): void {
    if (this.store.now.going) return;
    this.store.set("began", performance.now());
    this.store.set("following", true);
    this.link.send({ kind: "generate", values: this.form.values() });
  }

  private ask(): void {
    clearTimeout(this.estimating);
    const values = () => this.form.values();
    this.estimating = setTimeout(() => this.link.send({ kind: "estimate", values: values() }), PAUSE);
  }
}
