// The studio's page: what stands where, and who works with whom.
import "./style.css";
import { clean } from "./address";
import { Coloring } from "./coloring";
import { Comparing } from "./comparing";
import { Doing } from "./doing";
import { el } from "./dom";
import { Dressing } from "./dressing";
import { Edits } from "./edits";
import { Keeping } from "./keeping";
import { listen } from "./keys";
import { Link } from "./link";
import { Measuring } from "./measuring";
import { Notices } from "./notices";
import { Opening } from "./opening";
import { Pointing } from "./pointing";
import { Recipe } from "./recipe";
import { Runs } from "./runs";
import { expose } from "./seen";
import { Store } from "./store";
import { Taking } from "./taking";
import { Toast } from "./toast";
import { Views } from "./views";

void clean();
const store = new Store();
const link = new Link();
const toast = new Toast();
const notices = new Notices();
const views = new Views(store, link);
const doing = new Doing(store, link);
const recipe = new Recipe(store, link, views);
const opening = new Opening(store, recipe, toast.say, link);
const runs = new Runs(store, link);
const comparing = new Comparing(store, link, views);
const coloring = new Coloring(store, link, views);
const pointing = new Pointing(store, link, views);
const edits = new Edits(store, link, views, pointing, toast.say);
const measuring = new Measuring(store, link, toast.say);
const taking = new Taking(store, link, views, notices, toast.say);
const keeping = new Keeping(link, notices, toast.say);
const dressing = new Dressing(store);

const header = el("header", {}, [
  el("h1", {}, ["gridshell ", el("span", {}, ["studio"])]),
  doing.status,
  dressing.button,
]);
/* What is wanted. */
const left = el("aside", { class: "left", "aria-label": "Surface and recipe" }, [
  opening.element,
  el("section", { class: "recipe" }, [recipe.form.element]),
  el("section", { class: "go" }, [
    recipe.estimate,
    el("div", { class: "row" }, [recipe.generate, doing.cancel]),
    doing.stages,
  ]),
]);
/* What is there. */
const toolbar = el("div", { class: "toolbar", role: "toolbar", "aria-label": "View" }, [
  views.sides,
  views.slice,
  views.surface,
  measuring.toggle,
  edits.toggle,
  comparing.toggle,
  el("span", { class: "gap" }),
  coloring.select,
  taking.saveButton,
  taking.picture,
  taking.formats,
]);
const { stage } = views;
stage.append(coloring.legend, pointing.tip, pointing.rubber, keeping.recovery.element, toast.element);
const centre = el("main", { class: "centre" }, [toolbar, notices.element, stage, runs.tabs]);
/* What it is worth. */
const right = el("aside", { class: "right", "aria-label": "Measures" }, [
  edits.panel.element,
  runs.report.element,
  runs.candidates.element,
]);
document.getElementById("app")!.append(header, left, centre, right);

opening.dropsOn(stage);
store.on("editing", (on) => {
  stage.classList.toggle("editing", on);
  if (on) right.scrollTop = 0;
});
pointing.onClick = () => {
  if (!edits.click()) measuring.click();
};
link.on("fault", ({ about, message }) => {
  if (about === "estimate") recipe.estimate.textContent = message;
  else toast.say(message, true);
});
listen({
  generate: () => recipe.start(),
  save: () => taking.save(),
  undo: () => edits.undo(),
  redo: () => edits.redo(),
  cancel: () => {
    edits.drop();
    doing.stop();
  },
  edit: () => edits.toggle.click(),
  measure: () => measuring.toggle.click(),
  lay: () => edits.lay(),
  look: (key) => views.key(key),
  other: (key) => edits.key(key),
});
expose(store, link, views.first);
dressing.dress();
views.look("perspective");
