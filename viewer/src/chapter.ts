import { element } from "./element";

/** A part of the page with its heading and a place in the list of contents; nothing if it would be empty. */
export function chapter(id: string, title: string, parts: readonly HTMLElement[]): HTMLElement[] {
  const heading = element("h2", { id: `${id}-title` }, title);
  const attributes = { class: "chapter", id, "aria-labelledby": `${id}-title` };
  return parts.length > 0 ? [element("section", attributes, heading, ...parts)] : [];
}

/** Things side by side, if there are any. */
export function abreast(parts: readonly HTMLElement[]): HTMLElement[] {
  return parts.length > 0 ? [element("div", { class: "tables" }, ...parts)] : [];
}
