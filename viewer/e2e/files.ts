/** A column of a table over time. */
export interface Column {
  times: number[];
  values: number[];
}

/** Columns by name of a `.mot`, `.sto` or `.csv` file. */
export function readTable(text: string): Map<string, Column> {
  const header = text.indexOf("endheader");
  const separator = header < 0 ? "," : "\t";
  const lines = text
    .slice(Math.max(header, 0))
    .split("\n")
    .slice(header < 0 ? 0 : 1)
    .filter((line) => line.trim() !== "" && !line.startsWith("#"));
  const names = lines[0]?.split(separator).map((name) => name.trim()) ?? [];
  const rows = lines.slice(1).map((line) => line.split(separator).map(Number));
  const times = rows.map((row) => row[0] ?? Number.NaN);
  return new Map(names.map((name, at) => [name, { times, values: rows.map((row) => row[at] ?? Number.NaN) }]));
}

/** A column over a gait cycle: linear interpolation at 0 to 100 %. */
export function timeNormalised({ times, values }: Column, start: number, end: number): number[] {
  return Array.from({ length: 101 }, (_, percent) => {
    const time = start + (percent / 100) * (end - start);
    const next = Math.max(
      times.findIndex((instant) => instant >= time - 1e-9),
      1,
    );
    const [before, after] = [times[next - 1] ?? Number.NaN, times[next] ?? Number.NaN];
    const share = Math.min((time - before) / (after - before), 1);
    return (values[next - 1] ?? Number.NaN) * (1 - share) + (values[next] ?? Number.NaN) * share;
  });
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
