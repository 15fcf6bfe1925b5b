import type { Area, Drawing, Line } from "./drawing";
import { svgElement } from "./element";
import { areaLook, lineLook, pixels, type Scheme, sideLook } from "./look";
import { barLook, MARK, ROOM, runs, ticksOf, xWords, yWords } from "./plot";
import { colour, STYLE } from "./style";

/** Positions of values in a picture [CSS px]. */
interface Frame {
  readonly left: number;
  readonly right: number;
  readonly top: number;
  readonly bottom: number;
  x(value: number): number;
  y(value: number): number;
}

/** Size of a picture and of its margins for text above and below [CSS px]. */
export interface Size {
  readonly width: number;
  readonly height: number;
  readonly above: number;
  readonly below: number;
}

/** A drawing as SVG, as on the screen: for print, where the page has the texts, and for saving, with `captions`. */
export function vector(drawing: Drawing, scheme: Scheme, size: Size): SVGSVGElement {
  const frame = frameOf(drawing, size);
  const picture = svgElement("svg", {
    viewBox: `0 0 ${size.width} ${size.height}`,
    width: size.width,
    height: size.height,
    "font-family": STYLE.font.family,
    "font-size": pixels(STYLE.font.tick_pt),
  });
  picture.append(...drawing.areas.map((area) => surface(area, frame, scheme)));
  picture.append(...shades(drawing, frame), ...grid(drawing, frame), ...axes(frame));
  picture.append(...drawing.lines.map((line) => curve(line, frame, scheme)));
  picture.append(...bars(drawing, frame), ...marks(drawing, frame, scheme));
  return picture;
}

function frameOf(drawing: Drawing, size: Size): Frame {
  const left = ROOM.left;
  const right = size.width - ROOM.right;
  const top = ROOM.top + size.above;
  const bottom = size.height - size.below - ROOM.bottom;
  const x = (value: number): number => left + ((value - drawing.x[0]) / (drawing.x[1] - drawing.x[0])) * (right - left);
  const y = (value: number): number =>
    bottom - ((value - drawing.y[0]) / (drawing.y[1] - drawing.y[0])) * (bottom - top);
  return { left, right, top, bottom, x, y };
}

function surface(area: Area, frame: Frame, scheme: Scheme): SVGElement {
  const look = areaLook(area, scheme);
  const point = (i: number, values: Float64Array): string => place(frame, area.x[i] ?? 0, values[i] ?? 0);
  const d = runs(area).map(([from, to]) => {
    const there = Array.from({ length: to - from }, (_, k) => point(from + k, area.high));
    const back = Array.from({ length: to - from }, (_, k) => point(to - 1 - k, area.low));
    return `M${[...there, ...back].join("L")}Z`;
  });
  return svgElement("path", { d: d.join(""), fill: look.colour, "fill-opacity": look.opacity });
}

function curve(line: Line, frame: Frame, scheme: Scheme): SVGElement {
  const look = lineLook(line, scheme);
  const d = runs({ low: line.y, high: line.y }).map(([from, to]) => {
    const points = Array.from({ length: to - from }, (_, k) =>
      place(frame, line.x[from + k] ?? 0, line.y[from + k] ?? 0),
    );
    return `M${points.join("L")}`;
  });
  return svgElement("path", {
    d: d.join(""),
    fill: "none",
    stroke: look.colour,
    "stroke-width": look.width,
    "stroke-opacity": look.opacity,
    "stroke-linejoin": "round",
    ...(look.dash.length > 0 ? { "stroke-dasharray": look.dash.join(" ") } : {}),
  });
}

function shades(drawing: Drawing, frame: Frame): SVGElement[] {
  return drawing.shades.map(({ from, to }) =>
    svgElement("rect", {
      x: frame.x(from),
      y: frame.top,
      width: Math.max(frame.x(to) - frame.x(from), 1),
      height: frame.bottom - frame.top,
      fill: colour("infeasible"),
      "fill-opacity": 0.12,
    }),
  );
}

function grid(drawing: Drawing, frame: Frame): SVGElement[] {
  const ticks = ticksOf(drawing);
  const fill = colour("quiet");
  const width = pixels(STYLE.lines_pt.grid);
  const across = yWords(ticks.y).flatMap((word, i) => {
    const y = frame.y(ticks.y[i] ?? 0);
    const text = { x: frame.left - 5, y: y + 3, fill, "text-anchor": "end" };
    return [straight(frame.left, y, frame.right, y, colour("grid"), width), svgElement("text", text, word)];
  });
  const upright = xWords(ticks.x, drawing.axis).flatMap((word, i) => {
    const x = frame.x(ticks.x[i] ?? 0);
    const text = { x, y: frame.bottom + 12, fill, "text-anchor": "middle" };
    return [straight(x, frame.top, x, frame.bottom, colour("grid"), width), svgElement("text", text, word)];
  });
  const zero = frame.y(0);
  const inside = drawing.y[0] < 0 && drawing.y[1] > 0;
  const line = straight(frame.left, zero, frame.right, zero, fill, pixels(STYLE.lines_pt.zero));
  return [...upright, ...across, ...(inside ? [line] : [])];
}

function axes(frame: Frame): SVGElement[] {
  const width = pixels(STYLE.lines_pt.axis);
  const ink = colour("quiet");
  return [
    straight(frame.left, frame.top, frame.left, frame.bottom, ink, width),
    straight(frame.left, frame.bottom, frame.right, frame.bottom, ink, width),
  ];
}

function bars(drawing: Drawing, frame: Frame): SVGElement[] {
  return drawing.active.map((time) => {
    const { fill, high, down } = barLook(time);
    const x = short(frame.x(time.from));
    const width = short(frame.x(time.to) - frame.x(time.from));
    return svgElement("rect", { x, y: frame.top + down, width, height: high, fill });
  });
}

function marks(drawing: Drawing, frame: Frame, scheme: Scheme): SVGElement[] {
  return drawing.marks.map((mark) => {
    const long = (mark.kind === "strike" ? 0.5 : 1) * MARK;
    const x = frame.x(mark.x);
    const ink = sideLook(mark, scheme).colour;
    const line = straight(x, frame.bottom, x, frame.bottom - long, ink, pixels(STYLE.lines_pt.tick));
    if (mark.side === "l") {
      line.setAttribute("stroke-dasharray", "2.5 1.5");
    }
    return line;
  });
}

function straight(x1: number, y1: number, x2: number, y2: number, stroke: string, width: number): SVGElement {
  const at = { x1: short(x1), y1: short(y1), x2: short(x2), y2: short(y2) };
  return svgElement("line", { ...at, stroke, "stroke-width": width });
}

function place(frame: Frame, x: number, y: number): string {
  return `${short(frame.x(x))} ${short(frame.y(y))}`;
}

/** Rounds to hundredths of a pixel. */
function short(length: number): string {
  return String(Math.round(100 * length) / 100);
}
