import type { Series } from "../contract";

/** What the view needs of the page's numbers. */
export interface SeriesReader {
  read(series: Series): Float64Array;
}
