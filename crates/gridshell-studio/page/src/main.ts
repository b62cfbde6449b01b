// The studio's page: what stands where, and what happens when.
import "./style.css";
import { Candidates } from "./candidates";
import { Choosing } from "./choosing";
import { el, figure } from "./dom";
import { Editing } from "./editing";
import { Form } from "./form";
import { type Frame, Link } from "./link";
import type { Event, Hello, Picked, Progress, RunSummary, SurfaceInfo } from "./messages";
import { Notices } from "./notices";
import { bands, THEMES } from "./palette";
import { Recovery } from "./recovery";
import { Report } from "./report";
import { download, Saving } from "./saving";
import { type Side, View } from "./view";

const app = document.getElementById("app")!;
/** Take the token out of the address, once the cookie that came with the page does as well. */
async function clean(): Promise<void> {
  if (location.pathname === "/") return;
  const answer = await fetch("/").catch(() => null);
  if (answer?.ok) history.replaceState(null, "", "/");
}
void clean();
const form = new Form();
const report = new Report();
const choosing = new Choosing();
const candidates = new Candidates();
const recovery = new Recovery();
const notices = new Notices();
const saving = new Saving(notices, say, (run, version) => link.send({ kind: "saved", run, version }));
const toast = el("div", { class: "toast", role: "alert", hidden: true });
const status = el("output", { class: "status", "aria-live": "polite" }, ["connecting …"]);

/* Left: what is wanted. */
const surfaces = el("select", { id: "surface", "aria-label": "Built-in surface" });
const fileInput = el("input", { type: "file", id: "file", hidden: true, multiple: true });
const openButton = el("button", { type: "button", class: "quiet" }, ["Open file …"]);
const about = el("div", { class: "about" });
const estimate = el("p", { class: "estimate" }, ["–"]);
const generate = el("button", { type: "button", class: "primary", id: "generate" }, ["Generate"]);
const cancel = el("button", { type: "button", id: "cancel", disabled: true }, ["Cancel"]);
const stages = el("div", {
  class: "progress",
  role: "progressbar",
  "aria-label": "Progress",
  "aria-valuemin": 0,
  "aria-valuemax": 100,
});
const left = el("aside", { class: "left", "aria-label": "Surface and recipe" }, [
  el("section", { class: "source" }, [
    el("label", { class: "title", for: "surface" }, ["Surface"]),
    el("div", { class: "row" }, [surfaces, openButton, fileInput]),
    about,
  ]),
  el("section", { class: "recipe" }, [form.element]),
  el("section", { class: "go" }, [estimate, el("div", { class: "row" }, [generate, cancel]), stages]),
]);

/* Centre: what is there. */
const colorings = el("select", { "aria-label": "Color by", id: "color" }, [
  el("option", { value: "" }, ["No color"]),
]);
const legend = el("div", { class: "legend", hidden: true });
const tip = el("div", { class: "tip", hidden: true });
const slice = el("input", {
  type: "range",
  min: 0,
  max: 100,
  value: 0,
  "aria-label": "Section plane",
  title: "Section: cut off what is in front",
});
const sides: [Side, string, string][] = [
  ["perspective", "3D", "1"],
  ["top", "Top", "2"],
  ["front", "Front", "3"],
  ["side", "Side", "4"],
];
const sideButtons = sides.map(([side, label, key]) =>
  el("button", { type: "button", title: `${label} (${key})` }, [label], { onclick: () => look(side) }),
);
const toggle = (label: string, title: string, id: string) =>
  el("button", { type: "button", "aria-pressed": "false", title, id }, [label]);
