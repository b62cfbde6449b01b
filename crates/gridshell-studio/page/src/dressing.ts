// Light and dark: as the system is, until the user chooses.
import { el } from "./dom";
import type { Store } from "./store";

const dark = matchMedia("(prefers-color-scheme: dark)");

export class Dressing {
  readonly button = el("button", { type: "button", class: "quiet", title: "Light or dark" }, ["Theme"]);
  private chosen: "light" | "dark" | null = null;

  constructor(private readonly store: Store) {
    this.button.onclick = () => {
      this.chosen = store.now.theme === "dark" ? "light" : "dark";
      this.dress();
    };
    dark.addEventListener("change", () => this.dress());
  }

  dress(): void {
    const theme = this.chosen ?? (dark.matches ? "dark" : "light");
    document.documentElement.dataset["theme"] = theme;
    this.store.set("theme", theme);
  }
}
