import type { TimeAxis } from "./contract";

/** Longest real time between two pictures that playback follows [s]: if the browser pauses for longer, playback resumes at the same time. */
const LONGEST_FRAME_S = 0.25;

/** The time that the whole page shows [s], on the first session's time axis. Playback loops over the recording. */
export class Clock {
  readonly start: number;
  readonly end: number;
  readonly step: number;
  #time: number;
  #playing = false;
  #speed = 1;
  #wall: number | null = null;
  #asked = false;
  readonly #listeners = new Set<(clock: Clock) => void>();

  constructor(axis: TimeAxis) {
    this.start = axis.start_s;
    this.step = axis.step_s;
    this.end = axis.start_s + axis.step_s * Math.max(axis.frames - 1, 0);
    this.#time = this.start;
  }

  get time(): number {
    return this.#time;
  }

  get playing(): boolean {
    return this.#playing;
  }

  /** Seconds of motion per second of real time. */
  get speed(): number {
    return this.#speed;
  }

  set speed(speed: number) {
    this.#speed = speed;
    this.#tell();
  }

  play(): void {
    if (this.#playing || this.end <= this.start) {
      return;
    }
    this.#playing = true;
    this.#wall = null;
    this.#ask();
    this.#tell();
  }

  pause(): void {
    this.#playing = false;
    this.#tell();
  }

  toggle(): void {
    if (this.#playing) {
      this.pause();
    } else {
      this.play();
    }
  }

  /** Sets the time, limited to the recording. */
  seek(time: number): void {
    if (Number.isFinite(time)) {
      this.#time = Math.min(Math.max(time, this.start), this.end);
      this.#tell();
    }
  }

  /** Moves by a number of frames of the recording and pauses there. */
  nudge(frames: number): void {
    this.#playing = false;
    const frame = Math.round((this.#time - this.start) / this.step) + frames;
    this.seek(this.start + frame * this.step);
  }

  /** Calls the listener at every change; the returned function removes it. */
  subscribe(listener: (clock: Clock) => void): () => void {
    this.#listeners.add(listener);
    return () => this.#listeners.delete(listener);
  }

  /** Requests the next picture only once, even if playback starts and stops several times before it. */
  #ask(): void {
    if (!this.#asked) {
      this.#asked = true;
      requestAnimationFrame(this.#tick);
    }
  }

  readonly #tick = (now: number): void => {
    this.#asked = false;
    if (!this.#playing) {
      return;
    }
    const elapsed = this.#wall === null ? 0 : Math.min((now - this.#wall) / 1000, LONGEST_FRAME_S);
    this.#wall = now;
    const time = this.#time + elapsed * this.#speed;
    this.seek(time > this.end ? this.start : time);
    this.#ask();
  };

  #tell(): void {
    for (const listener of this.#listeners) {
      listener(this);
    }
  }
}
