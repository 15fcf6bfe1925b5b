import type { Context } from "./context";
import type { Drawing } from "./drawing";
import type { PanelView } from "./panel";
import { onThemeChange } from "./style";

/** Distance below the window within which panels are drawn in advance. */
const MARGIN = "400px 0px";

/** A panel out of sight is drawn after this time even if the browser is never idle. */
const LONGEST_WAIT_MS = 100;

/** All panels of the page: draws the visible ones and keeps them in step with the clock, the reader's choices and the theme. */
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

  /** Draws visible panels at once, without waiting for the observer, and the others while the browser is idle. */
  start(): void {
    this.#each((view) => {
      view.visible = view.host.getBoundingClientRect().top < innerHeight;
    });
    this.#drawLater();
  }

  /** Draws panels out of sight one at a time while the browser is idle. */
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

  /** Makes vector pictures of all panels, for print. */
  prepareForPaper(): void {
    this.#each((view) => view.prepareForPaper());
  }

  /** Sources of the grey bands that are drawn now, each once. */
  citations(): string[] {
    return [...new Set(this.#views.flatMap(({ citation }) => (citation ? [citation] : [])))];
  }

  /** Current drawings by panel. */
  drawings(): Record<string, Drawing | null> {
    return Object.fromEntries(this.#views.map((view) => [view.id, view.drawing]));
  }

  /** Scrolls to a panel and highlights it for a moment. */
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

/** Runs when the browser is idle; not every browser reports that. */
function whenIdle(action: () => void): void {
  if (typeof requestIdleCallback === "function") {
    requestIdleCallback(action, { timeout: LONGEST_WAIT_MS });
  } else {
    setTimeout(action, 50);
  }
}
