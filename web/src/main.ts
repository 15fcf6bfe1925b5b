// The page: takes files, runs the command in a worker, shows the report and saves what was computed.

import { Engine, forbidConnections, type Handling, Stopped } from "./engine";
import { type Between, type Family, type Values, Walks } from "./family";
import { type Dropped, isVisit, type Named, OUTPUT, ROLES, type Role, requestFor, VISIT, withRoles } from "./files";
import { droppedFiles } from "./folder";
import { aboutMass, aboutOptions, aboutStature, inWordsOfThePage, nameOf } from "./mistake";
import { Preview } from "./preview";
import { Pushing } from "./pushing";
import type { Request } from "./request";
import { Sliders } from "./sliders";
import { KEPT, SCENE } from "./walker";
import type { Ended, Files } from "./wasi";
import { zip } from "./zip";

/** Names of the files that this page loads, given by build.mjs. */
declare const PROGRAM: string;
declare const WORKER: string;
declare const FAMILY: string;
declare const OFFLINE: string;
/** The script that follows links between pages of results, and its name in a policy. */
declare const LINKS: string;
declare const LINKS_NAME: string;

const OUT = `${OUTPUT}/`;
/** The page that is shown first: that of a visit or of a trial. */
const FIRST = ["session.html", "report.html"];
const SUMMARY = "summary.json";
const DEMO: Request = { demo: { output: OUTPUT } };
/** Enough to show the demo; all of its files are made when they are saved. */
const ONLY_REPORT: Request = { demo: { keep: ["report"], output: OUTPUT } };
/** Only so much may the report do; it cannot reach this page. */
const SANDBOX = "allow-scripts allow-downloads allow-modals";

/** What is computed, by the verb of the request. */
const WORK: Record<string, string> = {
  demo: "the demo walk",
  forces: "the forces of the recording",
  session: "the session of all walks",
  simulate: "the simulation",
  walk: "the walk",
};
const SECOND_MS = 1000;

/** A browser has begun to save a file after so long. */
const SAVING_MS = 10_000;

/** A result that is shown and can be saved. */
interface Shown {
  /** For the names of saved files. */
  name: string;
  /** The page that is shown, by its name in the result folder. */
  report: string | undefined;
  /** Files of the result folder. */
  files: Files;
  /** The request that makes all files, if these are not all. */
  all: Request | undefined;
}

function byId<T extends HTMLElement = HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) {
    throw new Error(`no element ${id}`);
  }
  return found as T;
}

const field = (id: string): HTMLInputElement => byId<HTMLInputElement>(id);
const control = (id: string): HTMLButtonElement => byId<HTMLButtonElement>(id);

/** The shown result: the report, a walk in between above it, or a walker who can be pushed. */
type View = "page" | "preview" | "stage";

/** The page's state. */
class Page {
  private engine: Engine | undefined;
  private files: Dropped[] = [];
  /** Roles that the visitor chose, by file. */
  private readonly chosen = new Map<string, Role>();
  private shown: Shown | undefined;
  /** Name of the folder that was dropped. */
  private folder = VISIT;
  /** The request of which the command line is shown. */
  private lined = 0;
  private running = false;
  /** Whether another walk than the shown one is asked for. */
  private stale = false;
  /** A walk that was asked for while another command runs. */
  private next: Request | undefined;
  private view: View = "page";
  private previews: Preview | undefined;
  private readonly pushing = new Pushing(
    {
      picture: byId("picture"),
      note: byId("stage-note"),
      time: byId("stage-time"),
      play: control("play"),
      again: control("again"),
      alone: control("alone"),
      behind: control("behind"),
      front: control("front"),
      faster: field("faster"),
      fasterText: byId("faster-text"),
    },
    (scene) => this.simulate(scene),
  );
  private readonly sliders = new Sliders(
    byId<HTMLFormElement>("walk"),
    (values) => this.preview(values),
    (request) => this.walk(request),
  );

