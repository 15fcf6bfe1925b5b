import { element } from "./element";

/** A section of the page with a heading and an entry in the contents; nothing if it is empty. */
export function chapter(id: string, title: string, parts: readonly HTMLElement[]): HTMLElement[] {
  const heading = element("h2", { id: `${id}-title` }, title);
  const attributes = { class: "chapter", id, "aria-labelledby": `${id}-title` };
  return parts.length > 0 ? [element("section", attributes, heading, ...parts)] : [];
}

/** Tables in a row; nothing if there are none. */
export function abreast(parts: readonly HTMLElement[]): HTMLElement[] {
  return parts.length > 0 ? [element("div", { class: "tables" }, ...parts)] : [];
}
