// What earlier sessions left unsaved, offered until it is taken, thrown away or put off.
import { el } from "./dom";
import type { Left } from "./messages";

export class Recovery {
  readonly element = el("section", { class: "recovery", hidden: true, "aria-label": "Recovery" });
  onRecover: ((session: string) => void) | null = null;
  onDiscard: ((session: string) => void) | null = null;
  /** Sessions that are dealt with later. */
  private readonly later = new Set<string>();

  show(all: Left[], more: number): void {
    const sessions = all.filter((left) => !this.later.has(key(left)));
    this.element.hidden = sessions.length === 0;
    const later = el(
      "button",
      { type: "button", class: "quiet", title: "Nothing is lost by it" },
      ["Later"],
      {
        onclick: () => {
          all.forEach((left) => this.later.add(key(left)));
          this.show(all, more);
        },
      },
    );
    this.element.replaceChildren(
      el("div", { class: "row" }, [el("h2", {}, ["Not saved when the studio ended"]), later]),
      ...sessions.map((left) => this.row(left)),
    );
    if (more) {
      const text = `${more} older ${more === 1 ? "session is" : "sessions are"} offered by the next studio, when these are dealt with.`;
      this.element.append(el("p", { class: "hint" }, [text]));
    }
  }

  private row(left: Left): HTMLElement {
    const when = new Date(1000 * left.seconds);
    const told = when.toLocaleString("en-GB", { dateStyle: "medium", timeStyle: "short" });
    const recover = el("button", { type: "button", class: "primary" }, ["Recover"], {
      onclick: () => this.onRecover?.(left.session),
    });
    const discard = el("button", { type: "button" }, [left.damaged.length ? "Discard all" : "Discard"], {
      onclick: () => this.onDiscard?.(left.session),
    });
    return el("div", { class: "left-behind", "data-session": left.session }, [
      el("div", {}, [
        el("time", { datetime: when.toISOString() }, [told]),
        el(
          "ul",
          {},
          left.grids.map((grid) => el("li", {}, [grid])),
        ),
        left.damaged.length > 0 && damaged(left),
      ]),
      left.grids.length > 0 && recover,
      discard,
    ]);
  }
}

/** The same session with other contents is told anew. */
const key = (left: Left) => `${left.session} ${left.grids.length} ${left.damaged.length}`;

function damaged({ damaged, folder }: Left): HTMLElement {
  const one = damaged.length === 1;
  return el("div", { class: "damaged" }, [
    el("p", {}, [
      `${one ? "This one is" : "These are"} damaged and cannot be recovered. ${one ? "It stays" : "They stay"} in `,
      el("code", {}, [folder]),
      " unless discarded:",
    ]),
    el(
      "ul",
      {},
      damaged.map((d) => el("li", {}, [el("b", {}, [d.file]), ` ${d.reason}`])),
    ),
  ]);
}
