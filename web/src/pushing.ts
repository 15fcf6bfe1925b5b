// A walker who can be pushed while he walks: every ball makes the command simulate the whole walk anew, which is the same until the ball arrives.

import { Stage } from "./stage";
import { aimed, type Ball, DURATION_S, momentumOf, type Run, readRun, sceneOf } from "./walker";
import type { Files } from "./wasi";

/** A ball arrives so long after it was thrown [s]. */
const FLIGHT_S = 0.5;

/** The parts of the page. */
export interface Controls {
  picture: HTMLElement;
  note: HTMLElement;
  time: HTMLElement;
  play: HTMLButtonElement;
  again: HTMLButtonElement;
  alone: HTMLButtonElement;
  behind: HTMLButtonElement;
  front: HTMLButtonElement;
  faster: HTMLInputElement;
  fasterText: HTMLElement;
}

export class Pushing {
  private readonly stage: Stage;
  private balls: Ball[] = [];
  private run: Run | undefined;
  private busy = false;

  /** `simulate` runs a scene; none if the visitor stopped it or it failed. */
  constructor(
    private readonly controls: Controls,
    private readonly simulate: (scene: string) => Promise<Files | undefined>,
  ) {
    this.stage = new Stage(
      controls.picture,
      (faster) => this.throw(faster),
      () => this.refresh(),
    );
    const faster = (): number => controls.faster.valueAsNumber;
    controls.behind.addEventListener("click", () => this.throw(faster()));
    controls.front.addEventListener("click", () => this.throw(-faster()));
    controls.alone.addEventListener("click", () => this.start());
    controls.again.addEventListener("click", () => this.stage.play(true));
    controls.play.addEventListener("click", () => (this.stage.isPlaying ? this.stage.pause() : this.stage.play()));
    controls.faster.addEventListener("input", () => this.label());
    this.label();
  }

  /** The scene as it is. */
  get scene(): string {
    return sceneOf(this.balls);
  }

  /** Lets the walker walk without balls. */
  async start(): Promise<void> {
    if (await this.compute([])) {
      this.stage.play(true);
    }
  }

  private async throw(faster: number): Promise<void> {
    const time = this.stage.now + FLIGHT_S;
    if (!this.run || this.busy) {
      return;
    }
    const ball = time < (this.run.times.at(-1) ?? 0) && !this.run.fall ? aimed(this.run, time, faster) : undefined;
    if (!ball) {
      this.say("The walk is over. Play it from the start, or begin a walk without balls.");
      return;
    }
    this.stage.waitAt(time);
    await this.compute([...this.balls, ball]);
  }

  private async compute(balls: Ball[]): Promise<boolean> {
    if (this.busy) {
      return false;
    }
    this.busy = true;
    this.say(balls.length === 0 ? "The walk is computed ..." : "The ball is on its way: the walk is computed ...");
    this.refresh();
    const files = await this.simulate(sceneOf(balls));
    this.busy = false;
    if (files) {
      this.balls = balls;
      this.run = readRun(files);
    }
    if (this.run) {
      // Without new results, the walk before is known to its end again.
      this.stage.show(this.run);
      this.say(outcome(this.run, this.balls.length));
    }
    this.refresh();
    return files !== undefined;
  }

  private say(text: string): void {
    this.controls.note.textContent = text;
  }

  private label(): void {
    const { faster, fasterText } = this.controls;
    const text = `${faster.valueAsNumber.toFixed(1)} m/s`;
    fasterText.textContent = text;
    faster.setAttribute("aria-valuetext", text);
  }

  private refresh(): void {
    const { controls, stage } = this;
    for (const button of [controls.behind, controls.front, controls.alone]) {
      button.disabled = this.busy || !this.run;
    }
    controls.play.textContent = stage.isPlaying ? "Pause" : "Play";
    controls.time.textContent = `${stage.now.toFixed(1)} s of ${(this.run?.times.at(-1) ?? DURATION_S).toFixed(1)} s`;
  }
}

/** Events of a walk. */
function outcome(run: Run, balls: number): string {
  const momentum = momentumOf(run);
  const given = `${Math.abs(momentum).toFixed(0)} N.s ${momentum < 0 ? "backwards" : "forwards"}`;
  const thrown = `${balls} ball${balls === 1 ? "" : "s"}, together ${given}.`;
  const ends = run.fall ? `${run.fall}.` : "The walker does not fall.";
  return balls === 0 ? ends : `${thrown} ${ends}`;
}
