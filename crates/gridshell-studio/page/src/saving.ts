// Saving a grid to a file of the user's. Only what surely arrived counts as saved: until then the studio keeps its copy
// against crashes, and does not put the grid away.
import { el } from "./dom";
import type { RunSummary } from "./messages";
import type { Notices } from "./notices";

/** A file that the user chose, as browsers have it that let pages write files. */
interface Handle {
  name: string;
  createWritable(): Promise<{ write(data: Blob): Promise<void>; close(): Promise<void> }>;
}
type Picker = (options: object) => Promise<Handle>;

const TYPES = [{ description: "gridshell", accept: { "application/octet-stream": [".gridshell"] } }];

export class Saving {
  /** Files that were chosen before: saving again writes the same one. */
  private readonly handles = new Map<number, Handle>();

  constructor(
    private readonly notices: Notices,
    private readonly say: (message: string, bad?: boolean) => void,
    private readonly saved: (run: number, version: number) => void,
  ) {}

  async save(run: RunSummary): Promise<void> {
    const name = `${run.title.replace(/[^\p{L}\p{N}_.-]/gu, "_")}-${run.run}.gridshell`;
    try {
      const handle = await this.choose(run.run, name);
      const answer = await fetch(`export?run=${run.run}&format=gridshell`);
      if (!answer.ok) return this.say(await answer.text(), true);
      const version = Number(answer.headers.get("gridshell-version"));
      const file = await answer.blob();
      if (handle === null) return this.hand(run.run, version, file, name);
      const writing = await handle.createWritable();
      await writing.write(file);
      await writing.close();
      this.saved(run.run, version);
      this.say(`${handle.name} is saved`);
    } catch (error) {
      // Nothing was chosen.
      if (error instanceof DOMException && error.name === "AbortError") return;
      this.handles.delete(run.run);
      const why = error instanceof Error ? error.message : String(error);
      this.say(`${name} is not saved: ${why}`, true);
    }
  }

  /** The file to write; null where the browser only downloads. */
  private async choose(run: number, name: string): Promise<Handle | null> {
    const known = this.handles.get(run);
    if (known) return known;
    const picker = (window as { showSaveFilePicker?: Picker }).showSaveFilePicker;
    if (!picker) return null;
    const handle = await picker.call(window, { suggestedName: name, types: TYPES });
    this.handles.set(run, handle);
    return handle;
  }

  /** Hand it to the browser, which does not tell pages what became of it. */
  private hand(run: number, version: number, file: Blob, name: string): void {
    const address = URL.createObjectURL(file);
    download(address, name);
    setTimeout(() => URL.revokeObjectURL(address), 60_000);
    const text = `${name} went to the browser's downloads. Say so when it is there: until then the studio keeps its own copy too.`;
    const act = () => this.saved(run, version);
    this.notices.set(`saved ${run}`, text, false, { label: "It is there", act });
  }
}

export function download(address: string, as: string): void {
  const a = el("a", { href: address, download: as });
  document.body.append(a);
  a.click();
  a.remove();
}
