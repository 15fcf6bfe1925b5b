// Runs commands, one after the other, apart from the page. It is started after the page has forbidden all connections, and inherits that.

import { type Ended, type Files, run } from "./wasi";

/** From the page: once the module, then commands. */
export type ToWorker = { module: WebAssembly.Module } | { words: string[]; files: Files };
/** To the page: the outcome of a command, or why it could not run. */
export type FromWorker = { ended: Ended } | { broken: string };

let module: WebAssembly.Module | undefined;

async function answer(words: string[], files: Files): Promise<FromWorker> {
  if (!module) {
    return { broken: "no program" };
  }
  try {
    return { ended: await run(module, ["ambulo", ...words], files) };
  } catch (thrown) {
    return { broken: String(thrown) };
  }
}

self.addEventListener("message", async ({ data }: MessageEvent<ToWorker>) => {
  if ("module" in data) {
    module = data.module;
  } else {
    self.postMessage(await answer(data.words, data.files));
  }
});