const surfaceToggle = toggle("Surface", "Show the surface behind the grid", "show-surface");
const measureToggle = toggle("Distance", "Measure between two points (M)", "measure");
const editToggle = toggle("Edit", "Change the grid by hand (E)", "edit");
const compareToggle = toggle("Compare", "Two runs side by side", "compare");
const save = el(
  "button",
  {
    type: "button",
    id: "save",
    title: "Save the grid with surface, recipe and edits, to go on with (Ctrl-S)",
  },
  ["Save"],
);
const picture = el("button", { type: "button", title: "Save a picture of the view" }, ["PNG"]);
const formats = el("select", { "aria-label": "Export as", id: "export" }, [
  el("option", { value: "" }, ["Export …"]),
]);
const toolbar = el("div", { class: "toolbar", role: "toolbar", "aria-label": "View" }, [
  el("div", { class: "segment" }, sideButtons),
  el("label", { class: "slice" }, ["Section", slice]),
  surfaceToggle,
  measureToggle,
  editToggle,
  compareToggle,
  el("span", { class: "gap" }),
  colorings,
  save,
  picture,
  formats,
]);
const host = el("div", { class: "host" });
const hostB = el("div", { class: "host", hidden: true });
const selectB = el("select", { class: "other", "aria-label": "Run to compare with" });
hostB.append(selectB);
const rubber = el("div", { class: "rubber", hidden: true });
const stage = el("div", { class: "stage" }, [host, hostB, legend, tip, rubber, recovery.element, toast]);
const tabs = el("div", { class: "runs", role: "tablist", "aria-label": "Runs" });
const centre = el("main", { class: "centre" }, [toolbar, notices.element, stage, tabs]);

/* Right: what it is worth. */
const editing = new Editing();
const right = el("aside", { class: "right", "aria-label": "Measures" }, [
  editing.element,
  report.element,
  candidates.element,
]);
const theme = el("button", { type: "button", class: "quiet", title: "Light or dark" }, ["Theme"]);
app.append(
  el("header", {}, [el("h1", {}, ["gridshell ", el("span", {}, ["studio"])]), status, theme]),
  left,
  centre,
  right,
);

const view = new View(host);
let viewB: View | null = null;
let hello: Hello | null = null;
let surface: SurfaceInfo | null = null;
let surfaceFrame: Frame | null = null;
let runs: RunSummary[] = [];
let shown = 0;
let shownB = 0;
let going: Progress | null = null;
let began = 0;
let firstFrame = 0;
let firstGrid = 0;
let liveFrames = 0;
let question = 0;
let asked = false;
let lastPointer: PointerEvent | null = null;
let picked: Picked | null = null;
type Point = [number, number, number];
let from: Point | null = null;
let announced = 0;
/** The grid whose recipe the form began with. */
let formOf = 0;

const link = new Link({
  connected(yes) {
    status.textContent = yes ? "ready" : "no connection: is gridshell still running? Trying again …";
    status.classList.toggle("lost", !yes);
    if (!yes) return;
    [asked, again] = [false, false];
    acts.clear();
    // What is shown may have changed while nobody listened.
    if (shown) setTimeout(() => shown && show(shown), 300);
  },
  event: onEvent,
  frame: onFrame,
});

function onEvent(event: Event): void {
  switch (event.kind) {
    case "hello":
      return onHello(event);
    case "surface":
      return onSurface(event);
    case "estimate":
      estimate.textContent = `about ${event.nodes.toLocaleString("en")} nodes, members of ${figure(event.edge_length)} m`;
      form.suggest("edge_length", figure(event.edge_length));
      form.suggest("nodes", `about ${event.nodes}`);
      return;
    case "progress":
      return onProgress(event);
    case "idle":
      going = null;
      following = true;
      return busy(false);
    case "runs":
      return onRuns(event.runs, event.newest);
    case "recipe":
      form.file();
      // The same again after a broken connection: what was typed since then stays.
      if (event.run !== formOf) form.apply(event.values);
      choosing.chosen(form.get("part"));
      formOf = event.run;
      return askEstimate();
    case "left":
      return recovery.show(event.sessions, event.more);
    case "autosave":
      return onAutosave(event.fault);
    case "put_away":
      return onPutAway(event.grids);
    case "run":
      if (event.summary.run !== shown) return;
      report.show(event);
      return candidates.show(event);
    case "picked":
      return onPicked(event);
    case "hovered":
      if (event.question === question) editing.hovered(event.ways);
      return;
    case "history":
      if (event.run !== shown) return;
      editing.history(event.before, event.done, event.undone);
      if (pressed(editToggle)) askSuggestions();
      return;
    case "suggested":
      if (event.run === shown) editing.suggested(event.steps);
      return;
    case "selected":
      view.grid.mark(event.nodes);
      view.redraw();
      editing.selected(event.nodes, event.irregular);
      return;
    case "distance":
      say(
        `${event.straight.toFixed(3)} m straight, ${event.plan.toFixed(3)} m in plan, ${event.height.toFixed(3)} m up`,
      );
      return;
    case "working":
      return onWorking(event.what, event.fraction);
    case "worked":
      return onWorking(null, 0);
    case "fault":
      if (event.about === "estimate") estimate.textContent = event.message;
      else say(event.message, true);
      return;
  }
}

