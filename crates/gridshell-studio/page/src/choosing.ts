// What a file holds: its parts, of which a grid is laid on one or all, and its layers and objects, of which some are
// read.
import { el, figure } from "./dom";
import type { Part, SurfaceInfo } from "./messages";

/** Longer lists begin closed. */
const SHORT = 8;

export class Choosing {
  readonly element = el("div", { class: "choosing" });
  /** A part was chosen: its number or `all`. */
  onPart: ((part: string) => void) | null = null;
  /** A part is pointed at; 0 when none is any more. */
  onPoint: ((part: number) => void) | null = null;
  onChoose: ((layers: string[], objects: string[]) => void) | null = null;

  show(info: SurfaceInfo): void {
    this.element.replaceChildren(...this.parts(info.parts), ...this.objects(info));
  }

  /** Which part is chosen in the form. */
  chosen(part: string): void {
    for (const input of this.element.querySelectorAll<HTMLInputElement>("[name=of-parts]"))
      input.checked = input.value === part;
  }

  private parts(parts: Part[]): HTMLElement[] {
    if (!parts.length) return [];
    const radio = (value: string, label: string) =>
      el("label", {}, [
        el("input", { type: "radio", name: "of-parts", value, checked: value === "all" }, [], {
          onchange: () => this.onPart?.(value),
        }),
        label,
      ]);
    const rows = parts.map((part) => {
      const number = String(part.number);
      const name = part.name || `Part ${number}`;
      return el(
        "tr",
        { title: part.fault ?? `Part ${number}: ${name}`, class: part.fault ? "bad" : "" },
        [
          el("th", { scope: "row" }, [radio(number, name)]),
          el("td", {}, [part.faces === 1 ? "1 face" : `${part.faces} faces`]),
          el("td", {}, [part.fault ? "no surface" : `${figure(part.area)} m²`]),
        ],
        { onmouseenter: () => this.onPoint?.(part.number), onmouseleave: () => this.onPoint?.(0) },
      );
    });
    const area = parts.reduce((sum, part) => sum + part.area, 0);
    const all = el("tr", {}, [
      el("th", { scope: "row" }, [radio("all", `All ${parts.length}`)]),
      el("td", {}, []),
      el("td", {}, [`${figure(area)} m²`]),
    ]);
    return [
      el("details", { class: "list", id: "parts", open: parts.length < SHORT }, [
        el("summary", {}, [`Parts (${parts.length}): lay the grid on`]),
        el("table", {}, [el("tbody", {}, [all, ...rows])]),
      ]),
    ];
  }

  private objects(info: SurfaceInfo): HTMLElement[] {
    const { objects } = info;
    if (!objects.length) return [];
    const box = (kind: string, value: string, checked: boolean) =>
      el("input", { type: "checkbox", "data-kind": kind, value, checked });
    const layers = [...new Set(objects.map((o) => o.layer))];
    const rows = layers.flatMap((layer) => {
      const own = objects.filter((o) => o.layer === layer);
      const read = own.some((o) => o.faces > 0);
      const head = el("tr", { class: "layer" }, [
        el("th", { scope: "row", colspan: 2 }, [
          el("label", {}, [layer && box("layer", layer, read), layer || "On no layer"]),
        ]),
        el("td", {}, []),
      ]);
      const each = own.map((o) =>
        el("tr", { class: o.faces ? "" : "out" }, [
          el("th", { scope: "row" }, [
            el("label", {}, [o.name && box("object", o.name, o.faces > 0), o.name || "unnamed"]),
          ]),
          el("td", {}, [o.kind]),
          el("td", {}, [o.faces === 0 ? "left out" : o.faces === 1 ? "1 face" : `${o.faces} faces`]),
        ]),
      );
      return [head, ...each];
    });
    const read = el("button", { type: "button", id: "read-chosen" }, ["Read chosen"], {
      onclick: () => {
        const [layers, names] = [this.changed("layer"), this.changed("object")];
        if (layers.length + names.length) this.onChoose?.(layers, names);
      },
    });
    const all = el(
      "button",
      { type: "button", class: "quiet", title: "All that the file shows" },
      ["All shown"],
      { onclick: () => this.onChoose?.([], []) },
    );
    return [
      el("details", { class: "list", id: "objects", open: objects.length < SHORT }, [
        el("summary", {}, [`Layers and objects (${objects.length})`]),
        el("table", {}, [el("tbody", {}, rows)]),
        el("div", { class: "row" }, [read, all]),
      ]),
    ];
  }

  /** Names that are checked, if that was changed. */
  private changed(kind: string): string[] {
    const boxes = [...this.element.querySelectorAll<HTMLInputElement>(`[data-kind=${kind}]`)];
    if (boxes.every((b) => b.checked === b.defaultChecked)) return [];
    return boxes.filter((b) => b.checked).map((b) => b.value);
  }
}
