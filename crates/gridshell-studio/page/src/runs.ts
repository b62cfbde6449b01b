// The runs so far as tabs, and what is known of the one that is shown: its measures and candidates.
import { Candidates } from "./candidates";
import { el } from "./dom";
import type { Link } from "./link";
import type { RunSummary } from "./messages";
import { Report } from "./report";
import type { Store } from "./store";

export class Runs {
  readonly tabs = el("div", { class: "runs", role: "tablist", "aria-label": "Runs" });
  readonly report = new Report();
  readonly candidates = new Candidates();
  private readonly live = el(
    "button",
    { type: "button", class: "run live", title: "Watch the current run", hidden: true },
    [el("b", {}, ["● live"]), "watch"],
    { onclick: () => this.store.set("following", true) },
  );

  constructor(
    private readonly store: Store,
    private readonly link: Link,
  ) {
    const { report, candidates } = this;
    const { now } = store;
    this.tabs.append(this.live);
    report.show(null);
    store.on("shown", (run) => {
      this.mark();
      candidates.choose(-1);
      if (run) return;
      report.show(null);
      candidates.show(null);
    });
    store.on("runs", () => this.list());
    store.on("going", (going) => {
      this.live.hidden = !going;
      if (!going && now.live && now.shown) link.send({ kind: "look", run: now.shown, stage: null });
    });
    store.on("theme", () => candidates.draw());
    link.on("connected", (yes) => {
      // What is shown may have changed while nobody listened.
      if (yes && now.shown) setTimeout(() => now.shown && this.show(now.shown), 300);
    });
    link.on("runs", (event) => this.take(event.runs, event.newest));
    link.on("run", (event) => {
      if (event.summary.run !== now.shown) return;
      report.show(event);
      candidates.show(event);
    });
    link.onFrame("candidates", (frame) => candidates.draw(frame));
    report.onStage = (stage) => link.send({ kind: "look", run: now.shown, stage });
    candidates.onOpen = () => link.send({ kind: "candidates", run: now.shown });
    candidates.onShow = (index) => link.send({ kind: "candidate", run: now.shown, index });
    candidates.onTake = (index) => link.send({ kind: "take", run: now.shown, index });
  }

  private show(run: number): void {
    this.store.set("shown", run);
    this.link.send({ kind: "look", run, stage: null });
  }

  /** A run that was just laid is shown, unless a later one is. */
  private take(runs: RunSummary[], newest: number | null): void {
    const { shown, runs: before } = this.store.now;
    const known = (run: number, all: RunSummary[]) => all.some((r) => r.run === run);
    this.store.set("runs", runs);
    if (newest !== null && !known(newest, before) && newest >= shown) this.show(newest);
    else if (shown && !known(shown, runs)) this.store.set("shown", 0);
  }

  private list(): void {
    this.tabs.replaceChildren(...this.store.now.runs.map((run) => this.tab(run)), this.live);
    this.mark();
  }

  private tab(run: RunSummary): HTMLElement {
    const q = run.fluency === null ? "∞" : run.fluency.toFixed(1);
    const unsaved = el("em", { class: "unsaved", title: "With changes that are in no file yet" }, [
      "unsaved",
    ]);
    return el(
      "button",
      { type: "button", role: "tab", class: "run", title: title(run), "data-run": run.run },
      [
        el("b", {}, [run.title, run.unsaved && unsaved]),
        el("span", {}, [run.detail]),
        el("span", {}, [`${run.nodes.toLocaleString("en")} nodes · ${run.irregular} irregular · Q ${q}`]),
      ],
      {
        onclick: () => {
          this.store.set("following", false);
          this.show(run.run);
        },
      },
    );
  }

  /** Which tab's run is shown. */
  private mark(): void {
    const shown = String(this.store.now.shown);
    for (const tab of this.tabs.querySelectorAll<HTMLElement>("[role=tab]"))
      tab.setAttribute("aria-selected", String(tab.dataset["run"] === shown));
  }
}

/** A run in one line. */
export function title(run: RunSummary): string {
  return `${run.run}: ${run.title}, ${run.detail}`;
}
