// Errors of the command: which field of the page they are about, and their hints in words of the page.

/** Options that have a field of their own. */
const FIELDS = [
  ["--mass KG", "Body mass"],
  ["--height M", "Stature"],
] as const;

const [MASS, STATURE] = FIELDS.map(([option]) => option);

/** Whether an error is about what the visitor typed under "More options". */
export function aboutOptions(message: string, typed: string): boolean {
  const words = typed.split(/[\s=]+/).filter((word) => word.startsWith("-"));
  return words.some((word) => message.includes(`'${word}`) || message.includes(`\`${word}`));
}

/** Whether an error is about the body mass. */
export function aboutMass(message: string): boolean {
  return message.includes(`\`${MASS}\``) || message.startsWith("Body mass:");
}

/** Whether an error is about the stature. */
export function aboutStature(message: string): boolean {
  return message.includes(`\`${STATURE}\``) || message.startsWith("Stature:");
}

/** The file that an error begins with. */
export function nameOf(message: string): string | undefined {
  return /^error: ([^:\n]+):/.exec(message)?.[1]?.replace(/^.*\//, "");
}

/** A message of the command with the fields of the page in place of its options. */
export function inWordsOfThePage(message: string): string {
  const named = FIELDS.reduce(
    (text, [option, name]) => text.replaceAll(`\`${option}\``, `fill in the field "${name}"`),
    message.replace(/^error: /, ""),
  );
  const usage = named.indexOf("\n\nUsage: ");
  const text = (usage < 0 ? named : named.slice(0, usage)).replace(/\n\n {2}tip: [^\n]*/g, "").trim();
  return text.includes("`--") ? `${text}\n  Options are typed under "More options".` : text;
}
