// What the user should know until it has changed or been read: lines under the toolbar, one for each matter.
import { el } from "./dom";

/** Something that can be done about it. */
interface Action {
  label: string;
  act: () => void;
}

export class Notices {
  readonly element = el("section", { class: "notices", role: "status", "aria-label": "Notices" });
  private readonly rows = new Map<string, HTMLElement>();

  /** Tell of the matter `key`, in the place of what was told of it before. */
  set(key: string, text: string, bad = false, action?: Action): void {
    const close = () => this.drop(key);
    const row = el("div", { class: bad ? "notice bad" : "notice", "data-notice": key }, [
      el("p", {}, [text]),
      action &&
        el("button", { type: "button" }, [action.label], {
          onclick: () => {
            close();
            action.act();
          },
        }),
      el("button", { type: "button", class: "quiet", "aria-label": "Dismiss", title: "Dismiss" }, ["×"], {
        onclick: close,
      }),
    ]);
    this.rows.get(key)?.remove();
    this.rows.set(key, row);
    this.element.append(row);
  }

  /** The matter is settled; whether there was anything told of it. */
  drop(key: string): boolean {
    this.rows.get(key)?.remove();
    return this.rows.delete(key);
  }
}
