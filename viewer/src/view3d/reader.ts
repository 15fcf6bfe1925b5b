import type { Series } from "../contract";

/** Access of the view to the page's numbers. */
export interface SeriesReader {
  read(series: Series): Float64Array;
}
