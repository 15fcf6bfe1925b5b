import type uPlot from "uplot";
import { directionWords, type Words } from "./caption";
import type { Context } from "./context";
import type { PageSide } from "./contract";
import { type Drawing, drawing, hasValues, type PanelSource } from "./drawing";
import { button, element } from "./element";
import { digitsFor, shortCitation, shown } from "./format";
import { lineLook, type Scheme } from "./look";
import { plot, ROOM } from "./plot";
import { followPointer } from "./pointer";
import { readings } from "./reading";
import { lineSample } from "./sample";
import { saveCsv, savePng, saveSvg } from "./save";
import { vector } from "./vector";

/** Size of a plot in print [CSS px], before it is stretched to its column. */
const PRINT = { width: 240, height: 128, above: 0, below: 0 };

/** Panel of one quantity: title, plot, value at the cursor, menu to save it. */
export class PanelView {
  readonly figure: HTMLElement;
  readonly id: string;
  readonly #context: Context;
  readonly #sources: readonly PanelSource[];
  readonly #words: Words;
  readonly #plot: HTMLElement;
  readonly #paper: HTMLElement;
  readonly #readout = element("span", { class: "readout", "aria-hidden": "true" });
  readonly #source: HTMLElement;
  readonly #absent = element("p", { class: "empty", hidden: "" }, "No values over time");
  readonly #key = element("p", { class: "key", "aria-hidden": "true" });
  readonly #values = new Map<string, HTMLElement>();
  readonly #cursors = new Map<PageSide | null, HTMLElement>();
  #drawing: Drawing | null;
  #chart: uPlot | null = null;
  #visible = false;

