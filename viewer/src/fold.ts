import { element } from "./element";

/** Number of items shown in a folded list or table; css/table.css hides the others on the screen, and print shows all. */
const FEW = 10;
/** A list or table with more items is folded at first. */
export const MANY = 15;

/** Folds a list or table to its first items, and unfolds it. */
export function foldButton(folded: HTMLElement, count: number, what: string): HTMLElement {
  const made = element("button", { type: "button", class: "fold" });
  const set = (open: boolean): void => {
    folded.classList.toggle("folded", !open);
    made.setAttribute("aria-expanded", String(open));
    made.textContent = open ? `Show the first ${FEW} ${what}` : `Show all ${count} ${what}`;
  };
  made.addEventListener("click", () => set(made.getAttribute("aria-expanded") === "false"));
  set(false);
  return made;
}
