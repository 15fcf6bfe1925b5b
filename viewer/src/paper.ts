import type { Panels } from "./panels";
import { setPrinting } from "./style";
import type { View3D } from "./view3d";

/** Makes the page ready for paper before it is printed: light, all panels as vectors, the figure as a picture. */
export function prepareForPaper(panels: Panels, view: View3D | null, still: HTMLImageElement): void {
  let ready = false;
  let folded: HTMLDetailsElement[] = [];
  const before = (): void => {
    if (!ready) {
      ready = true;
      setPrinting(true);
      folded = [...document.querySelectorAll<HTMLDetailsElement>("details.settings:not([open])")];
      unfold(folded, true);
      panels.prepareForPaper();
      if (view) {
        still.src = view.still();
      }
    }
  };
  const after = (): void => {
    if (ready) {
      ready = false;
      setPrinting(false);
      unfold(folded, false);
    }
  };
  addEventListener("beforeprint", before);
  addEventListener("afterprint", after);
  // Where a browser prints without these events, the media query tells.
  matchMedia("print").addEventListener("change", (event) => (event.matches ? before() : after()));
}

function unfold(all: readonly HTMLDetailsElement[], open: boolean): void {
  for (const one of all) {
    one.open = open;
  }
}
