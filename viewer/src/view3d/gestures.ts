import type { CameraRig } from "./camera";

/** Angle of a key [rad] and factor of a zoom key. */
const TURN = Math.PI / 24;
const ZOOM = 1.15;

/**
 * Leaves the page its scrolling: a finger turns the figure in the free view only, the wheel zooms only once the picture was clicked
 * or with Ctrl. With the picture focused, Shift and arrows turn it, + and - zoom.
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

/** A finger may move the page unless it turns the figure. */
export function touchAction(canvas: HTMLCanvasElement, rig: CameraRig): void {
  canvas.style.touchAction = rig.kind === "free" ? "none" : "pan-y pinch-zoom";
}

function turned(event: KeyboardEvent, rig: CameraRig): boolean {
  const turns: Record<string, [number, number]> = {
    ArrowLeft: [-TURN, 0],
    ArrowRight: [TURN, 0],
    ArrowUp: [0, TURN],
    ArrowDown: [0, -TURN],
  };
  const turn = event.shiftKey ? turns[event.key] : undefined;
  if (turn) {
    rig.turn(...turn);
  } else if (event.key === "+" || event.key === "=") {
    rig.zoom(ZOOM);
  } else if (event.key === "-") {
    rig.zoom(1 / ZOOM);
  } else {
    return false;
  }
  return true;
}
