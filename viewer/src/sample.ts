import { svgElement } from "./element";
import { pixels } from "./look";
import { STYLE } from "./style";

/** A line sample for a legend. */
export function lineSample(ink: string, dash: readonly number[], width = pixels(STYLE.lines_pt.mean)): SVGElement {
  const line = svgElement("line", {
    x1: 0,
    x2: 26,
    y1: 5,
    y2: 5,
    stroke: ink,
    "stroke-width": width,
    ...(dash.length > 0 ? { "stroke-dasharray": dash.join(" ") } : {}),
  });
  return svgElement("svg", { width: 26, height: 10, "aria-hidden": "true" }, line);
}

/** An area sample for a legend. */
export function areaSample(fill: string, opacity: number): SVGElement {
  const box = svgElement("rect", { width: 18, height: 10, fill, "fill-opacity": opacity });
  return svgElement("svg", { width: 18, height: 10, "aria-hidden": "true" }, box);
}
