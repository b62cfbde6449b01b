// The page's state: what more than one of its controllers goes by. They read it, change it and hear of changes.
import type { Picked, Progress, RunSummary, SurfaceInfo } from "./messages";
import { Signals } from "./signals";

export interface State {
  surface: SurfaceInfo | null;
  runs: RunSummary[];
  /** The run that is shown, and the one beside it; 0 for none. */
  shown: number;
  beside: number;
  /** How far the run is that goes on. */
  going: Progress | null;
  /** When it was wished for, on the page's clock; 0 before the first. */
  began: number;
  /** Whether its pictures are followed: until another run is chosen. */
  following: boolean;
  /** Whether one of them is in the view. */
  live: boolean;
  /** The edit that goes on, in words. */
  working: string | null;
  /** Whether the grid is edited by hand. */
  editing: boolean;
  /** What is under the pointer. */
  picked: Picked | null;
  theme: "light" | "dark";
  /** What the status line says. */
  status: string;
}

export class Store {
  private readonly state: State = {
    surface: null,
    runs: [],
    shown: 0,
    beside: 0,
    going: null,
    began: 0,
    following: true,
    live: false,
    working: null,
    editing: false,
    picked: null,
    theme: "light",
    status: "connecting …",
  };
  private readonly signals = new Signals<State>();

  get now(): Readonly<State> {
    return this.state;
  }

  /** Told even where it is what it was: a run that is chosen again is shown anew. */
  set<K extends keyof State>(name: K, value: State[K]): void {
    this.state[name] = value;
    this.signals.tell(name, value);
  }

  on<K extends keyof State>(name: K, act: (value: State[K]) => void): void {
    this.signals.on(name, act);
  }
}
