// The command in a worker, without any connection.

import type { Ended, Files } from "./wasi";
import type { FromWorker, ToWorker } from "./worker";

/** Content-Security-Policy from the moment when program and page are loaded: nothing may be loaded, sent or opened any more. */
export function forbidConnections(document: Document): void {
  const first = document.querySelector<HTMLMetaElement>('meta[http-equiv="Content-Security-Policy"]');
  const report = first?.content.match(/'sha256-[^']+'/)?.[0] ?? "'none'";
  const meta = document.createElement("meta");
  meta.httpEquiv = "Content-Security-Policy";
  meta.content = [
    "default-src 'none'",
    `script-src 'wasm-unsafe-eval' ${report}`,
    "style-src 'unsafe-inline'",
    "img-src data: blob:",
    "font-src data:",
    "worker-src blob:",
    "frame-src blob:",
    "form-action 'none'",
    "base-uri 'none'",
  ].join("; ");
  document.head.append(meta);
}

/** Why the visitor stopped a command. */
export class Stopped extends Error {}

/** Runs commands in a worker. */
export class Engine {
  private worker: Worker;
  private reject: ((reason: Error) => void) | undefined;
  /** Settled when the command before has ended. */
  private last: Promise<unknown> = Promise.resolve();

  /** `script` is the text of the worker: only a worker from memory inherits the policy of the page. */
  constructor(
    private readonly module: WebAssembly.Module,
    private readonly script: string,
  ) {
    this.worker = this.start();
  }

  /** Runs a command after those before; the files are copied. */
  run(words: string[], files: Files): Promise<Ended> {
    const ended = this.last.then(() => this.runNow(words, files));
    this.last = ended.catch(() => {});
    return ended;
  }

  /** Ends the running command. */
  stop(): void {
    this.worker.terminate();
    this.reject?.(new Stopped());
    this.worker = this.start();
  }

  private runNow(words: string[], files: Files): Promise<Ended> {
    return new Promise((resolve, reject) => {
      this.reject = reject;
      this.worker.onerror = (event) => reject(new Error(event.message));
      this.worker.onmessage = ({ data }: MessageEvent<FromWorker>) => {
        if ("ended" in data) {
          resolve(data.ended);
        } else {
          reject(new Error(data.broken));
        }
      };
      this.send({ words, files });
    });
  }

  private start(): Worker {
    const address = URL.createObjectURL(new Blob([this.script], { type: "text/javascript" }));
    this.worker = new Worker(address);
    this.send({ module: this.module });
    return this.worker;
  }

  private send(message: ToWorker): void {
    this.worker.postMessage(message);
  }
}
