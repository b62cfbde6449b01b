// The view, and the one beside it while two runs are compared: what they show, and from where.
import { el, toggle } from "./dom";
import type { Frame, Link } from "./link";
import { THEMES } from "./palette";
import type { Store } from "./store";
import { type Side, View } from "./view";

/** The sides to look from, and their keys. */
const SIDES: [Side, string, string][] = [
  ["perspective", "3D", "1"],
  ["top", "Top", "2"],
  ["front", "Front", "3"],
  ["side", "Side", "4"],
];

export class Views {
  /** Around them and all that is laid over them. */
  readonly stage = el("div", { class: "stage" });
  readonly first: View;
  second: View | null = null;
  readonly beside = el("div", { class: "host", hidden: true });
  readonly sides: HTMLElement;
  readonly slice: HTMLElement;
  readonly surface = toggle("Surface", "Show the surface behind the grid", "show-surface", (on) =>
    this.first.showsSurface(on),
  );
  private readonly buttons = SIDES.map(([side, label, key]) =>
    el("button", { type: "button", title: `${label} (${key})` }, [label], { onclick: () => this.look(side) }),
  );
  private surfaceFrame: Frame | null = null;

  constructor(
    private readonly store: Store,
    link: Link,
  ) {
    const host = el("div", { class: "host" });
    this.stage.append(host, this.beside);
    this.first = new View(host);
    this.sides = el("div", { class: "segment" }, this.buttons);
    const slice = el("input", {
      type: "range",
      min: 0,
      max: 100,
      value: 0,
      "aria-label": "Section plane",
      title: "Section: cut off what is in front",
    });
    slice.oninput = () => this.all.forEach((view) => view.slice(slice.valueAsNumber / 100));
    this.slice = el("label", { class: "slice" }, ["Section", slice]);

    store.on("theme", (theme) => this.all.forEach((view) => view.dress(THEMES[theme])));
    store.on("shown", (run) => {
      if (!run) this.first.clear();
    });
    link.onFrame("surface", (frame) => {
      this.surfaceFrame = frame;
      for (const view of this.all) view.showSurface(frame);
      store.set("shown", 0);
    });
    link.onFrame("bubbles", (frame) => this.follow(frame, () => this.first.showBubbles(frame)));
    link.onFrame("live", (frame) => this.follow(frame, () => this.first.showGrid(frame)));
    link.onFrame("grid", (frame) => {
      if (frame.run === store.now.beside && this.second) {
        this.second.showGrid(frame);
        this.second.follow(this.first);
      }
      if (frame.run !== store.now.shown) return;
      store.set("live", false);
      this.first.showGrid(frame);
    });
    link.onFrame("stage", (frame) => {
      if (frame.run === store.now.shown) this.first.showGrid(frame);
    });
  }

  get all(): View[] {
    return this.second ? [this.first, this.second] : [this.first];
  }

  look(side: Side): void {
    this.first.look(side);
    this.second?.follow(this.first);
    this.buttons.forEach((b, k) => b.classList.toggle("on", SIDES[k]![0] === side));
  }

  /** Look from the side that has this key; whether one has. */
  key(key: string): boolean {
    const side = SIDES.find((s) => s[2] === key);
    if (side) this.look(side[0]);
    return side !== undefined;
  }

  /** Open the view beside, which moves with the first. */
  open(): void {
    const { first } = this;
    this.beside.hidden = false;
    const second = new View(this.beside);
    this.second = second;
    second.dress(THEMES[this.store.now.theme]);
    if (this.surfaceFrame) second.showSurface(this.surfaceFrame);
    first.onCamera = () => second.follow(first);
    second.onCamera = () => first.follow(second);
    setTimeout(() => {
      first.whole();
      second.follow(first);
    });
  }

  close(): void {
    this.beside.hidden = true;
    this.second?.dispose();
    this.second = null;
    this.first.onCamera = null;
    setTimeout(() => this.first.whole());
  }

  /** A picture of the run that goes on: shown if it is followed. */
  private follow(frame: Frame, show: () => void): void {
    const { going, following } = this.store.now;
    if (!following || frame.run !== going?.run) return;
    show();
    this.store.set("live", true);
  }
}
