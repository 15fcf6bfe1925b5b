// The command in a worker, without any connection.

import type { Request } from "./request";
import type { Ended, Files } from "./wasi";
import type { FromWorker, ToWorker } from "./worker";

/** Content-Security-Policy from the moment when program and page are loaded: nothing may be loaded, sent or opened any more. */
export function forbidConnections(document: Document): void {
  const first = document.querySelector<HTMLMetaElement>('meta[http-equiv="Content-Security-Policy"]');
  const named = first?.content.match(/'sha256-[^']+'/g)?.join(" ") ?? "'none'";
  const meta = document.createElement("meta");
  meta.httpEquiv = "Content-Security-Policy";
  meta.content = [
    "default-src 'none'",
    `script-src 'wasm-unsafe-eval' ${named}`,
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

/** The file in which the command finds a request; no dropped file has this name. */
const REQUEST = ".request.json";

/** How the command takes a request. */
export interface Handling {
  /** Further options of the verb, as the visitor typed them: the command reads them. */
  options?: string;
  /** Print JSON, or only the command line that means the same. */
  print?: "--json" | "--words";
}

/** Why the visitor stopped a command. */
export class Stopped extends Error {}

/** Runs commands in a worker. */
export class Engine {
  private worker: Worker;
  private reject: ((reason: Error) => void) | undefined;
  private stops = 0;
  /** Settled when the command before has ended. */
  private last: Promise<unknown> = Promise.resolve();

  /** `script` is the text of the worker: only a worker from memory inherits the policy of the page. */
  constructor(
    private readonly module: WebAssembly.Module,
    private readonly script: string,
  ) {
    this.worker = this.start();
  }

  /** Runs a request after those before; the files are copied. */
  run(request: Request, files: Files, { options, print }: Handling = {}): Promise<Ended> {
    const typed = options?.trim() ? ["--options", options] : [];
    const words = ["run", REQUEST, ...typed, ...(print ? [print] : [])];
    const all = new Map([...files, [REQUEST, new TextEncoder().encode(JSON.stringify(request))]]);
    const before = this.stops;
    const ended = this.last.then(() => {
      if (before !== this.stops) {
        throw new Stopped();
      }
      return this.runNow(words, all);
    });
    this.last = ended.catch(() => {});
    return ended;
  }

  /** Ends the running command, and all that wait. */
  stop(): void {
    this.stops++;
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
