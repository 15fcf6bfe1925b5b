/** Shows a sentence in place of the picture. */
export function say(host: HTMLElement, sentence: string): HTMLElement {
  const paragraph = document.createElement("p");
  paragraph.className = "empty";
  paragraph.textContent = sentence;
  host.append(paragraph);
  return paragraph;
}
