import type { Clock } from "./clock";
import type { Page, Session } from "./contract";
import type { Display } from "./display";
import type { Numbers } from "./numbers";
import type { View3D } from "./view3d";

/** What every part of the page needs. */
export interface Context {
  readonly page: Page;
  /** The first session: the clock's time is its time. */
  readonly first: Session;
  readonly numbers: Numbers;
  readonly clock: Clock;
  readonly display: Display;
}

/** A context with the figure. */
export interface Stage extends Context {
  readonly view: View3D | null;
}
