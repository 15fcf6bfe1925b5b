import type { Object3D } from "three";

/** Figure, floor and obstacles. */
export const SOLID = 0;
/** Arrows and discs, drawn over the figure so that no limb hides them. */
export const OVER = 1;

/** Moves an object with all its parts to a layer. */
export function onLayer<T extends Object3D>(object: T, layer: number): T {
  object.traverse((part) => part.layers.set(layer));
  return object;
}

/** Adds those objects that exist. */
export function addAll(group: Object3D, objects: Object3D[]): void {
  for (const object of objects) {
    group.add(object);
  }
}

/** Frees the graphics memory of an object and its parts. */
export function release(object: Object3D): void {
  object.traverse((part) => {
    const { geometry, material } = part as { geometry?: { dispose(): void }; material?: Disposable | Disposable[] };
    geometry?.dispose();
    for (const one of material === undefined ? [] : [material].flat()) {
      one.map?.dispose();
      one.dispose();
    }
  });
}

interface Disposable {
  map?: { dispose(): void } | null;
  dispose(): void;
}
