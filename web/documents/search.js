// The search page: shows the parts of the documents that have all words of the question. Nothing is sent anywhere.
const MOST = 40;
const field = document.querySelector("#question");
const list = document.querySelector("#found");
const count = document.querySelector("#count");

const asked = (text) => text.toLowerCase().match(/[\p{L}\p{N}]+(?:[_.-][\p{L}\p{N}]+)*/gu) ?? [];

/** Weight of each part for one word; words that only begin with it count less, rare words more. */
function weights({ parts, words }, word) {
  const found = new Map();
  for (const [known, steps] of words) {
    if (known.startsWith(word)) {
      const rare = Math.log(1 + parts.length / steps.length) * (known === word ? 1 : 0.4);
      let number = -1;
      for (const step of steps) {
        number += Math.abs(step);
        found.set(number, Math.max(found.get(number) ?? 0, rare * (step < 0 ? 4 : 1)));
      }
    }
  }
  return found;
}

/** Numbers of the parts that have all words, the best first. */
function search(index, question) {
  const all = asked(question).map((word) => weights(index, word));
  const [first, ...others] = all;
  const both = [...(first ?? new Map()).keys()].filter((number) => others.every((found) => found.has(number)));
  const weight = (number) => all.reduce((sum, found) => sum + found.get(number), 0);
  return both.sort((a, b) => weight(b) - weight(a) || a - b);
}

function show(index) {
  const found = search(index, field.value);
  list.replaceChildren(
    ...found.slice(0, MOST).map((number) => {
      const [title, address] = index.parts[number];
      const item = document.createElement("li");
      const link = document.createElement("a");
      link.href = address;
      link.textContent = title;
      item.append(link);
      return item;
    }),
  );
  const more = found.length > MOST ? `, the first ${MOST} are shown` : "";
  const words = ["No part of the documents has", "One part of the documents has"][found.length];
  const many = words ?? `${found.length} parts of the documents have`;
  count.textContent = field.value.trim() === "" ? "" : `${many} these words${more}.`;
}

field.value = new URLSearchParams(location.search).get("q") ?? "";
fetch("search-index.json")
  .then((answer) => answer.json())
  .then((index) => {
    show(index);
    field.addEventListener("input", () => show(index));
    document.documentElement.dataset.ready = "yes";
  })
  .catch((error) => {
    count.textContent = `The index could not be loaded: ${error.message}`;
  });
field.focus();
