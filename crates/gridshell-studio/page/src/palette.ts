// Colors for values: an even scale for amounts, a diverging one for degrees, and what themes ask of the view.
import { Color } from "three";

/** Dark blue to yellow by even steps of lightness, readable without color vision. */
const EVEN = ["#30246b", "#31528f", "#24788f", "#229a82", "#62b862", "#b8cd46", "#fbe04a"].map(
  (c) => new Color(c),
);
/** Degrees 4 and less to 8 and more; 6 is neutral. */
const DEGREES = ["#5b2a86", "#3b6fb5", "#c9ced6", "#e08a3c", "#a32638"].map((c) => new Color(c));

const UNKNOWN = new Color("#c9ced6");

/** The color of a value between the ends of a scale. */
export function paint(value: number, [low, high]: [number, number], whole: boolean, into: Color): Color {
  if (!Number.isFinite(value)) return into.copy(UNKNOWN);
  const stops = whole ? DEGREES : EVEN;
  const share = Math.min(1, Math.max(0, (value - low) / (high - low)));
  const at = share * (stops.length - 1);
  const k = Math.min(stops.length - 2, Math.floor(at));
  return into.lerpColors(stops[k]!, stops[k + 1]!, at - k);
}

/** The scale as a CSS gradient. */
export function gradient(whole: boolean): string {
  const stops = whole ? DEGREES : EVEN;
  return `linear-gradient(to right, ${stops.map((c) => `#${c.getHexString()}`).join(", ")})`;
}

export interface Theme {
  background: string;
  surface: string;
  chosen: string;
  lines: string;
  panels: string;
  members: string;
  bubble: string;
  rim: string;
}

export const THEMES: Record<"light" | "dark", Theme> = {
  light: {
    background: "#f4f5f7",
    surface: "#dfe3e8",
    chosen: "#7fb0e6",
    lines: "#7b8794",
    panels: "#ffffff",
    members: "#39424e",
    bubble: "#8fb4d9",
    rim: "#15181c",
  },
  dark: {
    background: "#14171b",
    surface: "#2a3037",
    chosen: "#3f78b8",
    lines: "#6b7684",
    panels: "#323a44",
    members: "#c4ccd6",
    bubble: "#5d8fc2",
    rim: "#a7b1bd",
  },
};
