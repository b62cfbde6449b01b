// The candidates of a run as thumbnails: a click shows one in the view, and it can be taken instead of the best.
import { el } from "./dom";
import { type Frame, floats } from "./link";
import type { CandidateRow, RunInfo } from "./messages";

/** Width and height of a thumbnail on the screen, pixels. */
const SIZE = 96;

export class Candidates {
  readonly element = el("details", { class: "section candidates", hidden: true });
  /** The list was opened: their pictures are wanted. */
  onOpen: (() => void) | null = null;
  onShow: ((index: number) => void) | null = null;
  onTake: ((index: number) => void) | null = null;
  private readonly title = el("summary", {}, ["Candidates"]);
  private readonly list = el("div", { class: "thumbs", role: "listbox", "aria-label": "Candidates" });
  private readonly take = el("button", { type: "button", id: "take", disabled: true }, ["Take it"]);
  private readonly told = el("p", { class: "hint" });
  private readonly pictures: HTMLCanvasElement[] = [];
  private run = 0;
  private chosen = -1;
  private frame: Frame | null = null;

  constructor() {
    const row = el("div", { class: "row" }, [this.take, this.told]);
    this.element.append(this.title, this.list, row);
    this.element.ontoggle = () => this.element.open && this.onOpen?.();
    this.take.onclick = () => this.onTake?.(this.chosen);
  }

  show(info: RunInfo | null): void {
    const rows = info?.candidates ?? [];
    this.element.hidden = rows.length < 2;
    const same = info?.summary.run === this.run;
    if (same || !info) return;
    this.run = info.summary.run;
    [this.chosen, this.frame] = [-1, null];
    this.title.textContent = `Candidates (${rows.length})`;
    this.pictures.length = 0;
    this.list.replaceChildren(...rows.map((row, k) => this.thumbnail(row, k)));
    this.choose(-1);
    if (this.element.open) this.onOpen?.();
  }

  /** Another grid is shown: none of these is. */
  choose(index: number): void {
    this.chosen = index;
    this.take.disabled = index <= 0;
    this.told.textContent =
      index < 0
        ? "As they were when the best was chosen; a click shows one."
        : index === 0
          ? "It was the best, and is the grid."
          : "Relaxes it, and keeps it beside the others.";
    [...this.list.children].forEach((c, k) => c.setAttribute("aria-selected", String(k === index)));
  }

  /** Their pictures have come. */
  draw(frame: Frame | null = this.frame): void {
    if (!frame || frame.run !== this.run) return;
    this.frame = frame;
    const style = getComputedStyle(document.documentElement);
    this.pictures.forEach((canvas, k) => {
      const members = floats(frame, `members${k}`);
      canvas.hidden = members.length === 0;
      const pixels = Math.min(devicePixelRatio, 2);
      canvas.width = canvas.height = SIZE * pixels;
      const context = canvas.getContext("2d");
      if (!context) return;
      context.scale(SIZE * pixels, -SIZE * pixels);
      context.translate(0.03, -0.97);
      context.scale(0.94, 0.94);
      context.lineWidth = 0.4 / SIZE;
      context.strokeStyle = style.getPropertyValue("--soft");
      context.beginPath();
      for (let m = 0; m < members.length; m += 4) {
        context.moveTo(members[m]!, members[m + 1]!);
        context.lineTo(members[m + 2]!, members[m + 3]!);
      }
      context.stroke();
      dots(context, floats(frame, `few${k}`), "#15181c");
      dots(context, floats(frame, `many${k}`), "#ffffff");
    });
  }

  private thumbnail(row: CandidateRow, index: number): HTMLElement {
    const canvas = el("canvas", { width: SIZE, height: SIZE, hidden: true });
    this.pictures.push(canvas);
    const q = row.fluency === null ? "∞" : row.fluency.toFixed(1);
    const title = `${row.start}, ${row.heats} heats, merit ${row.merit.toFixed(2)}, seed ${row.seed}`;
    return el(
      "button",
      { type: "button", class: "thumb", role: "option", "aria-selected": "false", title },
      [
        canvas,
        el("b", {}, [`${index + 1}${index === 0 ? " kept" : ""}`]),
        el("span", {}, [`Q ${q} · r ${(100 * row.cv).toFixed(1)} %`]),
      ],
      {
        onclick: () => {
          this.choose(index);
          this.onShow?.(index);
        },
      },
    );
  }
}

function dots(context: CanvasRenderingContext2D, at: Float32Array, color: string): void {
  context.fillStyle = color;
  for (let k = 0; k < at.length; k += 2) {
    context.beginPath();
    context.arc(at[k]!, at[k + 1]!, 1.8 / SIZE, 0, 2 * Math.PI);
    context.fill();
    context.stroke();
  }
}