  constructor(context: Context, id: string, sources: readonly PanelSource[]) {
    this.id = id;
    this.#context = context;
    this.#sources = sources;
    this.#words = wordsOf(sources);
    this.#drawing = drawing(sources, context.numbers, context.display);
    this.#plot = element("div", { class: "plot", role: "img" });
    this.#paper = element("div", { class: "paper", "aria-hidden": "true" });
    this.#source = element("p", { class: "source" });
    this.figure = element("figure", { class: "panel", id: `panel-${id}` }, this.#head());
    if (this.drawable) {
      this.figure.append(this.#plot, this.#absent, this.#paper, this.#key, this.#source, ...agreements(sources));
      this.#fillWords(this.#drawing);
    } else {
      const why = sources.find(({ panel }) => panel.empty !== null)?.panel.empty;
      this.figure.append(element("p", { class: "empty" }, why ?? "There are no values of this quantity."));
    }
  }

  /** Whether there is anything to draw on either axis. */
  get drawable(): boolean {
    return hasValues(this.#sources);
  }

  /** Full source of the grey band that is drawn now; empty if there is none. */
  get citation(): string {
    return this.#source.title;
  }

  /** The current drawing. */
  get drawing(): Drawing | null {
    return this.#drawing;
  }

  /** The place of the plot on the screen. */
  get host(): HTMLElement {
    return this.#plot;
  }

  /** Whether the panel is in sight; draws it the first time that it is. */
  set visible(visible: boolean) {
    this.#visible = visible;
    if (visible) {
      this.draw();
      this.tick();
    }
  }

  /** Redraws after a change of axis or sides: at once if visible, otherwise when the panel becomes visible. */
  update(): void {
    this.#drawing = drawing(this.#sources, this.#context.numbers, this.#context.display);
    if (this.drawable) {
      this.#fillWords(this.#drawing);
    }
    this.#chart?.destroy();
    this.#chart = null;
    if (this.#visible) {
      this.draw();
      this.tick();
    }
  }

  /** Redraws in the colours of the current theme. */
  recolour(): void {
    if (this.#drawing && this.#key.childElementCount > 0) {
      this.#key.replaceChildren(...this.#keyEntries(this.#drawing));
    }
    this.#chart?.redraw(false);
  }

  /** Adapts to a new width of the column. */
  resize(): void {
    const { clientWidth, clientHeight } = this.#plot;
    if (this.#chart && clientWidth > 0 && clientWidth !== this.#chart.width) {
      this.#chart.setSize({ width: clientWidth, height: clientHeight });
      this.tick();
    }
  }

  /** Moves cursors and values to the clock's time. */
  tick(): void {
    if (!this.#visible || !this.#chart || !this.#drawing) {
      return;
    }
    const digits = digitsFor(...this.#drawing.y);
    for (const reading of readings(this.#drawing, this.#context.first, this.#context.clock.time)) {
      const cursor = this.#cursors.get(reading.side) ?? this.#cursors.get(null);
      if (cursor) {
        const [from, to] = this.#drawing.x;
        const width = this.#chart.width - ROOM.left - ROOM.right;
        cursor.hidden = reading.x === null;
        cursor.style.transform = `translateX(${((width * ((reading.x ?? from) - from)) / (to - from)).toFixed(1)}px)`;
      }
      const value = this.#values.get(keyOf(reading));
      const text = shown(reading.value, digits);
      if (value && value.textContent !== text) {
        value.textContent = text;
      }
    }
  }

  /** Makes the plot a vector picture for print. */
  prepareForPaper(): void {
    const picture = this.#drawing ? [vector(this.#drawing, this.#scheme(), PRINT)] : [];
    this.#paper.replaceChildren(...picture);
  }

  /** Draws the plot at the size of its host, unless it is drawn already. */
  draw(): void {
    const { clientWidth, clientHeight } = this.#plot;
    if (!this.#drawing || this.#chart || clientWidth === 0) {
      return;
    }
    this.#plot.replaceChildren();
    this.#chart = plot(this.#plot, this.#drawing, this.#scheme(), clientWidth, clientHeight);
    this.#addOverlay(this.#chart, this.#drawing);
    followPointer(this.#chart, this.#drawing, this.#context);
  }

  #addOverlay(chart: uPlot, now: Drawing): void {
    this.#cursors.clear();
    const sides = now.axis === "time" ? [null] : this.#context.display.sides;
    for (const side of sides) {
      this.#cursors.set(side, element("div", { class: `cursor ${side ?? "both"}`, hidden: "" }));
    }
    chart.over.append(...this.#cursors.values());
  }

  #scheme(): Scheme {
    return { sessions: this.#context.page.sessions.length, sides: this.#context.display.sides };
  }

  #head(): HTMLElement {
    const title = element("h4", {}, this.#words.title);
    if (this.#words.unit) {
      title.append(" ", element("span", { class: "unit" }, this.#words.unit));
    }
    const head = element("figcaption", {}, title);
    if (this.drawable) {
      const signs = element("span", { class: "signs" }, directionWords(this.#words));
      head.append(this.#menu(), element("div", { class: "caption-row" }, signs, this.#readout));
    }
    return head;
  }

  /** Updates the texts that depend on the drawing: values, source of the band, summary. */
  #fillWords(now: Drawing | null): void {
    this.#values.clear();
    this.#plot.hidden = now === null;
    this.#absent.hidden = now !== null;
    this.#fillSource(now);
    if (!now) {
      this.#readout.replaceChildren();
      this.#key.replaceChildren();
      return;
    }
    const read = readings(now, this.#context.first, this.#context.clock.time);
    for (const reading of read) {
      this.#values.set(keyOf(reading), element("span", { class: reading.side ?? "both" }, "–"));
    }
    const many = read.some((reading) => reading.variant > 0);
    this.#readout.replaceChildren(...(many ? [] : this.#values.values()));
    this.#key.replaceChildren(...(many ? this.#keyEntries(now) : []));
    this.#plot.setAttribute("aria-label", this.#summary(now));
  }

  /** Names and values where a side has several main lines. */
  #keyEntries(now: Drawing): HTMLElement[] {
    const main = now.lines.filter((line) => line.role === "main" && line.session === 0);
    return main.map((line) => {
      const look = lineLook(line, this.#scheme());
      return element("span", {}, lineSample(look.colour, look.dash), line.name, this.#values.get(keyOf(line)) ?? "");
    });
  }

  /** Short source of the grey band; the full source is below all panels. */
  #fillSource(now: Drawing | null): void {
    const band = this.#sources.find(({ panel }) => panel.band !== null)?.panel.band;
    const visible = band && now?.areas.some((area) => area.kind === "band");
    this.#source.textContent = visible ? this.#words.band : "";
    this.#source.title = visible ? band.citation : "";
  }

  #menu(): HTMLElement {
    const menu = element("details", { class: "menu" });
    const name = this.id;
    const sessions = this.#context.page.sessions.map((session) => session.name);
    const save = (kind: string, action: (now: Drawing) => void): HTMLElement =>
      button(`${this.#words.title} as ${kind}`, kind, () => {
        menu.open = false;
        if (this.#drawing) {
          action(this.#drawing);
        }
      });
    menu.append(
      element("summary", { "aria-label": `Save ${this.#words.title}`, title: "Save" }, "⋯"),
      element(
        "div",
        { class: "choices" },
        save("PNG", (now) => void savePng(name, now, this.#scheme(), this.#words, sessions)),
        save("SVG", (now) => saveSvg(name, now, this.#scheme(), this.#words, sessions)),
        save("CSV", (now) => saveCsv(name, now, this.#words, sessions)),
      ),
    );
    menu.addEventListener("focusout", (event) => {
      menu.open = menu.open && event.relatedTarget instanceof Node && menu.contains(event.relatedTarget);
    });
    return menu;
  }

  /** Text alternative of the plot, for screen readers. */
  #summary(now: Drawing): string {
    const { title, unit, positive, negative } = this.#words;
    const digits = digitsFor(...now.y);
    const over = now.axis === "cycle" ? "over the gait cycle" : "over time";
    const curves = now.lines
      .filter((line) => ["mean", "main", "predicted"].includes(line.role))
      .map((line) => `${line.name}: ${extremes(line.y, digits)}`);
    const red = now.shades.length > 0 ? [`${now.shades.length} parts are not feasible`] : [];
    const signs = positive ? [`positive is ${positive}${negative ? `, negative ${negative}` : ""}`] : [];
    const compared = this.#context.page.sessions.length > 1 ? [`${this.#sources.length} sessions`] : [];
    return [`${title}${unit ? ` in ${unit}` : ""} ${over}`, ...signs, ...compared, ...curves, ...red].join("; ");
  }
}

/** Key of a main line: side and number. */
function keyOf(line: { readonly side: PageSide | null; readonly variant: number }): string {
  return `${line.side}${line.variant}`;
}

/** How far activation and electromyogram agree; in a comparison with the session's name. */
function agreements(sources: readonly PanelSource[]): HTMLElement[] {
  return sources.flatMap(({ session, panel }) => {
    const words = panel.activity?.agreement;
    const name = sources.length > 1 ? `${session.name}: ` : "";
    return words ? [element("p", { class: "agreement" }, name + words)] : [];
  });
}

function extremes(values: Float64Array, digits: number): string {
  const finite = values.filter(Number.isFinite);
  const low = finite.reduce((a, b) => Math.min(a, b), Number.POSITIVE_INFINITY);
  const high = finite.reduce((a, b) => Math.max(a, b), Number.NEGATIVE_INFINITY);
  return finite.length > 0 ? `${shown(low, digits)} to ${shown(high, digits)}` : "no values";
}

function wordsOf(sources: readonly PanelSource[]): Words {
  const panel = sources[0]?.panel;
  const { title = "", unit = "", positive = "", negative = "" } = panel ?? {};
  const citation = sources.find((source) => source.panel.band !== null)?.panel.band?.citation;
  const band = citation === undefined ? "" : shortCitation(citation);
  return { title, unit: unit.replace("N.m", "N·m"), positive, negative, band };
}
