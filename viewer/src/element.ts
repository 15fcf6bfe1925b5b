/** Attributes of an element; `class`, `aria-label`, ... */
type Attributes = Readonly<Record<string, string | number>>;

const SVG = "http://www.w3.org/2000/svg";

/** An HTML element with attributes and children. Strings become text, never markup. */
export function element<K extends keyof HTMLElementTagNameMap>(
  name: K,
  attributes: Attributes = {},
  ...children: readonly (Node | string)[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(name);
  setAttributes(made, attributes);
  made.append(...children);
  return made;
}

/** An SVG element with attributes and children. */
export function svgElement<K extends keyof SVGElementTagNameMap>(
  name: K,
  attributes: Attributes = {},
  ...children: readonly (Node | string)[]
): SVGElementTagNameMap[K] {
  const made = document.createElementNS(SVG, name);
  setAttributes(made, attributes);
  made.append(...children);
  return made;
}

/** A button with a visible text or icon, a name for screen readers, and an action. */
export function button(name: string, content: Node | string, action: () => void): HTMLButtonElement {
  const made = element("button", { type: "button", title: name }, content);
  if (typeof content !== "string" || content !== name) {
    made.setAttribute("aria-label", name);
  }
  made.addEventListener("click", action);
  return made;
}

/** Buttons of which exactly one is pressed; `choose` changes the pressed one without calling the action. */
export function choice<T extends string>(
  name: string,
  options: readonly (readonly [T, string])[],
  first: T,
  action: (value: T) => void,
): { readonly group: HTMLElement; choose(value: T): void } {
  const buttons = new Map<T, HTMLButtonElement>();
  const choose = (value: T): void => {
    for (const [key, one] of buttons) {
      one.setAttribute("aria-pressed", String(key === value));
    }
  };
  for (const [value, word] of options) {
    const one = button(word, word, () => {
      choose(value);
      action(value);
    });
    buttons.set(value, one);
  }
  choose(first);
  const group = element("div", { class: "choice", role: "group", "aria-label": name }, ...buttons.values());
  return { group, choose };
}

function setAttributes(made: Element, attributes: Attributes): void {
  for (const [name, value] of Object.entries(attributes)) {
    made.setAttribute(name, String(value));
  }
}
