import type { Context } from "./context";
import type { Drawing } from "./drawing";
import type { PanelView } from "./panel";
import { onThemeChange } from "./style";

/** How far below the window panels are drawn in advance. */
const MARGIN = "400px 0px";

/** A panel out of sight is drawn after this time, even if the browser is never idle. */
const LONGEST_WAIT_MS = 100;

/** All panels of the page: draws those in sight, keeps them at the clock's time, the reader's choices and the theme. */
export class Panels {
  readonly #views: PanelView[] = [];
  readonly #byHost = new Map<Element, PanelView>();
  readonly #visible = new Set<PanelView>();
  readonly #sight: IntersectionObserver;
  readonly #size: ResizeObserver;

  constructor(context: Context) {
    this.#sight = new IntersectionObserver((entries) => this.#seen(entries), { rootMargin: MARGIN });
    this.#size = new ResizeObserver((entries) => {
      for (const entry of entries) {
        this.#byHost.get(entry.target)?.resize();
      }
    });
    context.clock.subscribe(() => this.#tick());
    context.display.subscribe(() => {
      this.#each((view) => view.update());
      this.#drawLater();
    });
    onThemeChange(() => this.#each((view) => view.recolour()));
  }

  add(view: PanelView): void {
    this.#views.push(view);
    if (view.drawable) {
      this.#byHost.set(view.host, view);
      this.#sight.observe(view.host);
      this.#size.observe(view.host);
    }
  }

  /** Draws what is in sight at once, without waiting for the observer, and the rest while the browser is idle. */
  start(): void {
    this.#each((view) => {
      view.visible = view.host.getBoundingClientRect().top < innerHeight;
    });
    this.#drawLater();
  }

  /** Draws what is not in sight while the browser is idle, one panel at a time. */
  #drawLater(): void {
    const waiting = [...this.#views];
    const next = (): void => {
      waiting.shift()?.draw();
      if (waiting.length > 0) {
        whenIdle(next);
      }
    };
    whenIdle(next);
  }

  /** Vector pictures of all panels, for paper. */
  prepareForPaper(): void {
    this.#each((view) => view.prepareForPaper());
  }

  /** Where the grey bands that are drawn now come from, each once. */
  citations(): string[] {
    return [...new Set(this.#views.flatMap(({ citation }) => (citation ? [citation] : [])))];
  }

  /** What is drawn, panel by panel. */
  drawings(): Record<string, Drawing | null> {
    return Object.fromEntries(this.#views.map((view) => [view.id, view.drawing]));
  }

  /** Brings a panel into sight and marks it for a moment. */
  show(id: string): void {
    const figure = this.#views.find((view) => view.id === id)?.figure;
    if (figure) {
      figure.scrollIntoView({ block: "center", behavior: "auto" });
      figure.classList.remove("found");
      requestAnimationFrame(() => figure.classList.add("found"));
    }
  }

  #seen(entries: readonly IntersectionObserverEntry[]): void {
    for (const entry of entries) {
      const view = this.#byHost.get(entry.target);
      if (view) {
        this.#visible[entry.isIntersecting ? "add" : "delete"](view);
        view.visible = entry.isIntersecting;
      }
    }
  }

  #tick(): void {
    for (const view of this.#visible) {
      view.tick();
    }
  }

  #each(action: (view: PanelView) => void): void {
    for (const view of this.#views) {
      action(view);
    }
  }
}

/** Not every browser tells when it is idle. */
function whenIdle(action: () => void): void {
  if (typeof requestIdleCallback === "function") {
    requestIdleCallback(action, { timeout: LONGEST_WAIT_MS });
  } else {
    setTimeout(action, 50);
  }
}
