// The pointer in the view: what is under it, clicks there, and the box that selects nodes.
import { el } from "./dom";
import type { Link } from "./link";
import type { Picked } from "./messages";
import type { Store } from "./store";
import type { Views } from "./views";

export type Point = [number, number, number];

/** The node under the pointer, else the place. */
export function pointed(at: Picked): Point {
  return (at.node_first && at.node_at) || at.at!;
}

/** Turning the view ends with a click too; one that moved further is none, pixels. */
const STILL = 4;

export class Pointing {
  readonly tip = el("div", { class: "tip", hidden: true });
  readonly rubber = el("div", { class: "rubber", hidden: true });
  /** A click, once it is known what is under it. */
  onClick: (() => void) | null = null;
  /** Number of the last question. */
  question = 0;
  /** Whether one is not answered yet, and whether the pointer has moved since. */
  private asked = false;
  private again = false;
  private last: PointerEvent | null = null;
  /** What is to be done with the answers to some questions. */
  private readonly acts = new Map<number, () => void>();
  private pressedAt: [number, number] = [0, 0];
  private boxFrom: [number, number] | null = null;

  constructor(
    private readonly store: Store,
    private readonly link: Link,
    private readonly views: Views,
  ) {
    link.on("connected", (yes) => {
      if (!yes) return;
      [this.asked, this.again] = [false, false];
      this.acts.clear();
    });
    link.on("picked", (event) => this.answered(event));
    store.on("shown", () => {
      this.asked = false;
      this.acts.clear();
      this.tip.hidden = true;
      store.set("picked", null);
    });
    const { canvas } = views.first;
    canvas.addEventListener("pointermove", (e) => {
      if (this.boxFrom) this.stretch(this.boxFrom, e);
      else if (e.buttons === 0) this.ask(e);
      else this.tip.hidden = true;
    });
    canvas.addEventListener("pointerleave", () => (this.tip.hidden = true));
    canvas.addEventListener("pointerdown", (e) => {
      this.pressedAt = [e.clientX, e.clientY];
      if (!e.shiftKey || !store.now.editing) return;
      this.boxFrom = [e.clientX, e.clientY];
      views.first.rotates(false);
    });
    canvas.addEventListener("pointerup", (e) => {
      if (this.boxFrom) this.select(this.boxFrom, e);
    });
    canvas.addEventListener("click", (e) => {
      const moved = Math.hypot(e.clientX - this.pressedAt[0], e.clientY - this.pressedAt[1]);
      if (moved <= STILL) this.settled(() => this.onClick?.());
    });
  }

  /** Do what is about the place that is under the pointer now, once it is known, and after what was asked before. */
  settled(act: () => void): void {
    if ((!this.asked && !this.acts.size) || !this.last) return act();
    this.acts.set(++this.question, act);
    this.pick(this.last);
  }

  private ask(e: PointerEvent): void {
    this.last = e;
    this.again = this.asked;
    if (this.asked || !this.store.now.shown || this.store.now.live) return;
    this.question++;
    this.asked = this.pick(e);
  }

  private pick(e: PointerEvent): boolean {
    const sight = this.views.first.sight(e.clientX, e.clientY);
    return this.link.send({ kind: "pick", run: this.store.now.shown, ...sight, question: this.question });
  }

  private answered(event: Picked): void {
    this.store.set("picked", event);
    this.tell(event);
    const act = this.acts.get(event.question);
    if (act) {
      this.acts.delete(event.question);
      return act();
    }
    this.asked = false;
    if (this.again && this.last) this.ask(this.last);
  }

  private tell(event: Picked): void {
    const { tip, last } = this;
    tip.hidden = !event.at || !last;
    if (!event.at || !last) return;
    tip.replaceChildren(...event.facts.map((f) => el("div", {}, [el("span", {}, [f.label]), f.value])));
    const box = this.views.stage.getBoundingClientRect();
    tip.style.left = `${Math.min(last.clientX - box.left + 16, box.width - 230)}px`;
    tip.style.top = `${Math.min(last.clientY - box.top + 16, box.height - 110)}px`;
  }

  private stretch(from: [number, number], e: PointerEvent): void {
    const box = this.views.stage.getBoundingClientRect();
    const [left, right] = ordered(from[0] - box.left, e.clientX - box.left);
    const [top, bottom] = ordered(from[1] - box.top, e.clientY - box.top);
    this.rubber.style.cssText = `left:${left}px;top:${top}px;width:${right - left}px;height:${bottom - top}px`;
    this.rubber.hidden = false;
  }

  private select(from: [number, number], e: PointerEvent): void {
    const { first: view } = this.views;
    this.boxFrom = null;
    this.rubber.hidden = true;
    view.rotates(true);
    const box = view.canvas.getBoundingClientRect();
    const across = (x: number) => ((x - box.left) / box.width) * 2 - 1;
    const up = (y: number) => 1 - ((y - box.top) / box.height) * 2;
    const [left, right] = ordered(across(from[0]), across(e.clientX));
    const [bottom, top] = ordered(up(from[1]), up(e.clientY));
    const rectangle: [number, number, number, number] = [left, bottom, right, top];
    this.link.send({ kind: "select", run: this.store.now.shown, matrix: view.matrix(), rectangle });
  }
}

function ordered(a: number, b: number): [number, number] {
  return a < b ? [a, b] : [b, a];
}
