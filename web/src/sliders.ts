// Sliders for a walk without files. They start at the values of the demo walk, so no default is written twice; only those that were moved become
// part of the request.

import type { Between, Values } from "./family";
import { OUTPUT } from "./files";
import type { Request } from "./request";

/** A slider by its name in the form, and where a summary has its value. */
interface Slider {
  option: Option;
  unit: string;
  digits: number;
  valueIn(summary: Summary): number | undefined;
}

/** The part of `summary.json` that is read. */
interface Summary {
  mass_kg?: number;
  height_m?: number;
  walk?: { speed_asked_m_s: number; step_length_m: number } | null;
}

type Option = "speed" | "step-length" | "height" | "mass" | "slope";

const SLIDERS: Slider[] = [
  { option: "speed", unit: "m/s", digits: 2, valueIn: ({ walk }) => walk?.speed_asked_m_s },
  { option: "step-length", unit: "m", digits: 2, valueIn: ({ walk }) => walk?.step_length_m },
  { option: "height", unit: "m", digits: 2, valueIn: ({ height_m }) => height_m },
  { option: "mass", unit: "kg", digits: 0, valueIn: ({ mass_kg }) => mass_kg },
  { option: "slope", unit: "%", digits: 0, valueIn: () => undefined },
];

const [SPEED, STEP] = ["speed", "step-length"] as const;

/** After so long without a further move, a slider is at rest [ms]. */
const REST_MS = 300;

/** The sliders of the page. */
export class Sliders {
  private moved = new Set<Option>();
  private timer = 0;
  /** Values and moved sliders of the walk that is shown. */
  private shown: { values: Map<Option, string>; moved: Set<Option> } | undefined;

  /** `preview` is called while a slider moves, `compute` with the request when it is released. */
  constructor(
    private readonly form: HTMLFormElement,
    private readonly preview: (values: Values) => Between | undefined,
    private readonly compute: (request: Request) => void,
  ) {
    for (const slider of SLIDERS) {
      const input = this.input(slider);
      input.addEventListener("input", () => {
        clearTimeout(this.timer);
        this.moved.add(slider.option);
        if (slider.option === STEP) {
          // Otherwise the speed would follow from the step length.
          this.moved.add(SPEED);
        }
        this.label(slider);
        this.follow(this.preview(this.values()));
      });
      input.addEventListener("change", () => {
        clearTimeout(this.timer);
        this.timer = setTimeout(() => this.compute(this.request()), REST_MS) as unknown as number;
      });
      this.label(slider);
    }
    form.addEventListener("reset", () => {
      this.moved.clear();
      // The form puts its own values in after this event.
      setTimeout(() => this.compute(this.request()));
    });
  }

  /** Shows the values of a walk that was computed, where the visitor did not set any. */
  take(summary: Summary): void {
    for (const slider of summary.walk ? SLIDERS : []) {
      const value = slider.valueIn(summary);
      if (value !== undefined && !this.moved.has(slider.option)) {
        this.input(slider).value = String(value);
      }
      this.label(slider);
    }
    const values = SLIDERS.map((slider) => [slider.option, this.input(slider).value] as const);
    this.shown = { values: new Map(values), moved: new Set(this.moved) };
  }

  /** Goes back to the values of the walk that is shown, after another one was given up. */
  restore(): void {
    clearTimeout(this.timer);
    for (const slider of this.shown ? SLIDERS : []) {
      this.input(slider).value = this.shown?.values.get(slider.option) ?? "";
      this.label(slider);
    }
    this.moved = new Set(this.shown?.moved);
  }

  /** A step length that the visitor did not set is that of the walk. */
  private follow(walk: Between | undefined): void {
    const step = SLIDERS.find(({ option }) => option === STEP);
    if (walk && step && !this.moved.has(STEP)) {
      this.input(step).value = String(walk.stepLength);
      this.label(step);
    }
  }

  private values(): Values {
    const value = (option: Option): number => (this.form.elements.namedItem(option) as HTMLInputElement).valueAsNumber;
    return {
      speed: value(SPEED),
      stepLength: this.moved.has(STEP) ? value(STEP) : undefined,
      height: value("height"),
      mass: value("mass"),
      slope: value("slope"),
    };
  }

  private request(): Request {
    const { speed, height, mass, slope } = this.values();
    const moved = (option: Option, value: number | undefined): number | null =>
      this.moved.has(option) && value !== undefined ? value : null;
    return {
      walk: {
        gait: { speed: moved("speed", speed), step_length: moved("step-length", this.values().stepLength) },
        figure: { height: moved("height", height), mass: moved("mass", mass) },
        // Level ground is no condition: the walk is then near normative curves.
        conditions: { slope: slope === 0 ? null : moved("slope", slope) },
        output: OUTPUT,
      },
    };
  }

  private input({ option }: Slider): HTMLInputElement {
    return this.form.elements.namedItem(option) as HTMLInputElement;
  }

  private label(slider: Slider): void {
    const input = this.input(slider);
    const text = `${Number(input.value).toFixed(slider.digits)} ${slider.unit}`;
    input.setAttribute("aria-valuetext", text);
    const shown = input.parentElement?.querySelector("span");
    if (shown) {
      shown.textContent = text;
    }
  }
}
