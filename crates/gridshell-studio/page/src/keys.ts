// The keys, and what each is for.
export interface Keys {
  generate(): void;
  save(): void;
  undo(): void;
  redo(): void;
  cancel(): void;
  edit(): void;
  measure(): void;
  /** Lay the guide that is drawn; whether there is one. */
  lay(): boolean;
  /** Look from the side with this key; whether one has. */
  look(key: string): boolean;
  /** Any other. */
  other(key: string): void;
}

export function listen(keys: Keys): void {
  document.addEventListener("keydown", (e) => {
    const { target } = e;
    const typing = target instanceof HTMLInputElement || target instanceof HTMLTextAreaElement;
    const control = e.ctrlKey || e.metaKey;
    if (e.key === "Enter" && control) return keys.generate();
    if (e.key === "s" && control) {
      e.preventDefault();
      return keys.save();
    }
    if (typing || target instanceof HTMLSelectElement) return;
    const key = e.key.toLowerCase();
    if (control && key === "z") {
      e.preventDefault();
      return e.shiftKey ? keys.redo() : keys.undo();
    }
    if (control || e.altKey) return;
    if (key === "escape") return keys.cancel();
    // Not the button that has the focus.
    if (key === "enter" && keys.lay()) return e.preventDefault();
    if (key === "e") return keys.edit();
    if (key === "m") return keys.measure();
    if (!keys.look(key)) keys.other(key);
  });
}