function onFrame(frame: Frame): void {
  switch (frame.shows) {
    case "surface":
      surfaceFrame = frame;
      view.showSurface(frame);
      viewB?.showSurface(frame);
      shown = 0;
      editing.run(0);
      editing.history([], [], []);
      report.show(null);
      candidates.show(null);
      return;
    case "bubbles":
    case "live":
      if (!going || frame.run !== going.run || !following) return;
      liveFrames++;
      if (!firstFrame) firstFrame = performance.now() - began;
      if (frame.shows === "bubbles") view.showBubbles(frame);
      else view.showGrid(frame);
      shownLive = true;
      return;
    case "grid":
      if (frame.run === shownB && viewB) {
        viewB.showGrid(frame);
        viewB.follow(view);
      }
      if (frame.run !== shown) return;
      shownLive = false;
      view.showGrid(frame);
      if (colorings.value) link.send({ kind: "color", run: shown, by: colorings.value });
      else legend.hidden = true;
      return;
    case "stage":
      if (frame.run === shown) view.showGrid(frame);
      return;
    case "candidates":
      return candidates.draw(frame);
    case "colors":
      if (frame.run === shownB && viewB) {
        viewB.grid.color(frame);
        viewB.redraw();
      }
      if (frame.run !== shown || frame.scale?.by !== colorings.value) return;
      view.grid.color(frame);
      view.redraw();
      showLegend(frame);
      return;
  }
}

/** Whether pictures of the run that goes on are followed: until another run is chosen. */
let following = true;
let shownLive = false;

function onHello(event: Hello & { kind: "hello" }): void {
  hello = event;
  surfaces.replaceChildren(
    el("option", { value: "", disabled: true }, ["a file"]),
    ...event.builtins.map((b) => el("option", { value: b.name, title: b.description }, [b.name])),
  );
  form.build(event.form);
  fileInput.accept = event.accepts.map((e) => `.${e}`).join(",");
  if (colorings.options.length === 1) {
    colorings.append(
      ...event.colorings.map((c) => el("option", { value: c.name, title: c.help }, [c.label])),
    );
    formats.append(
      ...event.exports.map((f) => el("option", { value: f.name, title: f.description }, [f.description])),
    );
  }
}

function onSurface(event: SurfaceInfo): void {
  surface = event;
  const known = event.built_in;
  surfaces.value = known ? event.name : "";
  document.title = `${event.name} – gridshell studio`;
  about.replaceChildren(
    el("p", { class: "what" }, [known ? event.source : `${event.name} (${event.source})`]),
    el(
      "dl",
      {},
      event.facts.flatMap((f) => [el("dt", {}, [f.label]), el("dd", {}, [f.value])]),
    ),
    choosing.element,
    list("Notes", event.notes),
  );
  choosing.show(event);
  form.parts(event.parts.map((p) => p.name));
  if (event.parts.length) form.set("part", "all");
  askEstimate();
}

function list(title: string, items: string[]): HTMLElement {
  if (!items.length) return el("span", { hidden: true });
  const open = items.length < 5;
  return el("details", { class: "list", open }, [
    el("summary", {}, [`${title} (${items.length})`]),
    el(
      "ul",
      {},
      items.map((i) => el("li", {}, [i])),
    ),
  ]);
}

const STAGES = ["pack", "triangulate", "regularize", "relax"];

