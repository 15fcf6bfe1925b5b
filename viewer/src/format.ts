/** Decimal places for the values of a panel, from the panel's range. */
export function digitsFor(low: number, high: number): number {
  const reach = Math.max(Math.abs(low), Math.abs(high));
  return reach >= 200 ? 0 : reach >= 10 ? 1 : reach >= 0.5 ? 2 : 3;
}

/** A value with the given decimal places and a true minus sign; a dash if it is missing. */
export function shown(value: number | undefined, digits: number): string {
  if (value === undefined || !Number.isFinite(value)) {
    return "–";
  }
  const text = value.toFixed(digits);
  return (Number(text) === 0 ? text.replace("-", "") : text).replace("-", "−");
}

/** About the given number of round axis values, spaced by 1, 2 or 5 times a power of ten. */
export function roundValues(low: number, high: number, about: number): number[] {
  const rough = (high - low) / Math.max(about, 1);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = ([1, 2, 5, 10].find((factor) => factor * power >= rough * 0.999) ?? 10) * power;
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  return Array.from({ length: Math.max(last - first + 1, 0) }, (_, i) => Number(((first + i) * step).toPrecision(12)));
}

/** Author and year of a citation: the name before the first year, or the first words if there is no year. */
export function shortCitation(citation: string): string {
  const found = /(\p{Lu}[\p{L}'-]+(?:,? (?:and|&|\p{Lu}[\p{L}'-]+|et al\.))*),? \(?((?:19|20)\d\d)\b/u.exec(citation);
  return found ? `${found[1]} ${found[2]}` : (citation.split(/[;:,.]/, 1)[0] ?? citation);
}
