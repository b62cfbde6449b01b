// The recipe's form, made of what the server says of it.
import { el } from "./dom";
import type { Field } from "./messages";

export class Form {
  readonly element = el("form", { class: "form", autocomplete: "off" });
  onChange: (() => void) | null = null;
  private readonly inputs = new Map<string, HTMLInputElement | HTMLSelectElement | HTMLTextAreaElement>();
  private fields: Field[] = [];

  constructor() {
    this.element.addEventListener("submit", (e) => e.preventDefault());
    this.element.addEventListener("input", () => this.onChange?.());
  }

  build(fields: Field[]): void {
    if (this.fields.length) return;
    this.fields = fields;
    const groups = new Map<string, HTMLElement>();
    for (const field of fields) {
      let group = groups.get(field.group);
      if (!group) {
        const open = groups.size === 0;
        group = el("div", { class: "fields" });
        this.element.append(
          el("details", { class: "group", open }, [el("summary", {}, [field.group]), group]),
        );
        groups.set(field.group, group);
      }
      group.append(this.row(field));
    }
  }

  /** The names of the parts; empty where they have none. */
  parts(names: string[]): void {
    const select = this.inputs.get("part");
    if (!(select instanceof HTMLSelectElement)) return;
    const several = names.map(
      (name, k) => new Option(name ? `${k + 1}: ${name}` : `Part ${k + 1}`, String(k + 1)),
    );
    const all = new Option("All", "all");
    select.replaceChildren(
      ...(several.length ? [all, ...several] : [new Option("The only one", "one"), all]),
    );
  }

  /** What the surface decides where nothing is given. */
  suggest(key: string, value: string): void {
    const input = this.inputs.get(key);
    if (input instanceof HTMLInputElement) input.placeholder = value;
  }

  /** The recipe of a file can be chosen as the method. */
  file(): void {
    const method = this.inputs.get("method");
    if (!(method instanceof HTMLSelectElement) || method.querySelector("[value=file]")) return;
    method.append(new Option("As in the file", "file"));
  }

  /** It cannot any more. */
  noFile(): void {
    const method = this.inputs.get("method");
    if (!(method instanceof HTMLSelectElement)) return;
    if (method.value === "file") for (const field of this.fields) this.set(field.key, text(field.value));
    method.querySelector("[value=file]")?.remove();
  }

  /** Take these values over. */
  apply(values: Record<string, unknown>): void {
    for (const field of this.fields) this.set(field.key, text(values[field.key]));
  }

  values(): Record<string, unknown> {
    const values: Record<string, unknown> = {};
    for (const field of this.fields) {
      const input = this.inputs.get(field.key);
      if (!input) continue;
      const text = input.value.trim();
      values[field.key] = text === "" ? null : field.control.kind === "number" ? Number(text) : text;
    }
    return values;
  }

  get(key: string): string {
    return this.inputs.get(key)?.value ?? "";
  }

  set(key: string, value: string): void {
    const input = this.inputs.get(key);
    if (input) input.value = value;
  }

  private row(field: Field): HTMLElement {
    const id = `field-${field.key}`;
    const input = this.input(field, id);
    this.inputs.set(field.key, input);
    const unit = field.unit ? el("span", { class: "unit" }, [field.unit]) : null;
    const wide = field.control.kind === "points";
    return el("div", { class: wide ? "field wide" : "field", title: field.help }, [
      el("label", { for: id }, [field.label]),
      el("div", { class: "control" }, [input, unit]),
      el("p", { class: "help", id: `${id}-help` }, [field.help]),
    ]);
  }

  private input(field: Field, id: string): HTMLInputElement | HTMLSelectElement | HTMLTextAreaElement {
    const about = { id, name: field.key, "aria-describedby": `${id}-help` };
    const value = text(field.value);
    switch (field.control.kind) {
      case "number": {
        const { min, max, optional } = field.control;
        const input = el("input", { ...about, type: "number", min, max, step: "any", value });
        if (optional) input.placeholder = "auto";
        return input;
      }
      case "choice": {
        const options = field.control.options.map((o) =>
          el("option", { value: o.name, selected: o.name === value }, [o.description]),
        );
        return el("select", about, options);
      }
      case "points":
        return el("textarea", { ...about, rows: 2, spellcheck: "false", placeholder: "x, y, z" });
      case "vector":
        return el("input", { ...about, type: "text", placeholder: "x, y, z" });
    }
  }
}

function text(value: unknown): string {
  return value === null || value === undefined ? "" : String(value);
}
