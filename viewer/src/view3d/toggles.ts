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

/** Whether the figure can be shown as recorded and as changed. */
function wasChanged(view: View): boolean {
  return view.bodies.some((body) => body.recorded !== undefined);
}

/**
 * Buttons in a corner of the picture that show and hide its parts, and a slider where the motion was changed; call `refresh` after the
 * options changed.
 */
export function toggleBar(
  view: View,
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
  const slider = element("input", {
    type: "range",
    min: "0",
    max: "1",
    step: "0.01",
    "aria-label": "Motion of the figure: left as recorded, right as corrected",
  });
  slider.addEventListener("input", () => choose({ corrected: slider.valueAsNumber }));
  const words = ["Recorded", "Corrected"].map((word) => element("span", {}, word));
  const [recorded, corrected] = words as [HTMLElement, HTMLElement];
  const mixture = wasChanged(view) ? [element("label", { class: "view-mixture" }, recorded, slider, corrected)] : [];
  const refresh = (): void => {
    slider.value = String(now.corrected);
    for (const [toggle, made] of buttons) {
      made.setAttribute("aria-pressed", String(shown(toggle)));
    }
  };
  refresh();
  const attributes = { class: "view-toggles", role: "group", "aria-label": "Shown in the picture" };
  return { bar: element("div", attributes, ...buttons.map(([, made]) => made), ...mixture), refresh };
}