  constructor() {
    field("files").addEventListener("change", () => {
      this.reading(this.add([...(field("files").files ?? [])]));
      field("files").value = "";
    });
    this.takeDrops();
    for (const id of ["mass", "height", "more"]) {
      field(id).addEventListener("input", () => this.changed());
    }
    byId<HTMLSelectElement>("pages").addEventListener("change", () => this.showPage());
    addEventListener("message", ({ data, source }) => this.follow(data?.open, source));
    byId("options").addEventListener("submit", (event) => {
      event.preventDefault();
      this.compute();
    });
    byId("push").addEventListener("submit", (event) => {
      event.preventDefault();
      this.see("stage");
      this.open(false);
      this.pushing.start();
    });
    control("back").addEventListener("click", () => this.see("page"));
    control("save-scene").addEventListener("click", () =>
      save(new Blob([this.pushing.scene], { type: "text/plain" }), SCENE),
    );
    control("demo").addEventListener("click", () => this.demo());
    control("stop").addEventListener("click", () => this.engine?.stop());
    control("toggle").addEventListener("click", () => this.open(byId("input").classList.contains("closed")));
    control("save-report").addEventListener("click", () => this.saveReport());
    control("save-all").addEventListener("click", () => this.saveAll());
  }

  /** Loads the program, forbids connections, and shows the demo. */
  async start(): Promise<void> {
    const [module, script, family] = await Promise.all([
      program(),
      fetch(WORKER).then((answer) => answer.text()),
      fetch(FAMILY).then((answer) => answer.json() as Promise<Family>),
    ]);
    keepOffline();
    forbidConnections(document);
    this.previews = new Preview(byId("preview"), new Walks(family));
    this.engine = new Engine(module, script);
    this.refresh();
    if (this.files.length === 0) {
      await this.demo();
    }
  }

  private takeDrops(): void {
    const over = (is: boolean) => (event: DragEvent) => {
      event.preventDefault();
      document.body.classList.toggle("over", is);
    };
    document.addEventListener("dragover", over(true));
    document.addEventListener("dragleave", over(false));
    document.addEventListener("drop", (event) => {
      over(false)(event);
      // The files are named before this event ends.
      const dropped = droppedFiles(event.dataTransfer);
      this.reading(dropped.then(({ files, folder }) => this.add(files, folder)));
    });
  }

  /** Shows why files could not be read. */
  private async reading(work: Promise<void>): Promise<void> {
    try {
      await work;
    } catch (thrown) {
      this.fail(`The files could not be read: ${thrown instanceof Error ? thrown.message : thrown}`);
    }
  }

