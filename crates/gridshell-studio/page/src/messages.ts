// Generated from message.rs: run `GRIDSHELL_BLESS=1 cargo test -p gridshell-studio`.
export type Request = { "kind": "open", 
/**
 * Its name.
 */
name: string, } | { "kind": "choose", 
/**
 * Layers by name, those below them included.
 */
layers: Array<string>, 
/**
 * Objects by name.
 */
objects: Array<string>, } | { "kind": "estimate", 
/**
 * Values of the form by key.
 */
values: Record<string, unknown>, } | { "kind": "generate", 
/**
 * Values of the form by key.
 */
values: Record<string, unknown>, } | { "kind": "cancel" } | { "kind": "look", 
/**
 * Which run.
 */
run: number, 
/**
 * The stage whose grid is wanted; the last one's without it.
 */
stage: string | null, } | { "kind": "color", 
/**
 * Which run.
 */
run: number, 
/**
 * One of the colorings that [`Hello`] lists.
 */
by: string, } | { "kind": "pick", 
/**
 * Which run.
 */
run: number, 
/**
 * A point of the line of sight, metres.
 */
origin: [number, number, number], 
/**
 * Its direction, away from the eye.
 */
direction: [number, number, number], 
/**
 * Number of the question, to be repeated in the answer.
 */
question: number, } | { "kind": "select", 
/**
 * Which run.
 */
run: number, 
/**
 * World to screen, column by column; the rectangle is from -1 to 1.
 */
matrix: Array<number>, 
/**
 * Left, bottom, right, top, each from -1 to 1.
 */
rectangle: [number, number, number, number], } | { "kind": "distance", 
/**
 * One, metres.
 */
from: [number, number, number], 
/**
 * The other.
 */
to: [number, number, number], } | { "kind": "edit", 
/**
 * Which run.
 */
run: number, 
/**
 * The edit as it stands in logs: `op`, `nodes` ...
 */
edit: Record<string, unknown>, } | { "kind": "candidates", 
/**
 * Which run.
 */
run: number, } | { "kind": "candidate", 
/**
 * Of which run.
 */
run: number, 
/**
 * Its place in the list, from 0.
 */
index: number, } | { "kind": "take", 
/**
 * Of which run.
 */
run: number, 
/**
 * Its place in the list, from 0.
 */
index: number, } | { "kind": "undo", 
/**
 * Of which run.
 */
run: number, } | { "kind": "redo", 
/**
 * Of which run.
 */
run: number, } | { "kind": "hover", 
/**
 * Which run.
 */
run: number, 
/**
 * The member.
 */
nodes: [number, number], 
/**
 * Number of the question, to be repeated in the answer.
 */
question: number, } | { "kind": "suggest", 
/**
 * Which run.
 */
run: number, } | { "kind": "saved", 
/**
 * Which run.
 */
run: number, 
/**
 * The version that the file's answer told.
 */
version: number, } | { "kind": "forget", 
/**
 * Which one.
 */
run: number, } | { "kind": "recover", 
/**
 * Its name.
 */
session: string, } | { "kind": "discard", 
/**
 * Its name.
 */
session: string, };
export type Event = { "kind": "hello" } & Hello | { "kind": "surface" } & SurfaceInfo | { "kind": "estimate", 
/**
 * Wanted member length, metres.
 */
edge_length: number, 
/**
 * About so many nodes.
 */
nodes: number, } | { "kind": "progress" } & Progress | { "kind": "idle", 
/**
 * The last one's number, where it gave a grid.
 */
run: number | null, } | { "kind": "runs", 
/**
 * In one line each.
 */
runs: Array<RunSummary>, 
/**
 * The one that was laid last.
 */
newest: number | null, } | { "kind": "run" } & RunInfo | { "kind": "picked" } & Picked | { "kind": "selected", 
/**
 * Which run.
 */
run: number, 
/**
 * Their numbers.
 */
nodes: Array<number>, 
/**
 * Of those irregular.
 */
irregular: number, } | { "kind": "distance", 
/**
 * Straight, metres.
 */
straight: number, 
/**
 * In plan, metres.
 */
plan: number, 
/**
 * In height, metres.
 */
height: number, } | { "kind": "hovered", 
/**
 * Which run.
 */
run: number, 
/**
 * The number of the question.
 */
question: number, 
/**
 * The operations.
 */
ways: Array<Step>, } | { "kind": "suggested", 
/**
 * Which run.
 */
run: number, 
/**
 * See the field before.
 */
steps: Array<Step>, } | { "kind": "recipe", 
/**
 * Number of the grid.
 */
run: number, 
/**
 * Values of the form by key.
 */
values: Record<string, unknown>, } | { "kind": "left", 
/**
 * See the field before.
 */
sessions: Array<Left>, 
/**
 * So many more are offered when these are dealt with.
 */
more: number, } | { "kind": "put_away", 
/**
 * A line on each.
 */
grids: Array<string>, } | { "kind": "autosave", 
/**
 * Why they cannot be; null where they are.
 */
fault: string | null, } | { "kind": "history", 
/**
 * Which run.
 */
run: number, 
/**
 * What was done before its file was written, in words, the oldest first; it cannot be undone.
 */
before: Array<string>, 
/**
 * What was done, the oldest first.
 */
done: Array<Step>, 
/**
 * What was taken back, the next to be done again first.
 */
undone: Array<Step>, } | { "kind": "working", 
/**
 * To which run.
 */
run: number, 
/**
 * What, in words.
 */
what: string, 
/**
 * Share that is done, 0 to 1.
 */
fraction: number, } | { "kind": "worked" } | { "kind": "fault", 
/**
 * What was asked for: `open`, `generate`, `estimate`, `message` ...
 */
about: string, 
/**
 * Why, and what to do.
 */
message: string, };
export type Hello = { 
/**
 * Version of gridshell.
 */
version: string, 
/**
 * The built-in surfaces.
 */
builtins: Array<Named>, 
/**
 * The recipe's fields.
 */
form: Array<Field>, 
/**
 * What grids can be colored by.
 */
colorings: Array<Coloring>, 
/**
 * Extensions of the files that can be opened.
 */
accepts: Array<string>, 
/**
 * Extensions of the files that can be exported.
 */
exports: Array<Named>, 
/**
 * Largest file that can be opened, bytes.
 */
upload_limit: number, };
export type Named = { 
/**
 * What stands in messages.
 */
name: string, 
/**
 * For people.
 */
description: string, };
export type Field = { 
/**
 * Its name in messages: the path in the recipe, with points.
 */
key: string, 
/**
 * For people.
 */
label: string, 
/**
 * Unit, or empty.
 */
unit: string, 
/**
 * One line of help.
 */
help: string, 
/**
 * Heading that it stands under.
 */
group: string, 
/**
 * How it is given.
 */
control: Control, 
/**
 * What it is until it is given; null where the surface decides.
 */
value: unknown, };
export type Control = { "kind": "number", 
/**
 * Least.
 */
min: number, 
/**
 * Largest.
 */
max: number, 
/**
 * A sensible step.
 */
step: number, 
/**
 * Whether it may be left empty.
 */
optional: boolean, } | { "kind": "choice", 
/**
 * What there is.
 */
options: Array<Named>, } | { "kind": "points" } | { "kind": "vector" };
export type Coloring = { 
/**
 * Its name in messages.
 */
name: string, 
/**
 * For people.
 */
label: string, 
/**
 * One line of help.
 */
help: string, };
export type SurfaceInfo = { 
/**
 * Built-in name or file stem.
 */
name: string, 
/**
 * Whether it is built in.
 */
built_in: boolean, 
/**
 * Where it comes from.
 */
source: string, 
/**
 * What to know of it.
 */
facts: Array<Fact>, 
/**
 * The parts, where there are several.
 */
parts: Array<Part>, 
/**
 * The objects of its file, where the format knows any.
 */
objects: Array<Object>, 
/**
 * What was skipped or repaired.
 */
notes: Array<string>, 
/**
 * A sensible edge length, metres.
 */
edge_length: number, 
/**
 * Least and largest coordinates, metres.
 */
bounds: [[number, number, number], [number, number, number]], };
export type Part = { 
/**
 * Counted from 1.
 */
number: number, 
/**
 * Names of the file's objects that it is made of.
 */
name: string, 
/**
 * Number of faces.
 */
faces: number, 
/**
 * Area, square metres.
 */
area: number, 
/**
 * Why no grid can be laid on it.
 */
fault: string | null, };
export type Object = { 
/**
 * Its name, or empty.
 */
name: string, 
/**
 * The layer it is on, or empty.
 */
layer: string, 
/**
 * What it is: `brep`, `mesh` ...
 */
kind: string, 
/**
 * Faces read from it; 0 where it was left out.
 */
faces: number, };
export type Left = { 
/**
 * Its name.
 */
session: string, 
/**
 * When its last grid was kept: seconds since 1970, UTC.
 */
seconds: number, 
/**
 * A line on each of its grids.
 */
grids: Array<string>, 
/**
 * Those that cannot be recovered.
 */
damaged: Array<Damaged>, 
/**
 * The folder that they are in.
 */
folder: string, };
export type Damaged = { 
/**
 * Its name in its session's folder.
 */
file: string, 
/**
 * What is wrong with it.
 */
reason: string, };
export type Fact = { 
/**
 * Its name.
 */
label: string, 
/**
 * The figure, with its unit.
 */
value: string, };
export type Progress = { 
/**
 * Number of the run.
 */
run: number, 
/**
 * Whether this is the quick one that is shown before.
 */
draft: boolean, 
/**
 * `prepare`, `surface`, `fix`, `flatten`, `pack`, `triangulate`, `regularize`, `relax` or `measure`.
 */
stage: string, 
/**
 * Share of the stage, 0 to 1.
 */
fraction: number, 
/**
 * Since it began, seconds.
 */
seconds: number, };
export type RunSummary = { 
/**
 * Its number.
 */
run: number, 
/**
 * The surface and what was asked for.
 */
title: string, 
/**
 * Effort, seed.
 */
detail: string, 
/**
 * Number of nodes.
 */
nodes: number, 
/**
 * Fluency; null when it is infinite.
 */
fluency: number | null, 
/**
 * Irregular nodes.
 */
irregular: number, 
/**
 * Whether it has changes by hand that are in no file of the user's.
 */
unsaved: boolean, };
export type RunInfo = { 
/**
 * In one line.
 */
summary: RunSummary, 
/**
 * Wanted member length, metres.
 */
edge_length: number, 
/**
 * Whether it was stopped early.
 */
stopped: boolean, 
/**
 * All measures.
 */
measures: Array<Measure>, 
/**
 * How lengths, shapes ... are spread.
 */
histograms: Array<Histogram>, 
/**
 * The stages in their order.
 */
stages: Array<StageRow>, 
/**
 * The candidates, the one kept first.
 */
candidates: Array<CandidateRow>, 
/**
 * What the user should know.
 */
warnings: Array<string>, };
export type Measure = { 
/**
 * Its name in run documents.
 */
key: string, 
/**
 * For people.
 */
label: string, 
/**
 * Its value, as it is to be read.
 */
value: string, 
/**
 * What it cannot fall below, or exceed.
 */
floor: string | null, 
/**
 * Unit, or empty.
 */
unit: string, 
/**
 * One line of help.
 */
help: string, 
/**
 * Heading that it stands under.
 */
group: string, 
/**
 * Whether it tells of something wrong.
 */
bad: boolean, };
export type Histogram = { 
/**
 * What is counted.
 */
title: string, 
/**
 * Unit, or empty.
 */
unit: string, 
/**
 * Where the bins begin and end: one more than there are counts.
 */
edges: Array<number>, 
/**
 * How many in each bin.
 */
counts: Array<number>, };
export type StageRow = { 
/**
 * `pack`, `triangulate`, `regularize` or `relax`.
 */
name: string, 
/**
 * Time it took.
 */
seconds: number, 
/**
 * Whether it came to its own end.
 */
converged: boolean, 
/**
 * Irregular nodes after it.
 */
irregular: number | null, 
/**
 * mu after it.
 */
mu: number | null, 
/**
 * Mean angle fluency index, degrees.
 */
delta_deg: number | null, 
/**
 * Length spread.
 */
cv: number | null, 
/**
 * Fluency.
 */
fluency: number | null, 
/**
 * What it did.
 */
notes: Array<string>, };
export type CandidateRow = { 
/**
 * Its seed, in full.
 */
seed: string, 
/**
 * `lattice` or `random`.
 */
start: string, 
/**
 * Heats it came through.
 */
heats: number, 
/**
 * What it was judged by.
 */
merit: number, 
/**
 * Fluency.
 */
fluency: number | null, 
/**
 * Length spread.
 */
cv: number, };
export type Picked = { 
/**
 * Which run.
 */
run: number, 
/**
 * The number of the question.
 */
question: number, 
/**
 * Where the line of sight meets the grid, metres; null where it does not.
 */
at: [number, number, number] | null, 
/**
 * The nearest node.
 */
node: number | null, 
/**
 * Its position, metres.
 */
node_at: [number, number, number] | null, 
/**
 * The nearest member.
 */
member: [number, number] | null, 
/**
 * Its ends, metres.
 */
member_at: [[number, number, number], [number, number, number]] | null, 
/**
 * Whether the node is nearer than the member.
 */
node_first: boolean, 
/**
 * What to know of them.
 */
facts: Array<Fact>, };
export type Step = { 
/**
 * The edit as it stands in logs.
 */
edit: Record<string, unknown>, 
/**
 * In words.
 */
label: string, 
/**
 * What it does to the figures, in words; empty where it is refused.
 */
effect: string, 
/**
 * Why it is refused.
 */
refusal: string | null, 
/**
 * Whether the grid is better for it.
 */
better: boolean, 
/**
 * Where it is, metres.
 */
at: [number, number, number] | null, };
export type FrameHead = { 
/**
 * What it shows.
 */
shows: Shows, 
/**
 * Number of the run; 0 for a surface.
 */
run: number, 
/**
 * The arrays.
 */
arrays: Array<ArrayHead>, 
/**
 * The scale, where values to color by are among them.
 */
scale: Scale | null, };
export type Shows = "surface" | "bubbles" | "live" | "grid" | "stage" | "candidates" | "colors";
export type ArrayHead = { 
/**
 * Its name.
 */
name: string, 
/**
 * `f32` or `u32`.
 */
of: string, 
/**
 * Number of numbers.
 */
length: number, };
export type Scale = { 
/**
 * The coloring's name.
 */
by: string, 
/**
 * What is shown, with its unit.
 */
title: string, 
/**
 * What has colors: `members`, `panels` or `nodes`.
 */
on: string, 
/**
 * The colors of the steps, `#rrggbb`.
 */
inks: Array<string>, 
/**
 * What stands where on the scale.
 */
labels: Array<Label>, 
/**
 * What else to know, or empty.
 */
note: string, 
/**
 * Whether every node has a color.
 */
all_nodes: boolean, };
export type Label = { 
/**
 * Where, from 0 to 1.
 */
at: number, 
/**
 * What is there.
 */
text: string, };
