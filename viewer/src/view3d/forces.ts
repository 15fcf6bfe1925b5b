import { type Color, Group, Vector3 } from "three";
import type { PageSide, View, ViewForce } from "../contract";
import { Arrow } from "./arrow";
import { addAll, OVER, onLayer } from "./layers";
import { type Palette, sideColor } from "./palette";
import type { SeriesReader } from "./reader";
import { sample } from "./timeline";

/** Radius of an arrow's shaft, in heights of the figure. */
const THICK = 0.0068;
const THIN = 0.0034;
/** Vertical force above which a foot is loaded [N], as for the events. */
const LOADED_N = 20;

/** Quantile above which forces count as impacts, which must not shrink the other arrows. */
const ORDINARY_PART = 0.97;

/** Largest force without impacts [body weights]. */
export function peakOf(view: View, numbers: SeriesReader): number {
  const sizes: number[] = [];
  for (const { force } of view.forces) {
    const [x, y, z] = force.map((series) => numbers.read(series)) as [Float64Array, Float64Array, Float64Array];
    for (const [index, up] of y.entries()) {
      const size = Math.hypot(x[index] ?? 0, up, z[index] ?? 0);
      if (size > LOADED_N) {
        sizes.push(size);
      }
    }
  }
  sizes.sort((a, b) => a - b);
  const peak = sizes[Math.floor(ORDINARY_PART * (sizes.length - 1))] ?? 0;
  return view.weight_n > 0 ? peak / view.weight_n : 0;
}

interface Force {
  source: ViewForce;
  point: Float64Array[];
  force: Float64Array[];
  arrow: Arrow;
}

/**
 * Ground forces as arrows. The forces used in the computation are thick; forces measured in addition and those of a ghost are thin.
 * Arrows of the left side are dashed, like its curves.
 */
export class Forces {
  readonly group = new Group();
  private readonly forces: Force[];
  private readonly scale: number;
  private readonly at = new Vector3();
  private readonly vector = new Vector3();

  constructor(view: View, numbers: SeriesReader, height: number, weight_m: number, ghost = false) {
    this.scale = view.weight_n > 0 ? weight_m / view.weight_n : 0;
    const shown = view.forces.filter(({ role }) => role === "main" || !ghost);
    this.forces = shown.map((source) => ({
      source,
      point: source.point.map((series) => numbers.read(series)),
      force: source.force.map((series) => numbers.read(series)),
      arrow: new Arrow(height * (source.role === "measured" || ghost ? THIN : THICK), source.side === "l"),
    }));
    addAll(
      this.group,
      this.forces.map(({ arrow }) => arrow.group),
    );
    onLayer(this.group, OVER);
  }

  /** `own`: one colour for all arrows. */
  recolor(colors: Palette, own: Color | null = null): void {
    for (const { arrow, source } of this.forces) {
      const color = source.role === "measured" ? colors.measured : sideColor(colors, source.side);
      arrow.recolor(own ?? color, colors.paper);
    }
  }

  pose(frame: number): void {
    for (const { point, force, arrow } of this.forces) {
      vectorAt(point, frame, this.at);
      vectorAt(force, frame, this.vector).multiplyScalar(this.scale);
      arrow.set(this.at, this.vector);
    }
  }

  /** Whether the foot of this side is loaded; null if unknown. */
  loaded(side: PageSide | null, frame: number): boolean | null {
    const own = this.forces.filter(
      ({ source }) => source.role === "main" && (source.side === side || source.side === null),
    );
    if (own.length === 0) {
      return null;
    }
    return own.some(({ force }) => sample(force[1] ?? new Float64Array(), frame) > LOADED_N);
  }
}

function vectorAt(series: Float64Array[], frame: number, into: Vector3): Vector3 {
  const [x, y, z] = series as [Float64Array, Float64Array, Float64Array];
  return into.set(sample(x, frame), sample(y, frame), sample(z, frame));
}
