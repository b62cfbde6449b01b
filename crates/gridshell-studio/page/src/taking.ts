// What is taken away: the grid saved to be gone on with, exported in other formats, and pictures of the view.
import { el } from "./dom";
import type { Link } from "./link";
import type { Notices } from "./notices";
import { download, Saving } from "./saving";
import type { Store } from "./store";
import type { Say } from "./toast";
import type { Views } from "./views";

export class Taking {
  readonly saveButton = el(
    "button",
    {
      type: "button",
      id: "save",
      title: "Save the grid with surface, recipe and edits, to go on with (Ctrl-S)",
    },
    ["Save"],
  );
  readonly picture = el("button", { type: "button", title: "Save a picture of the view" }, ["PNG"]);
  readonly formats = el("select", { "aria-label": "Export as", id: "export" }, [
    el("option", { value: "" }, ["Export …"]),
  ]);
  private readonly saving: Saving;

  constructor(
    private readonly store: Store,
    link: Link,
    private readonly views: Views,
    notices: Notices,
    private readonly say: Say,
  ) {
    const { formats } = this;
    this.saving = new Saving(notices, say, (run, version) => link.send({ kind: "saved", run, version }));
    link.on("hello", ({ exports }) => {
      if (formats.options.length > 1) return;
      const option = (name: string, title: string) => el("option", { value: name, title }, [title]);
      formats.append(...exports.map((f) => option(f.name, f.description)));
    });
    this.saveButton.onclick = () => this.save();
    this.picture.onclick = () => void this.photograph();
    formats.onchange = () => {
      if (formats.value === "gridshell") this.save();
      else this.export(formats.value);
      formats.value = "";
    };
  }

  save(): void {
    const { runs, shown } = this.store.now;
    const run = runs.find((r) => r.run === shown);
    if (run) void this.saving.save(run);
    else this.say("generate a grid first", true);
  }

  private export(format: string): void {
    const { shown } = this.store.now;
    if (shown) download(`export?run=${shown}&format=${format}`, "");
    else this.say("generate a grid first", true);
  }

  private async photograph(): Promise<void> {
    const blob = await this.views.first.picture();
    if (!blob) return;
    const address = URL.createObjectURL(blob);
    download(address, `${this.store.now.surface?.name ?? "view"}.png`);
    setTimeout(() => URL.revokeObjectURL(address), 10_000);
  }
}
