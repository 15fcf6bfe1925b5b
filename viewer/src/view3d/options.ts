/** Parts shown in addition to the figure. */
export interface ViewOptions {
  /** Arrows of the ground forces. */
  forces: boolean;
  /** Arcs of the joint moments. */
  torques: boolean;
  /** Paths of the centres of pressure. */
  trail: boolean;
  /** Loaded sole points. */
  contacts: boolean;
  /** Lines of the muscles, coloured by their activation. */
  muscles: boolean;
  /** Figures of the compared sessions. */
  ghost: boolean;
  /** The motion of the figure where it was changed: from 0, as recorded, to 1, as in the results. */
  corrected: number;
}

/** Moments are hidden at first: with them the picture is too full. */
export const FIRST_OPTIONS: ViewOptions = {
  forces: true,
  torques: false,
  trail: true,
  contacts: true,
  muscles: true,
  ghost: true,
  corrected: 1,
};