  private async add(dropped: File[], folder?: string): Promise<void> {
    const read = await Promise.all(
      dropped.map(async (file): Promise<Named> => {
        return { name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) };
      }),
    );
    const names = read.map(({ name }) => name);
    const twice = names.find((name, index) => names.indexOf(name) !== index);
    if (twice !== undefined) {
      throw new Error(`found two files with the name ${twice}; expected different names. Drop them one by one.`);
    }
    const others = this.files.filter(({ name }) => read.every((file) => file.name !== name));
    this.folder = folder ?? VISIT;
    await this.take([...others, ...read]);
    this.open(true);
  }

  /** Takes these files in place of earlier ones. */
  private async take(files: Named[]): Promise<void> {
    const guessed = await withRoles(files, (file) => this.walks(file));
    this.files = guessed.map((file) => ({ ...file, role: this.chosen.get(file.name) ?? file.role }));
    this.list();
    this.changed();
  }

  /** The input is another one: an error about the input before goes away. */
  private changed(): void {
    this.forgive();
    this.refresh();
  }

  /** Hides the error and the mark of the field that it is about. */
  private forgive(): void {
    byId("error").hidden = true;
    for (const marked of document.querySelectorAll("[aria-invalid]")) {
      marked.removeAttribute("aria-invalid");
      marked.removeAttribute("aria-errormessage");
    }
  }

  /** Whether a foot strikes or leaves the ground in a recording. The computation decides the rest. */
  private async walks({ name, bytes }: Named): Promise<boolean> {
    if (!this.engine) {
      return true;
    }
    const request: Request = { events: { input: name } };
    const { code, printed } = await this.engine.run(request, new Map([[name, bytes]]), { print: "--json" });
    if (code !== 0) {
      return true;
    }
    const { events } = JSON.parse(printed) as { events: { source: string }[] };
    return events.some(({ source }) => source !== "file");
  }

  private list(): void {
    const rows = this.files.map((file) => {
      const select = document.createElement("select");
      select.setAttribute("aria-label", `${file.name} is`);
      select.append(
        ...Object.entries(ROLES).map(([role, words]) => new Option(words, role, false, role === file.role)),
      );
      select.addEventListener("change", () => {
        file.role = select.value as Role;
        this.chosen.set(file.name, file.role);
        this.changed();
      });
      const remove = document.createElement("button");
      remove.type = "button";
      remove.textContent = "Remove";
      remove.setAttribute("aria-label", `Remove ${file.name}`);
      remove.addEventListener("click", () => {
        this.chosen.delete(file.name);
        this.take(this.files.filter((other) => other !== file));
        field("files").focus();
      });
      const name = document.createElement("span");
      name.className = "name";
      name.textContent = file.name;
      const row = document.createElement("li");
      row.append(name, select, remove);
      return row;
    });
    byId("list").replaceChildren(...rows);
  }

  /** Shows the command line of a request that was run. */
  private async showLine(request: Request, options = ""): Promise<void> {
    const number = ++this.lined;
    try {
      const ended = await this.engine?.run(request, new Map(), { options, print: "--words" });
      if (number === this.lined) {
        byId("line").textContent = ended?.printed.trim() ?? "";
        byId("terminal").hidden = !ended?.printed;
      }
    } catch {
      // The visitor stopped this and all that waited; the next run shows its own.
      byId("terminal").hidden = true;
    }
  }

  private refresh(): void {
    const ready = this.engine !== undefined && !this.running;
    control("compute").disabled = !ready || this.files.length === 0;
    control("demo").disabled = !ready;
    byId("progress").hidden = !this.running;
    byId("page").classList.toggle("stale", this.stale || this.running);
    byId("result").setAttribute("aria-busy", String(this.running));
    for (const part of document.querySelectorAll<HTMLInputElement | HTMLButtonElement>("#walk :is(input, button)")) {
      part.disabled = this.engine === undefined;
    }
    for (const part of document.querySelectorAll<HTMLButtonElement>("#push button")) {
      part.disabled = !ready;
    }
    control("save-report").disabled = this.running || !this.shown?.report;
    control("save-all").disabled = this.running || !this.shown;
  }

  /** Opens or closes the input, which shares a narrow screen with the result. */
  private open(is: boolean): void {
    byId("input").classList.toggle("closed", !is);
    control("toggle").setAttribute("aria-expanded", String(is));
  }

  private async demo(): Promise<void> {
    await this.run(ONLY_REPORT, new Map(), { name: "demo", all: DEMO });
    this.sliders.restore();
  }

  /** Shows a walk that is interpolated above the report of another one, until the exact one is solved. */
  private preview(values: Values): Between | undefined {
    this.forgive();
    this.stale = true;
    const begins = this.view !== "preview";
    if (begins) {
      this.see("preview");
    }
    const walk = this.previews?.show(values);
    if (!walk) {
      this.say("No walk near these values was solved beforehand. Release the slider, and the walk is solved.");
    }
    this.refresh();
    if (begins) {
      // On a narrow screen, sliders and preview share it from now on.
      document.activeElement?.scrollIntoView({ block: "center" });
    }
    return walk;
  }

  private see(view: View): void {
    this.view = view;
    document.body.dataset["view"] = view;
    byId("preview").hidden = view !== "preview";
    byId("stage").hidden = view !== "stage";
    byId("page").hidden = view === "stage";
  }

  /** The results of a scene for the walker; none if the visitor stopped it or it failed. */
  private async simulate(scene: string): Promise<Files | undefined> {
    const request: Request = { simulate: { scene: SCENE, keep: KEPT, output: OUTPUT } };
    const ended = await this.command(request, new Map([[SCENE, new TextEncoder().encode(scene)]]));
    if (ended && ended.code > 1) {
      this.fail(ended.complained.trim());
    } else if (ended) {
      this.showLine(request);
      this.say("The walker's walk is computed.");
    }
    return ended && ended.code <= 1 ? results(ended) : undefined;
  }

  /** A walk without files; the one before is given up. */
  private async walk(request: Request): Promise<void> {
    if (this.running) {
      this.next = request;
      this.engine?.stop();
      return;
    }
    await this.run(request, new Map(), { name: "walk", all: undefined });
  }

  private async compute(): Promise<void> {
    const used = this.files.filter(({ role }) => role !== "unused");
    const main = used.find(({ role }) => role === "recording") ?? used[0];
    const isOfVisit = isVisit(used);
    const folder = isOfVisit ? `${this.folder}/` : "";
    const files = new Map(used.map(({ name, bytes }) => [folder + name, bytes]));
    const name = isOfVisit ? this.folder : (main?.name.replace(/\.[^.]*$/, "") ?? "result");
    try {
      const request = requestFor(used, { mass: field("mass").value, height: field("height").value }, this.folder);
      await this.run(request, files, { name, all: undefined }, { options: field("more").value });
    } catch (thrown) {
      this.fail(thrown instanceof Error ? thrown.message : String(thrown));
    }
  }

  private async run(
    request: Request,
    files: Files,
    shown: Pick<Shown, "name" | "all">,
    handling: Handling = {},
  ): Promise<void> {
    const start = performance.now();
    const ended = await this.command(request, files, handling);
    if (ended) {
      this.show(ended, shown, (performance.now() - start) / 1000);
      this.showLine(shown.all ?? request, handling.options);
    }
    if (this.next) {
      const next = this.next;
      this.next = undefined;
      await this.walk(next);
      return;
    }
    if (this.view === "preview") {
      this.see("page");
    }
    this.stale = false;
    this.sliders.restore();
    this.refresh();
  }

  /** Runs a command; none if another one runs, if the visitor stops it, or if it ends early. */
  private async command(request: Request, files: Files, handling: Handling = {}): Promise<Ended | undefined> {
    if (!this.engine || this.running) {
      return undefined;
    }
    this.running = true;
    this.forgive();
    this.say(`Computing ${WORK[Object.keys(request).join()] ?? ""} ...`);
    const timer = this.countSeconds();
    this.refresh();
    try {
      return await this.engine.run(request, files, handling);
    } catch (thrown) {
      if (!this.next) {
        this.fail(
          thrown instanceof Stopped ? "Stopped. The result before is unchanged." : `The program ended early: ${thrown}`,
        );
      }
      return undefined;
    } finally {
      clearInterval(timer);
      this.running = false;
      this.refresh();
    }
  }

  /** Shows how long a computation takes; not in the status, which a screen reader would read every second. */
  private countSeconds(): number {
    const start = performance.now();
    const show = (): void => {
      byId("seconds").textContent = `${((performance.now() - start) / SECOND_MS).toFixed(0)} s`;
    };
    show();
    return setInterval(show, SECOND_MS) as unknown as number;
  }

  private show(ended: Ended, { name, all }: Pick<Shown, "name" | "all">, seconds: number): void {
    const { code, printed, complained } = ended;
    const files = results(ended);
    const pages = [...files.keys()].filter((path) => path.endsWith(".html"));
    const report = FIRST.find((name) => pages.includes(name)) ?? pages[0];
    byId("said").hidden = false;
    byId<HTMLTextAreaElement>("printed").value = `${complained}${printed}`.trim();
    if (code > 1 || files.size === 0) {
      this.fail(complained.trim() || printed.trim() || `exit code ${code}`);
      return;
    }
    this.see("page");
    this.shown = { name, report, files, all };
    this.stale = false;
    const choice = byId<HTMLSelectElement>("pages");
    choice.replaceChildren(...pages.map((path) => new Option(path.replace(/^.*\//, ""), path, false, path === report)));
    byId("choice").hidden = pages.length < 2;
    this.showPage();
    const summary = files.get(SUMMARY);
    if (summary) {
      this.sliders.take(JSON.parse(new TextDecoder().decode(summary)));
    }
    this.say(`${name}: computed in ${seconds.toFixed(1)} s.`);
    this.open(false);
  }

  /** Shows the chosen page of the result. */
  private showPage(): void {
    if (!this.shown) {
      return;
    }
    const { name, files } = this.shown;
    const isShown = (): void => {
      performance.mark("shown");
      document.documentElement.dataset["shown"] = name;
    };
    this.shown.report = byId<HTMLSelectElement>("pages").value || undefined;
    const report = files.get(this.shown.report ?? "");
    byId("page").replaceChildren(...(report ? [frame(report, name, isShown)] : []));
    if (!report) {
      isShown();
    }
  }

  /** Shows the page that a link in the shown one leads to. */
  private follow(to: unknown, source: MessageEventSource | null): void {
    const choice = byId<HTMLSelectElement>("pages");
    const isShown = document.querySelector<HTMLIFrameElement>("#page iframe")?.contentWindow === source;
    const option = [...choice.options].find(({ value }) => value === to);
    if (isShown && option) {
      option.selected = true;
      this.showPage();
    }
  }

  /** Shows an error and marks the field or file that it is about. */
  private fail(message: string): void {
    const error = byId("error");
    error.hidden = false;
    error.textContent = inWordsOfThePage(message);
    const about = this.fieldOf(message);
    about?.setAttribute("aria-invalid", "true");
    about?.setAttribute("aria-errormessage", "error");
    this.say(this.shown ? `Nothing was computed. Below is still: ${this.shown.name}.` : "Nothing was computed.");
    this.open(false);
  }

  /** The field or file that an error is about. */
  private fieldOf(message: string): HTMLElement | undefined {
    if (aboutOptions(message, field("more").value)) {
      return field("more");
    }
    if (aboutMass(message)) {
      return field("mass");
    }
    if (aboutStature(message)) {
      return field("height");
    }
    const index = this.files.findIndex(({ name }) => name === nameOf(message));
    return document.querySelectorAll<HTMLElement>("#list select")[index];
  }

  private say(text: string): void {
    byId("status").textContent = text;
  }

  private saveReport(): void {
    const report = this.shown?.files.get(this.shown.report ?? "");
    if (report) {
      save(new Blob([report as Uint8Array<ArrayBuffer>], { type: "text/html" }), `${this.shown?.name}.html`);
    }
  }

  private async saveAll(): Promise<void> {
    if (!this.shown || !this.engine) {
      return;
    }
    const { name, all } = this.shown;
    if (all) {
      this.shown.files = results(await this.engine.run(all, new Map()));
      this.shown.all = undefined;
    }
    save(await zip(this.shown.files), `${name}.zip`);
  }
}

/** The files that a command wrote, by their names in its folder. */
function results({ files }: Ended): Files {
  const written = [...files].filter(([path]) => path.startsWith(OUT));
  return new Map(written.map(([path, bytes]) => [path.slice(OUT.length), bytes]));
}

/** The program; it compiles while it is loaded, where the host names its type. */
async function program(): Promise<WebAssembly.Module> {
  const answer = await fetch(PROGRAM);
  if (!answer.ok) {
    throw new Error(`${PROGRAM}: ${answer.status} ${answer.statusText}`);
  }
  const isNamed = answer.headers.get("Content-Type") === "application/wasm";
  return isNamed ? WebAssembly.compileStreaming(answer) : WebAssembly.compile(await answer.arrayBuffer());
}

/** Keeps all files of this page in the browser. Without that, or in a private window, it works with a connection only. */
function keepOffline(): void {
  if ("serviceWorker" in navigator) {
    navigator.serviceWorker.register(OFFLINE).catch(() => {});
  }
}

/** The report in a frame; `loaded` is called when it is drawn. */
function frame(report: Uint8Array, name: string, loaded: () => void): HTMLIFrameElement {
  const made = document.createElement("iframe");
  made.title = `Report: ${name}`;
  made.setAttribute("sandbox", SANDBOX);
  made.src = URL.createObjectURL(new Blob([linked(report) as Uint8Array<ArrayBuffer>], { type: "text/html" }));
  const ready = (): void => {
    URL.revokeObjectURL(made.src);
    loaded();
  };
  made.addEventListener("load", ready, { once: true });
  return made;
}

/** A page without scripts gets the one that follows its links. */
function linked(page: Uint8Array): Uint8Array {
  const html = new TextDecoder().decode(page);
  const [before, after] = ["default-src 'none'; ", "style-src"];
  if (!html.includes(`content="${before}${after}`)) {
    return page;
  }
  const allowed = html.replace(before + after, () => `${before}script-src ${LINKS_NAME}; ${after}`);
  return new TextEncoder().encode(
    allowed.replace(/<\/body>\s*<\/html>\s*$/, () => `<script>${LINKS}</script></body></html>`),
  );
}

function save(content: Blob, name: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(content);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), SAVING_MS);
}

new Page().start().catch((reason) => {
  byId("status").textContent = `The program could not be loaded: ${reason}`;
});
