import type { Context } from "./context";
import type { Actions } from "./controls";
import { switchTheme } from "./style";

/** The action of a key, if it has one. */
export function keyAction(key: string, shift: boolean, context: Context, actions: Actions): (() => void) | null {
  const { clock, display } = context;
  const frames = shift ? 10 : 1;
  switch (key) {
    case " ":
      return () => clock.toggle();
    case "ArrowLeft":
      return () => clock.nudge(-frames);
    case "ArrowRight":
      return () => clock.nudge(frames);
    case "Home":
      return () => clock.seek(clock.start);
    case "End":
      return () => clock.seek(clock.end);
    case "+":
    case "=":
      return () => actions.faster(1);
    case "-":
    case "−":
      return () => actions.faster(-1);
    case "1":
      return () => actions.camera("side");
    case "2":
      return () => actions.camera("front");
    case "3":
      return () => actions.camera("free");
    case "c":
    case "C":
      return () => {
        display.axis = display.axis === "cycle" ? "time" : "cycle";
      };
    case "t":
    case "T":
      return switchTheme;
    case "?":
      return () => actions.help();
    default:
      return null;
  }
}

/** Handles keys, except where the focused element uses them. */
export function listenToKeys(context: Context, actions: Actions): void {
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented || ownMeaning(event)) {
      return;
    }
    const action = keyAction(event.key, event.shiftKey, context, actions);
    if (action) {
      event.preventDefault();
      action();
    }
  });
}

/** Whether a button, list, slider or open dialog uses the key itself. */
function ownMeaning(event: KeyboardEvent): boolean {
  const target = event.target instanceof Element ? event.target : null;
  if (document.querySelector("dialog[open]") || target?.closest("select, input:not([type=range]), textarea")) {
    return true;
  }
  if (target?.closest("button, summary, a")) {
    return event.key === " " || event.key === "Enter";
  }
  const scrolls = target?.closest(".scroll") !== null && target !== null;
  return scrolls && event.key.startsWith("Arrow");
}
