// Elements in one line.
type Child = Node | string | null | undefined | false;
type Handlers = { [K in keyof HTMLElementEventMap as `on${K}`]?: (event: HTMLElementEventMap[K]) => void };
type Attributes = Record<string, string | number | boolean | undefined> & { class?: string };

export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  children: Child[] = [],
  handlers: Handlers = {},
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === false) continue;
    // The attribute would be refused: the page's policy allows no styles inside elements.
    if (name === "style") element.style.cssText = String(value);
    else element.setAttribute(name, value === true ? "" : String(value));
  }
  element.append(...children.filter((c): c is Node | string => Boolean(c)));
  for (const [name, handler] of Object.entries(handlers)) {
    element.addEventListener(name.slice(2), handler as EventListener);
  }
  return element;
}

/** A button that stays pressed until it is pressed again. */
export function toggle(
  label: string,
  title: string,
  id: string,
  flipped: (on: boolean) => void,
): HTMLButtonElement {
  const button = el("button", { type: "button", "aria-pressed": "false", title, id }, [label]);
  button.onclick = () => {
    const on = button.getAttribute("aria-pressed") !== "true";
    button.setAttribute("aria-pressed", String(on));
    flipped(on);
  };
  return button;
}

const SVG = "http://www.w3.org/2000/svg";

export function svg(
  tag: string,
  attributes: Record<string, string | number>,
  children: Element[] = [],
): Element {
  const element = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  element.append(...children);
  return element;
}

/** A number as people read it: four digits, no tail of zeros. */
export function figure(x: number): string {
  if (!Number.isFinite(x)) return "–";
  const size = Math.abs(x);
  const digits = size === 0 ? 0 : Math.max(0, Math.min(4, 2 - Math.floor(Math.log10(size))));
  return x.toFixed(digits);
}
