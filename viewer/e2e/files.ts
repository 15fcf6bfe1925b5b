/** A column of a table over time. */
export interface Column {
  times: number[];
  values: number[];
}

/** Columns by name of a `.mot` or `.sto` file. */
export function readTable(text: string): Map<string, Column> {
  const lines = text
    .slice(text.indexOf("endheader"))
    .split("\n")
    .slice(1)
    .filter((line) => line.trim() !== "");
  const names = lines[0]?.split("\t").map((name) => name.trim()) ?? [];
  const rows = lines.slice(1).map((line) => line.split("\t").map(Number));
  const times = rows.map((row) => row[0] ?? Number.NaN);
  return new Map(names.map((name, at) => [name, { times, values: rows.map((row) => row[at] ?? Number.NaN) }]));
}

/** Values from 0 to 100 % of `cycles.csv`, by `side cycle quantity`. */
export function readCycles(text: string): Map<string, number[]> {
  const [head, ...rows] = text.split("\n").filter((line) => line.trim() !== "" && !line.startsWith("#"));
  const names = head?.split(",") ?? [];
  const place = (name: string): number => names.indexOf(name);
  const out = new Map<string, number[]>();
  for (const row of rows) {
    const cells = row.split(",");
    const cell = (name: string): string => cells[place(name)] ?? "";
    const key = `${cell("side")} ${cell("cycle")} ${cell("quantity")}`;
    const values = out.get(key) ?? [];
    values[Math.round(Number(cell("percent")))] = cell("value") === "" ? Number.NaN : Number(cell("value"));
    out.set(key, values);
  }
  return out;
}
