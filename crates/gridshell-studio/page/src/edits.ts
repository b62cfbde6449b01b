// The edit mode: the grid is changed by hand, by keys at the pointer, clicks, or suggestions.
import { toggle } from "./dom";
import { Editing } from "./editing";
import type { Link } from "./link";
import type { Picked } from "./messages";
import { type Point, type Pointing, pointed } from "./pointing";
import type { Store } from "./store";
import type { Say } from "./toast";
import type { Views } from "./views";

const OPERATIONS: Record<string, string> = { f: "flip", s: "split", c: "collapse", d: "drift" };

/** Suggestions are looked for when no edit has been done for so long, milliseconds. */
const PAUSE = 400;

export class Edits {
  readonly toggle = toggle("Edit", "Change the grid by hand (E)", "edit", (on) => this.enable(on));
  readonly panel = new Editing();
  /** The guide that is being drawn. */
  private drawn: Point[] | null = null;
  /** The node that is moved by the next click. */
  private grabbed: number | null = null;
  private suggesting: ReturnType<typeof setTimeout> | undefined;

  constructor(
    private readonly store: Store,
    private readonly link: Link,
    private readonly views: Views,
    private readonly pointing: Pointing,
    private readonly say: Say,
  ) {
    const { panel } = this;
    const { now } = store;
    store.on("shown", (run) => {
      this.draw(null);
      panel.run(run);
      if (!run) panel.history([], [], []);
    });
    store.on("picked", (picked) => this.hover(picked));
    link.on("hovered", (event) => {
      if (event.question === pointing.question) panel.hovered(event.ways);
    });
    link.on("history", (event) => {
      if (event.run !== now.shown) return;
      panel.history(event.before, event.done, event.undone);
      if (now.editing) this.suggestSoon();
    });
    link.on("suggested", (event) => {
      if (event.run === now.shown) panel.suggested(event.steps);
    });
    link.on("selected", ({ nodes, irregular }) => {
      views.first.mark(nodes);
      panel.selected(nodes, irregular);
    });
    panel.onEdit = (edit) => this.edit(edit);
    panel.onUndo = () => this.undo();
    panel.onRedo = () => this.redo();
    panel.onSuggest = () => {
      if (!now.shown) return;
      panel.looking();
      this.suggest();
    };
    panel.onPoint = (nodes) => views.first.mark(nodes);
  }

  undo(): void {
    this.link.send({ kind: "undo", run: this.store.now.shown });
  }

  redo(): void {
    this.link.send({ kind: "redo", run: this.store.now.shown });
  }

  /** A click in the view; whether it was for an edit. */
  click(): boolean {
    const { picked } = this.store.now;
    if (!picked?.at) return false;
    if (this.drawn) {
      this.draw([...this.drawn, pointed(picked)]);
      return true;
    }
    if (this.grabbed === null) return false;
    this.edit({ op: "move", node: this.grabbed, to: picked.at });
    this.grabbed = null;
    return true;
  }

  /** A key of the edit mode: about what is under the pointer. */
  key(key: string): void {
    if (this.store.now.editing) this.pointing.settled(() => this.editAt(key));
  }

  /** Lay the guide that was drawn; whether there is one. */
  lay(): boolean {
    if (!this.drawn) return false;
    this.pointing.settled(() => {
      if (this.drawn) this.edit({ op: "add_guide", points: this.drawn });
      this.draw(null);
    });
    return true;
  }

  /** Let go of what is begun or selected. */
  drop(): void {
    this.grabbed = null;
    this.draw(null);
    this.panel.selected([], 0);
    this.views.first.mark([]);
  }

  private enable(on: boolean): void {
    const { first } = this.views;
    this.panel.enable(on);
    first.grid.showsFixed(on);
    first.redraw();
    if (!on) this.draw(null);
    this.store.set("editing", on);
    if (on && this.store.now.shown) this.suggestSoon();
  }

  private edit(edit: Record<string, unknown>): void {
    this.link.send({ kind: "edit", run: this.store.now.shown, edit });
  }

  private editAt(key: string): void {
    const { picked } = this.store.now;
    if (!picked?.at) return;
    const op = OPERATIONS[key];
    if (op && picked.member) this.edit({ op, nodes: picked.member });
    if (key === "a") this.edit({ op: "add_anchor", at: picked.at });
    if (key === "l") {
      if (!this.drawn) this.say("click the points of the guide; Enter lays it, Escape drops it");
      this.draw([...(this.drawn ?? []), pointed(picked)]);
    }
    const node = picked.node_first ? picked.node : null;
    if (key === "r" && node === null && picked.member)
      this.edit({ op: "remove_guide", nodes: picked.member });
    if (node === null) return;
    if (key === "r") this.edit({ op: "remove_anchor", node });
    if (key === "p") this.edit({ op: "pin", node });
    if (key === "u") this.edit({ op: "unpin", node });
    if (key === "g") {
      this.grabbed = node;
      this.say(`node ${node} goes to where you click next`);
    }
  }

  private draw(points: Point[] | null): void {
    this.drawn = points;
    this.views.first.draws(points ?? []);
  }

  /** Mark what is under the pointer, and ask what could be done with it. */
  private hover(picked: Picked | null): void {
    const { panel, store } = this;
    if (!picked?.at) {
      panel.hovered([]);
      this.views.first.mark(panel.nodes);
      return;
    }
    const { member, node, question } = picked;
    const ends = picked.node_first && node !== null ? [node] : (member ?? []);
    this.views.first.mark([...panel.nodes, ...ends]);
    if (!store.now.editing || !member) return;
    this.link.send({ kind: "hover", run: store.now.shown, nodes: member, question });
  }

  /** After an edit the old suggestions no longer hold. */
  private suggestSoon(): void {
    clearTimeout(this.suggesting);
    this.panel.looking();
    this.suggesting = setTimeout(() => this.suggest(), PAUSE);
  }

  private suggest(): void {
    this.link.send({ kind: "suggest", run: this.store.now.shown });
  }
}
