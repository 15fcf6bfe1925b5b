import { CAPTIONS, captions, type Words } from "./caption";
import type { Drawing, Line } from "./drawing";
import type { Scheme } from "./look";
import { colour } from "./style";
import { vector } from "./vector";

/** Size of a saved picture [CSS px]: one column of a journal, 85 mm. */
const SIZE = { width: 321, height: 254, ...CAPTIONS };
/** Dots of a saved PNG per CSS pixel: 576 dots per inch. */
const DOTS = 6;

/** Saves a drawing as SVG. */
export function saveSvg(
  name: string,
  drawing: Drawing,
  scheme: Scheme,
  words: Words,
  sessions: readonly string[],
): void {
  save(`${name}.svg`, new Blob([svgText(drawing, scheme, words, sessions)], { type: "image/svg+xml" }));
}

/** Saves a drawing as PNG on the background of the theme. */
export async function savePng(
  name: string,
  drawing: Drawing,
  scheme: Scheme,
  words: Words,
  sessions: readonly string[],
): Promise<void> {
  const image = new Image();
  image.src = URL.createObjectURL(new Blob([svgText(drawing, scheme, words, sessions)], { type: "image/svg+xml" }));
  await image.decode();
  URL.revokeObjectURL(image.src);
  const canvas = document.createElement("canvas");
  canvas.width = SIZE.width * DOTS;
  canvas.height = SIZE.height * DOTS;
  const context = canvas.getContext("2d");
  if (!context) {
    return;
  }
  context.fillStyle = colour("paper");
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.drawImage(image, 0, 0, canvas.width, canvas.height);
  canvas.toBlob((blob) => {
    if (blob) {
      save(`${name}.png`, blob);
    }
  }, "image/png");
}

/** Saves a drawing as CSV: the horizontal axis, then one column per curve. */
export function saveCsv(name: string, drawing: Drawing, words: Words, sessions: readonly string[]): void {
  save(`${name}.csv`, new Blob([csvText(drawing, words, sessions)], { type: "text/csv" }));
}

/** Curves as CSV with six digits; gaps are empty. */
export function csvText(drawing: Drawing, words: Words, sessions: readonly string[]): string {
  const lines = drawing.lines.filter((line) => line.role !== "infeasible");
  const head = [
    drawing.axis === "cycle" ? "cycle [%]" : "time [s]",
    ...lines.map((line) => columnName(line, words, sessions)),
  ];
  const places = [...new Set(lines.flatMap((line) => [...line.x]))].sort((a, b) => a - b);
  const columns = lines.map((line) => new Map(Array.from(line.x, (x, i) => [x, line.y[i] ?? Number.NaN])));
  const rows = places.map((x) => [number(x), ...columns.map((column) => number(column.get(x) ?? Number.NaN))]);
  return [head.map(quoted), ...rows].map((row) => `${row.join(",")}\n`).join("");
}

function columnName(line: Line, words: Words, sessions: readonly string[]): string {
  const session = sessions.length > 1 ? `${sessions[line.session] ?? ""}, ` : "";
  return `${session}${line.name}${words.unit ? ` [${words.unit}]` : ""}`;
}

function number(value: number): string {
  return Number.isFinite(value) ? String(Number(value.toPrecision(6))) : "";
}

/** A field of a CSV file, escaped so that no spreadsheet takes it for a formula. */
function quoted(text: string): string {
  const plain = /^[=+\-@\t\r]/.test(text) ? `'${text}` : text;
  return /[",\r\n]/.test(plain) ? `"${plain.replaceAll('"', '""')}"` : plain;
}

function svgText(drawing: Drawing, scheme: Scheme, words: Words, sessions: readonly string[]): string {
  const picture = vector(drawing, scheme, SIZE);
  picture.append(...captions(drawing, scheme, words, SIZE, sessions));
  return new XMLSerializer().serializeToString(picture);
}

function save(name: string, blob: Blob): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name.replace(/[^\w.-]+/g, "_");
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