function onProgress(event: Progress): void {
  if (!going || going.run !== event.run) announced = event.run;
  going = event;
  busy(true);
  const at = event.stage === "measure" ? STAGES.length : STAGES.indexOf(event.stage);
  const bars = STAGES.map((name, k) => {
    const share = k < at ? 1 : k === at ? event.fraction : 0;
    const bar = el("i", { style: `width:${(100 * share).toFixed(1)}%` });
    return el("div", { class: k === at ? "bar now" : "bar" }, [el("span", {}, [name]), el("div", {}, [bar])]);
  });
  stages.replaceChildren(...bars);
  const overall = at < 0 ? 0 : Math.min(100, (100 * (at + event.fraction)) / STAGES.length);
  stages.setAttribute("aria-valuenow", overall.toFixed(0));
  status.textContent = `${event.draft ? "draft" : "grid"}: ${event.stage}, ${event.seconds.toFixed(1)} s`;
}

let working: string | null = null;
let patience: ReturnType<typeof setTimeout> | undefined;
/** An edit goes on; most are done before it is worth a word. */
function onWorking(what: string | null, fraction: number): void {
  const begins = what !== null && working === null;
  working = what;
  const tell = () => {
    if (working === null) return;
    cancel.disabled = false;
    status.textContent = `${working} …${fraction > 0 ? ` ${(100 * fraction).toFixed(0)} %` : ""}`;
  };
  if (begins) patience = setTimeout(tell, 250);
  else if (fraction > 0) tell();
  if (what !== null) return;
  clearTimeout(patience);
  cancel.disabled = !going;
  if (!going) status.textContent = "ready";
}

function busy(yes: boolean): void {
  if (generate.disabled !== yes) showTabs();
  generate.disabled = yes;
  cancel.disabled = !yes && working === null;
  stages.classList.toggle("idle", !yes);
  if (!yes && link) {
    status.textContent = "ready";
    if (shownLive && shown) link.send({ kind: "look", run: shown, stage: null });
  }
}

function onRuns(all: RunSummary[], newest: number | null): void {
  const before = new Set(runs.map((r) => r.run));
  runs = all;
  const fresh = newest !== null && !before.has(newest);
  if (fresh && newest >= shown) {
    if (!firstGrid && began) firstGrid = performance.now() - began;
    show(newest);
  } else if (shown && !runs.some((r) => r.run === shown)) {
    shown = 0;
    view.clear();
    report.show(null);
  }
  showTabs();
  const options = runs.map((r) => el("option", { value: r.run, selected: r.run === shownB }, [name(r)]));
  selectB.replaceChildren(...options);
}

function onAutosave(fault: string | null): void {
  if (fault !== null) {
    const text = `Grids cannot be kept against crashes: ${fault}. Save what you need.`;
    notices.set("autosave", text, true);
  } else if (notices.drop("autosave")) say("Grids are kept against crashes again.");
}

/** Grids that made way, the newest last. */
const away: string[] = [];
function onPutAway(grids: string[]): void {
  away.push(...grids);
  const told = away.slice(-3).toReversed().join(" · ");
  const more = away.length > 3 ? ` · and ${away.length - 3} before` : "";
  const text = `Put away to make room, as nothing in it was changed by hand: ${told}${more}. Edited grids stay.`;
  notices.set("put away", text);
}

function showTabs(): void {
  const live = el(
    "button",
    { type: "button", class: "run live", title: "Watch the current run" },
    [el("b", {}, ["● live"]), "watch"],
    {
      onclick: () => (following = true),
    },
  );
  tabs.replaceChildren(...runs.map(tab), ...(going ? [live] : []));
}

function name(run: RunSummary): string {
  return `${run.run}: ${run.title}, ${run.detail}`;
}

function tab(run: RunSummary): HTMLElement {
  const current = run.run === shown;
  const q = run.fluency === null ? "∞" : run.fluency.toFixed(1);
  return el(
    "button",
    {
      type: "button",
      role: "tab",
      class: "run",
      "aria-selected": String(current),
      title: name(run),
      "data-run": run.run,
    },
    [
      el("b", {}, [
        run.title,
        run.unsaved &&
          el("em", { class: "unsaved", title: "With changes that are in no file yet" }, ["unsaved"]),
      ]),
      el("span", {}, [run.detail]),
      el("span", {}, [`${run.nodes.toLocaleString("en")} nodes · ${run.irregular} irregular · Q ${q}`]),
    ],
    {
      onclick: () => {
        following = false;
        show(run.run);
      },
    },
  );
}

