// The distance between two points of the grid that are clicked.
import { toggle } from "./dom";
import type { Link } from "./link";
import { type Point, pointed } from "./pointing";
import type { Store } from "./store";
import type { Say } from "./toast";

export class Measuring {
  readonly toggle = toggle("Distance", "Measure between two points (M)", "measure", (on) => this.measure(on));
  private on = false;
  private from: Point | null = null;

  constructor(
    private readonly store: Store,
    private readonly link: Link,
    private readonly say: Say,
  ) {
    link.on("distance", ({ straight, plan, height }) => {
      say(`${straight.toFixed(3)} m straight, ${plan.toFixed(3)} m in plan, ${height.toFixed(3)} m up`);
    });
  }

  click(): void {
    const { picked } = this.store.now;
    if (!this.on || !picked?.at) return;
    const [from, to] = [this.from, pointed(picked)];
    if (from) this.link.send({ kind: "distance", from, to });
    this.from = from ? null : to;
  }

  private measure(on: boolean): void {
    this.on = on;
    this.from = null;
    if (on) this.say("click on two points of the grid");
  }
}
