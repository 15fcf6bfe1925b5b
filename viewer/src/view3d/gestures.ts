import type { CameraRig } from "./camera";

/** Rotation per key press [rad], and factor per zoom key press. */
const TURN = Math.PI / 24;
const ZOOM = 1.15;

/**
 * Pointer, wheel and key control of the view that keeps the page scrollable: a finger turns the figure in the free view only, and the
 * wheel zooms only after a click on the picture or with Ctrl. While the picture has the focus, the keys a d w s turn it, and e and q
 * zoom in and out.
 */
export function listen(canvas: HTMLCanvasElement, rig: CameraRig, changed: () => void): () => void {
  const ending = new AbortController();
  const options = { signal: ending.signal, capture: true };
  canvas.addEventListener(
    "pointerdown",
    (event) => {
      rig.controls.enabled = event.pointerType !== "touch" || rig.kind === "free";
    },
    options,
  );
  canvas.addEventListener(
    "wheel",
    (event) => {
      rig.controls.enabled = true;
      rig.controls.enableZoom = event.ctrlKey || document.activeElement === canvas;
    },
    options,
  );
  canvas.addEventListener(
    "keydown",
    (event) => {
      if (turned(event, rig)) {
        event.preventDefault();
        event.stopPropagation();
        changed();
      }
    },
    options,
  );
  rig.controls.addEventListener("change", changed);
  return () => ending.abort();
}

/** Lets a finger scroll the page unless it turns the figure. */
export function touchAction(canvas: HTMLCanvasElement, rig: CameraRig): void {
  canvas.style.touchAction = rig.kind === "free" ? "none" : "pan-y pinch-zoom";
}

function turned(event: KeyboardEvent, rig: CameraRig): boolean {
  const turns: Record<string, [number, number]> = { a: [-TURN, 0], d: [TURN, 0], w: [0, TURN], s: [0, -TURN] };
  const zooms: Record<string, number> = { e: ZOOM, q: 1 / ZOOM };
  const key = event.key.toLowerCase();
  const turn = turns[key];
  const zoom = zooms[key];
  if (event.ctrlKey || event.metaKey || event.altKey) {
    return false;
  }
  if (turn) {
    rig.turn(...turn);
  } else if (zoom) {
    rig.zoom(zoom);
  }
  return turn !== undefined || zoom !== undefined;
}