function show(run: number): void {
  shown = run;
  draw(null);
  picked = null;
  asked = false;
  acts.clear();
  tip.hidden = true;
  editing.run(run);
  candidates.choose(-1);
  link.send({ kind: "look", run, stage: null });
  for (const button of tabs.querySelectorAll<HTMLElement>("[role=tab]")) {
    button.setAttribute("aria-selected", String(button.dataset["run"] === String(run)));
  }
}

function showLegend(frame: Frame): void {
  const scale = frame.scale!;
  legend.replaceChildren(
    el("b", {}, [scale.title]),
    el("div", { class: "bar", style: `background:${bands(scale)}` }),
    el(
      "div",
      { class: "ends" },
      scale.labels.map((label) => el("span", {}, [label.text])),
    ),
    scale.note && el("small", {}, [scale.note]),
    scale.all_nodes
      ? ""
      : el("div", { class: "odd" }, [
          el("i", { class: "black" }),
          "too few members",
          el("i", { class: "white" }),
          "too many",
        ]),
  );
  legend.hidden = false;
}

let suggesting: ReturnType<typeof setTimeout> | undefined;
/** After an edit the old suggestions no longer hold. */
function askSuggestions(): void {
  clearTimeout(suggesting);
  editing.looking();
  suggesting = setTimeout(() => link.send({ kind: "suggest", run: shown }), 400);
}

/* Wishes. */
function askEstimate(): void {
  clearTimeout(estimating);
  estimating = setTimeout(() => link.send({ kind: "estimate", values: form.values() }), 150);
}
let estimating: ReturnType<typeof setTimeout> | undefined;
form.onChange = () => {
  choosing.chosen(form.get("part"));
  askEstimate();
};
choosing.onPart = (part) => {
  form.set("part", part);
  askEstimate();
};
choosing.onPoint = (part) => view.pointAt(part);
choosing.onChoose = (layers, objects) => {
  anew();
  link.send({ kind: "choose", layers, objects });
};

function start(): void {
  if (going) return;
  began = performance.now();
  [firstFrame, firstGrid, liveFrames] = [0, 0, 0];
  following = true;
  link.send({ kind: "generate", values: form.values() });
}
generate.onclick = start;
cancel.onclick = () => link.send({ kind: "cancel" });
/** Another surface: its own recipe, and an edge length that suits it. */
function anew(): void {
  form.set("edge_length", "");
  form.noFile();
  formOf = 0;
}
surfaces.onchange = () => {
  anew();
  link.send({ kind: "open", name: surfaces.value });
};
openButton.onclick = () => fileInput.click();
fileInput.onchange = () => {
  void openAll(fileInput.files);
  fileInput.value = "";
};

const isGrid = (file: File) => file.name.toLowerCase().endsWith(".gridshell");

/** Surfaces first: a grid among the files may lie on one of them. */
async function openAll(files: FileList | null | undefined): Promise<void> {
  const all = [...(files ?? [])];
  for (const file of [...all.filter((f) => !isGrid(f)), ...all.filter(isGrid)]) await open(file);
}

async function open(file: File): Promise<void> {
  if (hello && file.size > hello.upload_limit) {
    say(`${file.name} is larger than ${hello.upload_limit >> 20} MB`, true);
    return;
  }
  status.textContent = `reading ${file.name} …`;
  anew();
  try {
    const answer = await fetch(`open?name=${encodeURIComponent(file.name)}`, { method: "POST", body: file });
    if (answer.ok) say(`opened ${file.name}`);
    else say(await answer.text(), true);
  } catch {
    say(`${file.name} could not be sent: is gridshell still running?`, true);
  }
  status.textContent = "ready";
}

stage.addEventListener("dragover", (e) => {
  e.preventDefault();
  stage.classList.add("drop");
});
stage.addEventListener("dragleave", () => stage.classList.remove("drop"));
stage.addEventListener("drop", (e) => {
  e.preventDefault();
  stage.classList.remove("drop");
  void openAll(e.dataTransfer?.files);
});

colorings.onchange = () => {
  if (colorings.value && shown) {
    link.send({ kind: "color", run: shown, by: colorings.value });
    if (shownB) link.send({ kind: "color", run: shownB, by: colorings.value });
    return;
  }
  legend.hidden = true;
  for (const v of [view, viewB]) {
    v?.grid.plain();
    v?.redraw();
  }
};

