// What is kept, and what is not: copies against crashes, what earlier sessions left, grids that made way.
import type { Link } from "./link";
import type { Notices } from "./notices";
import { Recovery } from "./recovery";
import type { Say } from "./toast";

export class Keeping {
  readonly recovery = new Recovery();
  /** Grids that made way, the newest last. */
  private readonly away: string[] = [];

  constructor(
    link: Link,
    private readonly notices: Notices,
    private readonly say: Say,
  ) {
    const { recovery } = this;
    link.on("left", (event) => recovery.show(event.sessions, event.more));
    link.on("autosave", (event) => this.copies(event.fault));
    link.on("put_away", (event) => this.makeWay(event.grids));
    recovery.onRecover = (session) => link.send({ kind: "recover", session });
    recovery.onDiscard = (session) => link.send({ kind: "discard", session });
  }

  private copies(fault: string | null): void {
    if (fault !== null) {
      const text = `Grids cannot be kept against crashes: ${fault}. Save what you need.`;
      this.notices.set("autosave", text, true);
    } else if (this.notices.drop("autosave")) this.say("Grids are kept against crashes again.");
  }

  private makeWay(grids: string[]): void {
    const { away } = this;
    away.push(...grids);
    const told = away.slice(-3).toReversed().join(" · ");
    const more = away.length > 3 ? ` · and ${away.length - 3} before` : "";
    const text = `Put away to make room, as nothing in it was changed by hand: ${told}${more}. Edited grids stay.`;
    this.notices.set("put away", text);
  }
}
