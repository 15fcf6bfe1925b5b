import type { LiveFrame, LivePage, Series, View } from "../contract";
import type { SeriesReader } from "../view3d/reader";

/** Numbers per body: position and orientation. */
const PER_BODY = 7;

/** The series of a view with one instant, whose numbers follow a stream. */
export class LiveFigure implements SeriesReader {
  readonly #values = new Map<Series, Float64Array>();

  constructor(
    private readonly view: View | null,
    private readonly first: SeriesReader,
    private readonly live: LivePage,
  ) {}

  /** The series itself: it changes with every frame. */
  read(series: Series): Float64Array {
    const known = this.#values.get(series);
    if (known) {
      return known;
    }
    const values = this.first.read(series).slice();
    this.#values.set(series, values);
    return values;
  }

  /** Takes the poses and forces of a frame; without poses the figure stays. */
  show({ poses, values }: LiveFrame): void {
    if (!this.view) return;
    for (const [place, body] of this.view.bodies.entries()) {
      const own = poses.slice(PER_BODY * place, PER_BODY * (place + 1));
      if (own.length === PER_BODY) {
        this.set([...body.position, ...body.rotation], own);
      }
    }
    for (const [place, force] of this.view.forces.entries()) {
      const columns = this.live.forces[place];
      if (columns) {
        const of = (places: readonly number[]): number[] => places.map((column) => values[column] ?? Number.NaN);
        this.set(force.force, of(columns.force));
        this.set(force.point, of(columns.point));
      }
    }
  }

  private set(series: readonly Series[], numbers: readonly number[]): void {
    for (const [place, one] of series.entries()) {
      this.read(one)[0] = numbers[place] ?? Number.NaN;
    }
  }
}
