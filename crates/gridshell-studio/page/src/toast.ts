// A word on what was just done or went wrong; it goes by itself.
import { el } from "./dom";

export type Say = (message: string, bad?: boolean) => void;

export class Toast {
  readonly element = el("div", { class: "toast", role: "alert", hidden: true });
  private hiding: ReturnType<typeof setTimeout> | undefined;

  readonly say: Say = (message, bad = false) => {
    this.element.textContent = message;
    this.element.classList.toggle("bad", bad);
    this.element.hidden = false;
    clearTimeout(this.hiding);
    this.hiding = setTimeout(() => (this.element.hidden = true), bad ? 12_000 : 5000);
  };
}
