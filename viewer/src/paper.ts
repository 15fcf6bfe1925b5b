import type { Panels } from "./panels";
import { setPrinting } from "./style";
import type { View3D } from "./view3d";

/** Prepares the page for printing: light theme, all panels as vectors, the figure as a picture. */
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
  // The media query covers browsers that print without these events.
  matchMedia("print").addEventListener("change", (event) => (event.matches ? before() : after()));
}

function unfold(all: readonly HTMLDetailsElement[], open: boolean): void {
  for (const one of all) {
    one.open = open;
  }
}
