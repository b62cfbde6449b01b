// Colors of scales, and what themes ask of the view.
import { Color } from "three";
import type { Scale } from "./messages";

const UNKNOWN = new Color("#c9ced6");

/** The color of each step, and one for what has none. */
export function inks(scale: Scale): (step: number | undefined) => Color {
  const colors = scale.inks.map((ink) => new Color(ink));
  return (step) => colors[step ?? -1] ?? UNKNOWN;
}

/** The scale as a CSS gradient: a band for each step. */
export function bands(scale: Scale): string {
  const end = (k: number) => `${(100 * k) / scale.inks.length}%`;
  return `linear-gradient(to right, ${scale.inks.map((ink, k) => `${ink} ${end(k)} ${end(k + 1)}`).join(", ")})`;
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
