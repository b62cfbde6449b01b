// Two runs side by side: which one the view beside shows.
import { el, toggle } from "./dom";
import type { Link } from "./link";
import { title } from "./runs";
import type { Store } from "./store";
import type { Views } from "./views";

export class Comparing {
  readonly toggle = toggle("Compare", "Two runs side by side", "compare", (on) => this.compare(on));
  private readonly select = el("select", { class: "other", "aria-label": "Run to compare with" });

  constructor(
    private readonly store: Store,
    private readonly link: Link,
    private readonly views: Views,
  ) {
    const { select } = this;
    views.beside.append(select);
    select.onchange = () => this.with(Number(select.value));
    store.on("runs", (runs) => {
      const { beside } = store.now;
      const options = runs.map((r) => el("option", { value: r.run, selected: r.run === beside }, [title(r)]));
      select.replaceChildren(...options);
    });
  }

  private compare(on: boolean): void {
    if (!on) {
      this.views.close();
      this.store.set("beside", 0);
      return;
    }
    this.views.open();
    const { runs, shown } = this.store.now;
    const other = runs.filter((r) => r.run !== shown).at(-1) ?? runs.at(-1);
    if (other) this.with(other.run);
  }

  private with(run: number): void {
    this.select.value = String(run);
    this.link.send({ kind: "look", run, stage: null });
    this.store.set("beside", run);
  }
}
