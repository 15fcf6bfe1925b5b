import { button, element } from "./element";

const KEYS: readonly (readonly [string, string])[] = [
  ["Space", "play, pause"],
  ["← →", "one frame back, on"],
  ["Shift ← →", "ten frames back, on"],
  ["Home, End", "to the beginning, to the end"],
  ["+ −", "play faster, slower"],
  ["1 2 3", "camera: side, front, free"],
  ["A D W S, Q E", "turn the figure, zoom (click it first)"],
  ["C", "gait cycle or time"],
  ["T", "dark or light"],
  ["?", "this help"],
];

const HINTS: readonly string[] = [
  "Move over a curve, or press and drag: the figure goes to that instant of that cycle.",
  "⋯ at a panel saves it as PNG, SVG or CSV.",
  "Everything is in this one file; it asks nothing of any network.",
];

/** A dialog with keys and hints; opens with the returned function. */
export function helpDialog(): { readonly dialog: HTMLDialogElement; open(): void } {
  const rows = KEYS.map(([key, what]) =>
    element("div", {}, element("dt", {}, element("kbd", {}, key)), element("dd", {}, what)),
  );
  const dialog = element(
    "dialog",
    { class: "help", "aria-labelledby": "help-title" },
    element("h2", { id: "help-title" }, "Help"),
    element("dl", {}, ...rows),
    element("ul", {}, ...HINTS.map((hint) => element("li", {}, hint))),
  );
  dialog.append(button("Close", "Close", () => dialog.close()));
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog && outside(dialog, event)) {
      dialog.close();
    }
  });
  const open = (): void => {
    if (!dialog.open) {
      dialog.showModal();
    }
  };
  return { dialog, open };
}

/** Whether a click was beside the dialog. */
function outside(dialog: HTMLElement, event: MouseEvent): boolean {
  const { left, right, top, bottom } = dialog.getBoundingClientRect();
  return event.clientX < left || event.clientX > right || event.clientY < top || event.clientY > bottom;
}
