// What earlier sessions left unsaved, offered until it is taken or thrown away.
import { el } from "./dom";
import type { Left } from "./messages";

export class Recovery {
  readonly element = el("section", { class: "recovery", hidden: true, "aria-label": "Recovery" });
  onRecover: ((session: string) => void) | null = null;
  onDiscard: ((session: string) => void) | null = null;

  show(sessions: Left[]): void {
    this.element.hidden = sessions.length === 0;
    this.element.replaceChildren(
      el("h2", {}, ["Not saved when the studio ended"]),
      ...sessions.map((left) => this.row(left)),
    );
  }

  private row(left: Left): HTMLElement {
    const when = new Date(1000 * left.seconds);
    const told = when.toLocaleString("en-GB", { dateStyle: "medium", timeStyle: "short" });
    return el("div", { class: "left-behind", "data-session": left.session }, [
      el("div", {}, [
        el("time", { datetime: when.toISOString() }, [told]),
        el(
          "ul",
          {},
          left.grids.map((grid) => el("li", {}, [grid])),
        ),
      ]),
      el("button", { type: "button", class: "primary" }, ["Recover"], {
        onclick: () => this.onRecover?.(left.session),
      }),
      el("button", { type: "button" }, ["Discard"], { onclick: () => this.onDiscard?.(left.session) }),
    ]);
  }
}
