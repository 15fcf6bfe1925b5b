import { button, element } from "./element";

const KEYS: readonly (readonly [string, string])[] = [
  ["Space", "play, pause"],
  ["← →", "one frame back, forward"],
  ["Shift ← →", "ten frames back, forward"],
  ["Home, End", "first frame, last frame"],
  ["+ −", "play faster, slower"],
  ["1 2 3", "camera: side, front, free"],
  ["A D W S, Q E", "rotate the figure, zoom (click it first)"],
  ["C", "switch between gait cycle and time"],
  ["T", "switch between dark and light"],
  ["?", "this help"],
];

const HINTS: readonly string[] = [
  "Move over a curve, or press and drag: the figure shows that instant of that cycle.",
  "The ⋯ menu of a panel saves it as PNG, SVG or CSV.",
  "This one file contains everything; it works offline and loads nothing from the network.",
];

/** A dialog with keys and hints; the returned function opens it. */
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

/** Whether a click was outside the dialog. */
function outside(dialog: HTMLElement, event: MouseEvent): boolean {
  const { left, right, top, bottom } = dialog.getBoundingClientRect();
  return event.clientX < left || event.clientX > right || event.clientY < top || event.clientY > bottom;
}
