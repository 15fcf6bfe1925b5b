import { type Drawing, type Line, sideName } from "./drawing";
import { svgElement } from "./element";
import { lineLook, pixels, type Scheme } from "./look";
import { ROOM } from "./plot";
import { colour, STYLE } from "./style";
import type { Size } from "./vector";

/** Title, axis name and legend texts of a drawing. */
export interface Words {
  readonly title: string;
  readonly unit: string;
  readonly positive: string;
  readonly negative: string;
  /** Short source of the grey band; empty if there is no band. */
  readonly band: string;
}

/** Margins for the captions of a saved picture [CSS px]. */
export const CAPTIONS = { above: 20, below: 34 } as const;

const SAMPLE = 20;

/** Meaning of positive and negative values. */
export function directionWords({ positive, negative }: Words): string {
  return [...(positive ? [`↑ ${positive}`] : []), ...(negative ? [`↓ ${negative}`] : [])].join("   ");
}

/** Title, axis and legend of a saved picture. */
export function captions(
  drawing: Drawing,
  scheme: Scheme,
  words: Words,
  size: Size,
  sessions: readonly string[],
): SVGElement[] {
  const small = { fill: colour("quiet"), "font-size": pixels(STYLE.font.note_pt) };
  const title = words.unit ? `${words.title} [${words.unit}]` : words.title;
  const middle = (ROOM.left + size.width - ROOM.right) / 2;
  const below = size.height - CAPTIONS.below;
  const axis = drawing.axis === "cycle" ? "Gait cycle" : "Time";
  const banded = drawing.areas.some((area) => area.kind === "band") && words.band !== "";
  return [
    text(title, { x: ROOM.left, y: 14, fill: colour("text"), "font-size": pixels(STYLE.font.panel_pt) }),
    text(directionWords(words), { ...small, x: size.width - ROOM.right, y: 13, "text-anchor": "end" }),
    text(axis, { ...small, x: middle, y: below + 9, "text-anchor": "middle" }),
    ...legend(drawing, scheme, size, sessions),
    ...(banded
      ? [
          text(`grey: ${words.band}`, {
            ...small,
            x: size.width - ROOM.right,
            y: size.height - 6,
            "text-anchor": "end",
          }),
        ]
      : []),
  ];
}

/** Legend entries: a line sample and a name per side and session. */
function legend(drawing: Drawing, scheme: Scheme, size: Size, sessions: readonly string[]): SVGElement[] {
  const thick = drawing.lines.filter((line) => line.role === "mean" || line.role === "main");
  const predicted = drawing.lines.filter((line) => line.role === "predicted").slice(0, 1);
  const y = size.height - 9;
  let x: number = ROOM.left;
  return [...thick, ...predicted].flatMap((line) => {
    const name = nameOf(line, sessions);
    const look = lineLook(line, scheme);
    const dash = look.dash.length > 0 ? { "stroke-dasharray": look.dash.join(" ") } : {};
    const sample = { x1: x, x2: x + SAMPLE, y1: y, y2: y, stroke: look.colour, "stroke-width": look.width, ...dash };
    const word = text(name, {
      x: x + SAMPLE + 4,
      y: y + 3,
      fill: colour("quiet"),
      "font-size": pixels(STYLE.font.note_pt),
    });
    // The width of a letter is about half its height.
    x += SAMPLE + 14 + name.length * 0.52 * pixels(STYLE.font.note_pt);
    return [svgElement("line", sample), word];
  });
}

function nameOf(line: Line, sessions: readonly string[]): string {
  if (line.role === "predicted") {
    return "predicted";
  }
  const side = line.side === null || line.variant > 0 ? line.name : sideName(line.side);
  return sessions.length > 1 ? `${sessions[line.session] ?? ""} ${side}` : side;
}

function text(words: string, attributes: Readonly<Record<string, string | number>>): SVGElement {
  return svgElement("text", attributes, words);
}
