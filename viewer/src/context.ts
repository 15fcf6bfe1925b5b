import type { Clock } from "./clock";
import type { Page, Session } from "./contract";
import type { Display } from "./display";
import type { Numbers } from "./numbers";
import type { View3D } from "./view3d";

/** Objects that every part of the page uses. */
export interface Context {
  readonly page: Page;
  /** The first session; the clock runs on its time axis. */
  readonly first: Session;
  readonly numbers: Numbers;
  readonly clock: Clock;
  readonly display: Display;
}

/** The context together with the 3-D figure. */
export interface Stage extends Context {
  readonly view: View3D | null;
}
