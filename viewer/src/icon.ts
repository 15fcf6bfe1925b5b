import { svgElement } from "./element";

/** SVG paths in a box of 16 by 16, drawn in the colour of the text. */
const PATHS = {
  play: "M4 2.5v11l9-5.5z",
  pause: "M4 2.5h3v11H4zM9 2.5h3v11H9z",
  theme: "M8 1.5a6.5 6.5 0 1 0 0 13zM8 1a7 7 0 1 1 0 14A7 7 0 0 1 8 1z",
  print: "M4 1.5h8v3H4zM2 5.5h12v6h-2v-2H4v2H2zM5 10.5h6v4H5z",
  help: "M5.2 5.4C5.4 3.5 6.5 2.6 8 2.6c1.700 0 2.900 1 2.900 2.600 0 1.300-.7 1.900-1.500 2.500-.6.500-.8.800-.8 1.700H7.300c0-1.500.5-2.100 1.300-2.700.6-.5.9-.8.9-1.500 0-.8-.6-1.300-1.500-1.300s-1.400.500-1.500 1.500zM7.100 11h1.700v1.900H7.100z",
} as const;

/** An icon for a button. */
export function icon(name: keyof typeof PATHS): SVGElement {
  const path = svgElement("path", { d: PATHS[name], fill: "currentColor" });
  return svgElement("svg", { viewBox: "0 0 16 16", width: 16, height: 16, "aria-hidden": "true" }, path);
}
