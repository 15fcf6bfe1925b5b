// The index of the documents for the search page: which words are in which part of which document.
//
// A part is a heading with the text below it. `parts` has title and address of each; `words` has, for every word, the
// numbers of its parts, each as the distance from the one before. A word in a heading counts more: its number is
// negative.

/**
 * Words of a text in small letters: letters and digits, joined by `_`, `.` and `-` as in names of options and files.
 */
export function wordsOf(text) {
  return text.toLowerCase().match(/[\p{L}\p{N}]+(?:[_.-][\p{L}\p{N}]+)*/gu) ?? [];
}

/** A word, and its pieces if it is joined from several. */
function* pieces(word) {
  yield word;
  const parts = word.split(/[_.-]/);
  if (parts.length > 1) {
    yield* parts;
  }
}

/** Text of tokens, code included. */
function textOf(tokens) {
  return tokens.map((token) => `${token.content} ${textOf(token.children ?? [])}`).join(" ");
}

/** The parts of a document: title, address of the heading, tokens. */
function partsOf(document, place) {
  const parts = [];
  const title = document.headings[0]?.text ?? document.path;
  let open = { title, address: place, heading: title, tokens: [] };
  parts.push(open);
  document.tokens.forEach((token, index) => {
    if (token.type === "heading_open" && Number(token.tag.slice(1)) > 1) {
      const heading = document.tokens[index + 1]?.children?.map((child) => child.content).join("") ?? "";
      open = { title: `${title}: ${heading}`, address: `${place}#${token.attrGet("id")}`, heading, tokens: [] };
      parts.push(open);
    } else if (token.type === "inline" || token.type === "fence" || token.type === "code_block") {
      // The words of links and code are among the children, too.
      open.tokens.push({ content: token.content, children: [] });
    }
  });
  return parts;
}

/** The index as JSON; `documents` has pairs of a document and its place. */
export function searchIndex(documents) {
  const parts = documents.flatMap(([document, place]) => partsOf(document, place));
  const words = new Map();
  parts.forEach((part, number) => {
    const inHeading = new Set(wordsOf(part.heading).flatMap((word) => [...pieces(word)]));
    const all = new Set([...inHeading, ...wordsOf(textOf(part.tokens)).flatMap((word) => [...pieces(word)])]);
    for (const word of [...all].filter((word) => word.length > 1 && word.length < 40 && !/^[\d.-]+$/.test(word))) {
      words.set(word, [...(words.get(word) ?? []), [number, inHeading.has(word)]]);
    }
  });
  const packed = [...words]
    .sort(([a], [b]) => (a < b ? -1 : 1))
    .map(([word, found]) => {
      let last = -1;
      const numbers = found.map(([number, isHeading]) => {
        const step = number - last;
        last = number;
        return isHeading ? -step : step;
      });
      return [word, numbers];
    });
  return JSON.stringify({ parts: parts.map(({ title, address }) => [title, address]), words: packed });
}
