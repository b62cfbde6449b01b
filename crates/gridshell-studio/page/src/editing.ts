// The edit mode's panel: what the operations under the pointer would do, suggestions, the history.
import { el } from "./dom";
import type { Step } from "./messages";

type Edit = Record<string, unknown>;

const LOOKING = "Looking for edits that better the grid …";

export class Editing {
  readonly element = el("section", { class: "editing", hidden: true, "aria-label": "Edit" });
  onEdit: ((edit: Edit) => void) | null = null;
  onUndo: (() => void) | null = null;
  onRedo: (() => void) | null = null;
  onSuggest: (() => void) | null = null;
  onPoint: ((nodes: number[]) => void) | null = null;
  /** The nodes that are selected. */
  nodes: number[] = [];

  private readonly ways = el("div", { class: "ways" });
  private readonly chosen = el("div", { class: "chosen" });
  private readonly better = el("ol", { class: "steps" });
  private readonly past = el("ol", { class: "steps history" });
  private readonly undo = el("button", { type: "button", id: "undo", disabled: true, title: "Ctrl-Z" }, [
    "Undo",
  ]);
  private readonly redo = el(
    "button",
    { type: "button", id: "redo", disabled: true, title: "Ctrl-Shift-Z" },
    ["Redo"],
  );

  constructor() {
    const suggest = el("button", { type: "button" }, ["Suggest"], { onclick: () => this.onSuggest?.() });
    const relax = el("button", { type: "button", title: "Move all nodes to an even balance" }, ["Relax"], {
      onclick: () => this.onEdit?.({ op: "relax_all" }),
    });
    this.undo.onclick = () => this.onUndo?.();
    this.redo.onclick = () => this.onRedo?.();
    this.element.append(
      el("div", { class: "row" }, [this.undo, this.redo, suggest, relax]),
      el("h2", {}, ["Under the pointer"]),
      this.ways,
      this.chosen,
      el("h2", {}, ["Suggested"]),
      this.better,
      el("h2", {}, ["History"]),
      this.past,
    );
    this.hovered([]);
    this.suggested("No grid is shown.");
    this.history([], [], []);
  }

  enable(yes: boolean): void {
    this.element.hidden = !yes;
    if (!yes) this.selected([], 0);
  }

  /** Another run is shown. */
  run(run: number): void {
    this.selected([], 0);
    this.suggested(run ? LOOKING : "No grid is shown.");
    this.hovered([]);
  }

  hovered(ways: Step[]): void {
    if (!ways.length) {
      const keys = [
        "F flip",
        "S split",
        "C collapse",
        "D drift",
        "P pin",
        "U unpin",
        "A anchor",
        "G move",
        "L guide",
        "R remove",
      ].map((k) => el("span", {}, [el("kbd", {}, [k[0]!]), k.slice(1)]));
      this.ways.replaceChildren(
        el("p", { class: "hint" }, ["Point at a member or node and press"]),
        el("p", { class: "keys" }, keys),
      );
      return;
    }
    this.ways.replaceChildren(
      ...ways.map((way) => {
        const word = way.label.split(" ")[0]!;
        const text = way.refusal ?? way.effect;
        return el("div", { class: way.refusal ? "way no" : way.better ? "way good" : "way" }, [
          el("kbd", {}, [word[0]!.toUpperCase()]),
          el("b", {}, [word]),
          el("span", { title: text }, [text]),
        ]);
      }),
    );
  }

  selected(nodes: number[], irregular: number): void {
    this.nodes = nodes;
    if (!nodes.length) {
      this.chosen.replaceChildren(el("p", { class: "hint" }, ["Shift-drag selects nodes."]));
      return;
    }
    const act = (label: string, edit: Edit) =>
      el("button", { type: "button" }, [label], { onclick: () => this.onEdit?.(edit) });
    this.chosen.replaceChildren(
      el("p", {}, [`${nodes.length} nodes, ${irregular} irregular`]),
      el("div", { class: "row" }, [
        act("Heal here", { op: "heal", nodes, rings: 1 }),
        act("Relax here", { op: "relax", nodes, rings: 1 }),
      ]),
    );
  }

  /** Suggestions are asked for. */
  looking(): void {
    this.suggested(LOOKING);
  }

  /** The suggestions, or why there are none yet. */
  suggested(steps: Step[] | string): void {
    if (typeof steps === "string") {
      this.better.replaceChildren(el("li", { class: "hint" }, [steps]));
      return;
    }
    const rows = steps.map((step) =>
      el("li", {}, [
        el(
          "button",
          { type: "button", class: "step good" },
          [el("b", {}, [step.label]), el("span", {}, [step.effect])],
          {
            onclick: () => this.onEdit?.(step.edit),
            onmouseenter: () => this.onPoint?.((step.edit["nodes"] as number[] | undefined) ?? []),
            onfocus: () => this.onPoint?.((step.edit["nodes"] as number[] | undefined) ?? []),
          },
        ),
      ]),
    );
    this.better.replaceChildren(
      ...(rows.length
        ? rows
        : [el("li", { class: "hint" }, ["None: no single edit is known to better this grid."])]),
    );
  }

  /** `before` came with the file and cannot be undone. */
  history(before: string[], done: Step[], undone: Step[]): void {
    this.undo.disabled = !done.length;
    this.redo.disabled = !undone.length;
    const row = (step: Step, kind: string) =>
      el("li", { class: kind }, [el("b", {}, [step.label]), el("span", {}, [step.effect])]);
    const rows = [
      ...undone.toReversed().map((s) => row(s, "undone")),
      ...done.toReversed().map((s) => row(s, "done")),
      ...before
        .toReversed()
        .map((label) => el("li", { class: "before", title: "Came with the file" }, [el("b", {}, [label])])),
    ];
    this.past.replaceChildren(
      ...(rows.length ? rows : [el("li", { class: "hint" }, ["Nothing was changed by hand."])]),
    );
  }
}
