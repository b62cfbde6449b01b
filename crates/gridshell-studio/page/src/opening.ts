// Where the surface comes from: a built-in one, or a file that is chosen or dropped; and what is known of it.
import { el } from "./dom";
import type { Link } from "./link";
import type { Hello, SurfaceInfo } from "./messages";
import type { Recipe } from "./recipe";
import type { Store } from "./store";
import type { Say } from "./toast";

export class Opening {
  readonly element: HTMLElement;
  private readonly surfaces = el("select", { id: "surface", "aria-label": "Built-in surface" });
  private readonly input = el("input", { type: "file", id: "file", hidden: true, multiple: true });
  private readonly about = el("div", { class: "about" });
  /** The largest file that is taken, bytes. */
  private limit = Infinity;

  constructor(
    private readonly store: Store,
    private readonly recipe: Recipe,
    private readonly say: Say,
    link: Link,
  ) {
    const { surfaces, input } = this;
    const button = el("button", { type: "button", class: "quiet" }, ["Open file …"]);
    this.element = el("section", { class: "source" }, [
      el("label", { class: "title", for: "surface" }, ["Surface"]),
      el("div", { class: "row" }, [surfaces, button, input]),
      this.about,
    ]);
    link.on("hello", (hello) => this.offer(hello));
    link.on("surface", (surface) => {
      store.set("surface", surface);
      this.show(surface);
    });
    surfaces.onchange = () => {
      recipe.anew();
      link.send({ kind: "open", name: surfaces.value });
    };
    button.onclick = () => input.click();
    input.onchange = () => {
      void this.openAll(input.files);
      input.value = "";
    };
  }

  /** Files that are dropped there are opened. */
  dropsOn(stage: HTMLElement): void {
    stage.addEventListener("dragover", (e) => {
      e.preventDefault();
      stage.classList.add("drop");
    });
    stage.addEventListener("dragleave", () => stage.classList.remove("drop"));
    stage.addEventListener("drop", (e) => {
      e.preventDefault();
      stage.classList.remove("drop");
      void this.openAll(e.dataTransfer?.files);
    });
  }

  private offer(hello: Hello): void {
    this.surfaces.replaceChildren(
      el("option", { value: "", disabled: true }, ["a file"]),
      ...hello.builtins.map((b) => el("option", { value: b.name, title: b.description }, [b.name])),
    );
    this.input.accept = hello.accepts.map((e) => `.${e}`).join(",");
    this.limit = hello.upload_limit;
  }

  private show({ name, built_in: known, source, facts, notes }: SurfaceInfo): void {
    this.surfaces.value = known ? name : "";
    document.title = `${name} – gridshell studio`;
    this.about.replaceChildren(
      el("p", { class: "what" }, [known ? source : `${name} (${source})`]),
      el(
        "dl",
        {},
        facts.flatMap((f) => [el("dt", {}, [f.label]), el("dd", {}, [f.value])]),
      ),
      this.recipe.choosing.element,
      list("Notes", notes),
    );
  }

  /** Surfaces first: a grid among the files may lie on one of them. */
  private async openAll(files: FileList | null | undefined): Promise<void> {
    const all = [...(files ?? [])];
    for (const file of [...all.filter((f) => !isGrid(f)), ...all.filter(isGrid)]) await this.open(file);
  }

  private async open(file: File): Promise<void> {
    if (file.size > this.limit) {
      this.say(`${file.name} is larger than ${this.limit >> 20} MB`, true);
      return;
    }
    this.store.set("status", `reading ${file.name} …`);
    this.recipe.anew();
    try {
      const address = `open?name=${encodeURIComponent(file.name)}`;
      const answer = await fetch(address, { method: "POST", body: file });
      if (answer.ok) this.say(`opened ${file.name}`);
      else this.say(await answer.text(), true);
    } catch {
      this.say(`${file.name} could not be sent: is gridshell still running?`, true);
    }
    this.store.set("status", "ready");
  }
}

const isGrid = (file: File) => file.name.toLowerCase().endsWith(".gridshell");

function list(title: string, items: string[]): HTMLElement {
  if (!items.length) return el("span", { hidden: true });
  const open = items.length < 5;
  return el("details", { class: "list", open }, [
    el("summary", {}, [`${title} (${items.length})`]),
    el(
      "ul",
      {},
      items.map((i) => el("li", {}, [i])),
    ),
  ]);
}
