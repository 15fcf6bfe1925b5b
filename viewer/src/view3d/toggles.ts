import type { View } from "../contract";
import { button, element } from "../element";
import { hasMuscles } from "./muscles";
import type { ViewOptions } from "./options";
import { leavesTrail } from "./trail";

/** A button text and the parts that it shows. */
interface Toggle {
  readonly word: string;
  readonly hint: string;
  readonly keys: readonly Exclude<keyof ViewOptions, "corrected">[];
}

const FORCES: Toggle = { word: "Forces", hint: "Arrows of the ground forces", keys: ["forces"] };
const MOMENTS: Toggle = { word: "Moments", hint: "Arcs of the joint moments", keys: ["torques"] };
const SOLES: Toggle = { word: "Soles", hint: "Centre of pressure and loaded sole points", keys: ["trail", "contacts"] };
const MUSCLES: Toggle = { word: "Muscles", hint: "Muscles, coloured by activation", keys: ["muscles"] };
const GHOST: Toggle = { word: "Ghost", hint: "Figure of the compared session", keys: ["ghost"] };

/** Toggles that have an effect in this view. */
export function togglesOf(view: View, ghosts: boolean): Toggle[] {
  return [
    ...(view.forces.length > 0 ? [FORCES] : []),
    ...(view.torques.length > 0 ? [MOMENTS] : []),
    ...(view.forces.some(leavesTrail) || view.contacts.length > 0 ? [SOLES] : []),
    ...(hasMuscles(view) ? [MUSCLES] : []),
    ...(ghosts ? [GHOST] : []),
  ];
}

/** Buttons in a corner of the picture that show and hide its parts; call `refresh` after the options changed. */
export function toggleBar(
  toggles: Toggle[],
  now: ViewOptions,
  choose: (options: Partial<ViewOptions>) => void,
): { readonly bar: HTMLElement; refresh(): void } {
  const shown = ({ keys }: Toggle): boolean => keys.every((key) => now[key]);
  const buttons = toggles.map((toggle) => {
    const flip = (): void => choose(Object.fromEntries(toggle.keys.map((key) => [key, !shown(toggle)])));
    const made = button(toggle.word, toggle.word, flip);
    made.title = toggle.hint;
    return [toggle, made] as const;
  });
  const refresh = (): void => {
    for (const [toggle, made] of buttons) {
      made.setAttribute("aria-pressed", String(shown(toggle)));
    }
  };
  refresh();
  const attributes = { class: "view-toggles", role: "group", "aria-label": "Shown in the picture" };
  return { bar: element("div", attributes, ...buttons.map(([, made]) => made)), refresh };
}

/** A slider from the recorded motion to that of the results, hidden where they are the same. */
export function mixtureSlider(view: View, choose: (options: Partial<ViewOptions>) => void): HTMLElement {
  const slider = element("input", {
    type: "range",
    min: "0",
    max: "1",
    step: "0.01",
    value: "1",
    "aria-label": "Motion of the figure: left as recorded, right as corrected",
  });
  slider.addEventListener("input", () => choose({ corrected: slider.valueAsNumber }));
  const label = element("label", { class: "view-mixture" }, "Recorded", slider, "Corrected");
  label.hidden = view.bodies.every((body) => body.recorded === undefined);
  return label;
}