save.onclick = () => {
  const run = runs.find((r) => r.run === shown);
  if (run) void saving.save(run);
  else say("generate a grid first", true);
};
formats.onchange = () => {
  if (formats.value === "gridshell") save.click();
  else exportAs(formats.value);
  formats.value = "";
};

function exportAs(format: string): void {
  if (!shown) return say("generate a grid first", true);
  download(`export?run=${shown}&format=${format}`, "");
}

picture.onclick = async () => {
  const blob = await view.picture();
  if (!blob) return;
  const address = URL.createObjectURL(blob);
  download(address, `${surface?.name ?? "view"}.png`);
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
};

function look(side: Side): void {
  view.look(side);
  viewB?.follow(view);
  sideButtons.forEach((b, k) => b.classList.toggle("on", sides[k]![0] === side));
}

slice.oninput = () => {
  view.slice(slice.valueAsNumber / 100);
  viewB?.slice(slice.valueAsNumber / 100);
};

function flip(button: HTMLElement): boolean {
  const on = button.getAttribute("aria-pressed") !== "true";
  button.setAttribute("aria-pressed", String(on));
  return on;
}
function pressed(button: HTMLElement): boolean {
  return button.getAttribute("aria-pressed") === "true";
}

surfaceToggle.onclick = () => view.showsSurface(flip(surfaceToggle));
measureToggle.onclick = () => {
  from = null;
  if (flip(measureToggle)) say("click on two points of the grid");
};
editToggle.onclick = () => {
  const on = flip(editToggle);
  editing.enable(on);
  view.grid.showsFixed(on);
  view.redraw();
  if (!on) draw(null);
  stage.classList.toggle("editing", on);
  if (on) right.scrollTop = 0;
  if (on && shown) askSuggestions();
};
compareToggle.onclick = () => {
  const on = flip(compareToggle);
  hostB.hidden = !on;
  if (!on) {
    viewB?.dispose();
    viewB = null;
    shownB = 0;
    view.onCamera = null;
    setTimeout(() => view.whole());
    return;
  }
  viewB = new View(hostB);
  dress();
  if (surfaceFrame) viewB.showSurface(surfaceFrame);
  const second = viewB;
  view.onCamera = () => second.follow(view);
  second.onCamera = () => view.follow(second);
  const other = runs.filter((r) => r.run !== shown).at(-1) ?? runs.at(-1);
  if (other) compareWith(other.run);
  setTimeout(() => {
    view.whole();
    second.follow(view);
  });
};
selectB.onchange = () => compareWith(Number(selectB.value));

function compareWith(run: number): void {
  shownB = run;
  selectB.value = String(run);
  link.send({ kind: "look", run, stage: null });
  if (colorings.value) link.send({ kind: "color", run, by: colorings.value });
}

/* The pointer. */
/** Whether it moved while the answer was awaited. */
let again = false;
/** What is to be done with the answers to some questions. */
const acts = new Map<number, () => void>();
/** Do what is about the place that is under the pointer now, once it is known, and after what was asked before. */
function settled(act: () => void): void {
  if ((!asked && !acts.size) || !lastPointer) return act();
  acts.set(++question, act);
  pick(lastPointer);
}
function pick(e: PointerEvent): boolean {
  return link.send({ kind: "pick", run: shown, ...view.sight(e.clientX, e.clientY), question });
}
function ask(e: PointerEvent): void {
  lastPointer = e;
  again = asked;
  if (asked || !shown || shownLive) return;
  asked = true;
  question++;
  asked = pick(e);
}

function onPicked(event: Picked): void {
  picked = event;
  showPicked(event);
  const act = acts.get(event.question);
  if (act) {
    acts.delete(event.question);
    return act();
  }
  asked = false;
  if (again && lastPointer) ask(lastPointer);
}

