import type { PageSide } from "./contract";
import type { Axis } from "./drawing";

/** The reader's choices for all panels. */
export class Display {
  #axis: Axis = "cycle";
  #sides: readonly PageSide[] = ["r", "l"];
  readonly #listeners = new Set<() => void>();

  get axis(): Axis {
    return this.#axis;
  }

  set axis(axis: Axis) {
    this.#axis = axis;
    this.#tell();
  }

  get sides(): readonly PageSide[] {
    return this.#sides;
  }

  set sides(sides: readonly PageSide[]) {
    this.#sides = sides;
    this.#tell();
  }

  /** Calls the listener after every change; the returned function removes it. */
  subscribe(listener: () => void): () => void {
    this.#listeners.add(listener);
    return () => this.#listeners.delete(listener);
  }

  #tell(): void {
    for (const listener of this.#listeners) {
      listener();
    }
  }
}
