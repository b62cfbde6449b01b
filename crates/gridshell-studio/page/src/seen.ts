// For tests and measuring: what the page has seen, as `window.studio`.
import type { Link } from "./link";
import type { Point } from "./pointing";
import type { Store } from "./store";
import type { View } from "./view";

export function expose(store: Store, link: Link, view: View): void {
  /** Milliseconds from the wish to the first picture and the first grid; 0 until then. */
  let [firstFrame, firstGrid] = [0, 0];
  let [liveFrames, announced, newest] = [0, 0, 0];
  store.on("began", () => ([firstFrame, firstGrid, liveFrames] = [0, 0, 0]));
  store.on("live", (yes) => {
    if (!yes) return;
    liveFrames++;
    firstFrame ||= performance.now() - store.now.began;
  });
  link.on("progress", ({ run }) => (announced = run));
  link.on("runs", (event) => {
    const fresh = (event.newest ?? 0) > newest;
    newest = event.newest ?? 0;
    if (fresh && store.now.began) firstGrid ||= performance.now() - store.now.began;
  });
  Object.assign(window, {
    studio: {
      get seen() {
        const { shown, runs, picked } = store.now;
        return { firstFrame, firstGrid, liveFrames, shown, announced, drawn: view.drawn, runs, picked };
      },
      get speed() {
        return { spent: view.spent, calls: view.calls };
      },
      get irregular() {
        return view.grid.irregular();
      },
      project: (p: Point) => view.project(p),
    },
  });
}