function showPicked(event: Picked): void {
  if (!event.at || !lastPointer) {
    tip.hidden = true;
    editing.hovered([]);
    view.grid.mark(editing.nodes);
    view.redraw();
    return;
  }
  const ends = event.node_first && event.node !== null ? [event.node] : (event.member ?? []);
  view.grid.mark([...editing.nodes, ...ends]);
  view.redraw();
  tip.replaceChildren(...event.facts.map((f) => el("div", {}, [el("span", {}, [f.label]), f.value])));
  const box = stage.getBoundingClientRect();
  tip.style.left = `${Math.min(lastPointer.clientX - box.left + 16, box.width - 230)}px`;
  tip.style.top = `${Math.min(lastPointer.clientY - box.top + 16, box.height - 110)}px`;
  tip.hidden = false;
  if (pressed(editToggle) && event.member) {
    link.send({ kind: "hover", run: shown, nodes: event.member, question: event.question });
  }
}

let boxFrom: [number, number] | null = null;
view.canvas.addEventListener("pointermove", (e) => {
  if (boxFrom) {
    const box = stage.getBoundingClientRect();
    const x = [boxFrom[0], e.clientX].map((v) => v - box.left).sort((a, b) => a - b);
    const y = [boxFrom[1], e.clientY].map((v) => v - box.top).sort((a, b) => a - b);
    rubber.style.cssText = `left:${x[0]}px;top:${y[0]}px;width:${x[1]! - x[0]!}px;height:${y[1]! - y[0]!}px`;
    rubber.hidden = false;
    return;
  }
  if (e.buttons === 0) ask(e);
  else tip.hidden = true;
});
view.canvas.addEventListener("pointerleave", () => {
  tip.hidden = true;
});
view.canvas.addEventListener("pointerdown", (e) => {
  pressedAt = [e.clientX, e.clientY];
  if (e.shiftKey && pressed(editToggle)) {
    boxFrom = [e.clientX, e.clientY];
    view.rotates(false);
  }
});
view.canvas.addEventListener("pointerup", (e) => {
  if (!boxFrom) return;
  const box = view.canvas.getBoundingClientRect();
  const x = [boxFrom[0], e.clientX].map((v) => ((v - box.left) / box.width) * 2 - 1).sort((a, b) => a - b);
  const y = [boxFrom[1], e.clientY].map((v) => 1 - ((v - box.top) / box.height) * 2).sort((a, b) => a - b);
  boxFrom = null;
  rubber.hidden = true;
  view.rotates(true);
  const rectangle: [number, number, number, number] = [x[0]!, y[0]!, x[1]!, y[1]!];
  link.send({ kind: "select", run: shown, matrix: view.matrix(), rectangle });
});
let pressedAt: [number, number] = [0, 0];
view.canvas.addEventListener("click", (e) => {
  // Turning the view ends with a click too.
  if (Math.hypot(e.clientX - pressedAt[0], e.clientY - pressedAt[1]) <= 4) settled(clicked);
});

function clicked(): void {
  if (drawn && picked?.at) return draw([...drawn, pointed(picked)]);
  if (grabbed !== null && picked?.at) {
    editing.onEdit?.({ op: "move", node: grabbed, to: picked.at });
    grabbed = null;
    return;
  }
  if (!pressed(measureToggle) || !picked?.at) return;
  const at = pointed(picked);
  if (from) {
    link.send({ kind: "distance", from, to: at });
    from = null;
  } else {
    from = at;
  }
}

/** The node under the pointer, else the place. */
function pointed(at: Picked): Point {
  return (at.node_first && at.node_at) || at.at!;
}

/** The guide that is being drawn. */
let drawn: Point[] | null = null;
function draw(points: Point[] | null): void {
  drawn = points;
  view.draws(points ?? []);
}

/* Keys and edits. */
editing.onEdit = (edit) => link.send({ kind: "edit", run: shown, edit });
editing.onUndo = () => link.send({ kind: "undo", run: shown });
editing.onRedo = () => link.send({ kind: "redo", run: shown });
editing.onSuggest = () => {
  if (!shown) return;
  editing.looking();
  link.send({ kind: "suggest", run: shown });
};
editing.onPoint = (nodes) => {
  view.grid.mark(nodes);
  view.redraw();
};
recovery.onRecover = (session) => link.send({ kind: "recover", session });
recovery.onDiscard = (session) => link.send({ kind: "discard", session });
candidates.onOpen = () => link.send({ kind: "candidates", run: shown });
candidates.onShow = (index) => link.send({ kind: "candidate", run: shown, index });
candidates.onTake = (index) => link.send({ kind: "take", run: shown, index });
report.onStage = (stage) => link.send({ kind: "look", run: shown, stage });

