// Who wants to hear of what: values by name, told to everyone who asked for that name.
export class Signals<T> {
  private readonly acts = new Map<keyof T, ((value: never) => void)[]>();

  on<K extends keyof T>(name: K, act: (value: T[K]) => void): void {
    this.acts.set(name, [...(this.acts.get(name) ?? []), act]);
  }

  tell<K extends keyof T>(name: K, value: T[K]): void {
    for (const act of this.acts.get(name) ?? []) act(value as never);
  }
}
