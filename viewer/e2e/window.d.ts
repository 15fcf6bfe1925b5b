import type { Clock } from "../src/clock";
import type { Page } from "../src/contract";
import type { Display } from "../src/display";
import type { Drawing } from "../src/drawing";
import type { Numbers } from "../src/numbers";
import type { View3D } from "../src/view3d";

declare global {
  interface Window {
    /** State of the page, for tests. */
    readonly ambulo: {
      readonly page: Page;
      readonly numbers: Numbers;
      readonly clock: Clock;
      readonly display: Display;
      readonly view: View3D | null;
      readonly panels: Record<string, Drawing | null>;
    };
    /** Set by a script that must not run. */
    hacked?: () => void;
  }
}