const OPERATIONS: Record<string, string> = { f: "flip", s: "split", c: "collapse", d: "drift" };

document.addEventListener("keydown", (e) => {
  const typing = e.target instanceof HTMLInputElement || e.target instanceof HTMLTextAreaElement;
  if (e.key === "Enter" && (e.ctrlKey || e.metaKey)) return start();
  if (e.key === "s" && (e.ctrlKey || e.metaKey)) {
    e.preventDefault();
    return save.click();
  }
  if (typing || e.target instanceof HTMLSelectElement) return;
  const key = e.key.toLowerCase();
  if ((e.ctrlKey || e.metaKey) && key === "z") {
    e.preventDefault();
    link.send(e.shiftKey ? { kind: "redo", run: shown } : { kind: "undo", run: shown });
    return;
  }
  if (e.ctrlKey || e.metaKey || e.altKey) return;
  if (key === "escape") return cancelAll();
  if (key === "enter" && drawn) {
    // Not the button that has the focus.
    e.preventDefault();
    return settled(() => {
      if (drawn) editing.onEdit?.({ op: "add_guide", points: drawn });
      draw(null);
    });
  }
  if (key === "e") return editToggle.click();
  if (key === "m") return measureToggle.click();
  const side = sides.find((s) => s[2] === key);
  if (side) return look(side[0]);
  if (pressed(editToggle)) settled(() => editAt(key));
});

/** The node that is moved by the next click. */
let grabbed: number | null = null;

/** Edits of the node or place under the pointer. */
function editAt(key: string): void {
  if (!picked?.at) return;
  const op = OPERATIONS[key];
  if (op && picked.member) editing.onEdit?.({ op, nodes: picked.member });
  if (key === "a") editing.onEdit?.({ op: "add_anchor", at: picked.at });
  if (key === "l") {
    if (!drawn) say("click the points of the guide; Enter lays it, Escape drops it");
    draw([...(drawn ?? []), pointed(picked)]);
  }
  const node = picked.node_first ? picked.node : null;
  if (key === "r" && node === null && picked.member)
    editing.onEdit?.({ op: "remove_guide", nodes: picked.member });
  if (node === null) return;
  if (key === "r") editing.onEdit?.({ op: "remove_anchor", node });
  if (key === "p") editing.onEdit?.({ op: "pin", node });
  if (key === "u") editing.onEdit?.({ op: "unpin", node });
  if (key === "g") {
    grabbed = node;
    say(`node ${node} goes to where you click next`);
  }
}

function cancelAll(): void {
  grabbed = null;
  draw(null);
  if (going || working !== null) link.send({ kind: "cancel" });
  editing.selected([], 0);
  view.grid.mark([]);
  view.redraw();
}

/* Light and dark. */
const dark = matchMedia("(prefers-color-scheme: dark)");
let chosen: "light" | "dark" | null = null;
function dress(): void {
  const name = chosen ?? (dark.matches ? "dark" : "light");
  document.documentElement.dataset["theme"] = name;
  candidates.draw();
  view.dress(THEMES[name]);
  viewB?.dress(THEMES[name]);
}
theme.onclick = () => {
  chosen = document.documentElement.dataset["theme"] === "dark" ? "light" : "dark";
  dress();
};
dark.addEventListener("change", dress);
dress();
report.show(null);
look("perspective");

let hiding: ReturnType<typeof setTimeout> | undefined;
function say(message: string, bad = false): void {
  toast.textContent = message;
  toast.classList.toggle("bad", bad);
  toast.hidden = false;
  clearTimeout(hiding);
  hiding = setTimeout(() => (toast.hidden = true), bad ? 12_000 : 5000);
}

/** For tests and measuring: what the page has seen. */
Object.assign(window, {
  studio: {
    get seen() {
      return { firstFrame, firstGrid, liveFrames, shown, announced, drawn: view.drawn, runs, picked };
    },
    get speed() {
      return { spent: view.spent, calls: view.calls };
    },
    get irregular() {
      return view.grid.irregular();
    },
    project: (p: [number, number, number]) => view.project(p),
  },
});
