// What goes on: the status line, the stages of a run, and the button that stops it.
import { el } from "./dom";
import type { Link } from "./link";
import type { Progress } from "./messages";
import type { Store } from "./store";

const STAGES = ["pack", "triangulate", "regularize", "relax"];
/** Most edits are done before they are worth a word, milliseconds. */
const PATIENCE = 250;

export class Doing {
  readonly status = el("output", { class: "status", "aria-live": "polite" });
  readonly cancel = el("button", { type: "button", id: "cancel", disabled: true }, ["Cancel"]);
  readonly stages = el("div", {
    class: "progress",
    role: "progressbar",
    "aria-label": "Progress",
    "aria-valuemin": 0,
    "aria-valuemax": 100,
  });
  private waiting: ReturnType<typeof setTimeout> | undefined;

  constructor(
    private readonly store: Store,
    private readonly link: Link,
  ) {
    this.status.textContent = store.now.status;
    store.on("status", (text) => (this.status.textContent = text));
    link.on("connected", (yes) => {
      store.set("status", yes ? "ready" : "no connection: is gridshell still running? Trying again …");
      this.status.classList.toggle("lost", !yes);
    });
    link.on("progress", (progress) => {
      store.set("going", progress);
      this.show(progress);
    });
    link.on("idle", () => {
      store.set("following", true);
      store.set("going", null);
      this.cancel.disabled = store.now.working === null;
      this.stages.classList.add("idle");
      store.set("status", "ready");
    });
    link.on("working", (event) => this.works(event.what, event.fraction));
    link.on("worked", () => this.worked());
    this.cancel.onclick = () => link.send({ kind: "cancel" });
  }

  /** Stop the run or the edit that goes on, if any does. */
  stop(): void {
    const { going, working } = this.store.now;
    if (going || working !== null) this.link.send({ kind: "cancel" });
  }

  private show(progress: Progress): void {
    const { stage, fraction } = progress;
    this.cancel.disabled = false;
    this.stages.classList.remove("idle");
    const at = stage === "measure" ? STAGES.length : STAGES.indexOf(stage);
    const bars = STAGES.map((name, k) => {
      const share = k < at ? 1 : k === at ? fraction : 0;
      const bar = el("i", { style: `width:${(100 * share).toFixed(1)}%` });
      const kind = k === at ? "bar now" : "bar";
      return el("div", { class: kind }, [el("span", {}, [name]), el("div", {}, [bar])]);
    });
    this.stages.replaceChildren(...bars);
    const overall = at < 0 ? 0 : Math.min(100, (100 * (at + fraction)) / STAGES.length);
    this.stages.setAttribute("aria-valuenow", overall.toFixed(0));
    const what = progress.draft ? "draft" : "grid";
    this.store.set("status", `${what}: ${stage}, ${progress.seconds.toFixed(1)} s`);
  }

  private works(what: string, fraction: number): void {
    const begins = this.store.now.working === null;
    this.store.set("working", what);
    const tell = () => {
      this.cancel.disabled = false;
      const share = fraction > 0 ? ` ${(100 * fraction).toFixed(0)} %` : "";
      this.store.set("status", `${this.store.now.working} …${share}`);
    };
    if (begins) this.waiting = setTimeout(tell, PATIENCE);
    else if (fraction > 0) tell();
  }

  private worked(): void {
    clearTimeout(this.waiting);
    this.store.set("working", null);
    this.cancel.disabled = !this.store.now.going;
    if (!this.store.now.going) this.store.set("status", "ready");
  }
}
