/** What is shown beside the figure. */
export interface ViewOptions {
  /** Arrows of the ground's forces. */
  forces: boolean;
  /** Arcs of the joint moments. */
  torques: boolean;
  /** Ways of the centres of pressure. */
  trail: boolean;
  /** Points of the soles that carry. */
  contacts: boolean;
  /** The sessions compared with. */
  ghost: boolean;
}

/** Moments wait to be asked for: with them the first picture has too much in it. */
export const FIRST_OPTIONS: ViewOptions = { forces: true, torques: false, trail: true, contacts: true, ghost: true };
