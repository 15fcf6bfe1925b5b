import { Clock } from "./clock";
import { readPage } from "./read_page";
import { followSystem } from "./style";
import { createView } from "./view3d";
import "./page.css";

/** Draws the page, or says why it cannot be drawn. */
async function main(root: HTMLElement): Promise<void> {
  followSystem();
  const { page, numbers } = await readPage();
  const first = page.sessions[0];
  if (!first) {
    throw new Error("This report holds no session.");
  }
  const clock = new Clock(first.time);
  const host = document.createElement("div");
  host.className = "view";
  root.append(host);
  const view = createView(host, page, numbers, clock);
  Object.assign(window, { ambulo: { page, numbers, clock, view, panels: {} } });
  requestAnimationFrame(() => {
    document.documentElement.dataset["ready"] = "true";
  });
}

const root = document.getElementById("ambulo");
if (root) {
  main(root).catch((error: unknown) => {
    const message = document.createElement("p");
    message.setAttribute("role", "alert");
    message.textContent = error instanceof Error ? error.message : String(error);
    root.replaceChildren(message);
  });
}
