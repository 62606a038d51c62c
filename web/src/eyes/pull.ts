/**
 * Decide when to ask for a picture: only for one that is not shown yet, one at a time, and at most
 * three a second. Knows neither picture nor screen.
 */
export const PERIOD_MS = 340;

/** Return how long to wait before the next picture may be asked for [ms]. */
export const waitMs = (askedMs: number, nowMs: number): number =>
  Math.max(0, askedMs + PERIOD_MS - nowMs);

export class Puller {
  private wanted: string | null = null;
  private had: string | null = null;
  private askedMs = Number.NEGATIVE_INFINITY;
  private busy = false;
  private wakes: ReturnType<typeof setTimeout> | undefined;

  constructor(
    private readonly ask: () => Promise<void>,
    private readonly clock: () => number = () => performance.now(),
  ) {}

  /** Have the picture of this name, as soon as may be; null: ask for nothing more. */
  want(name: string | null): void {
    this.wanted = name;
    if (name !== null) {
      this.plan();
      return;
    }
    this.had = null; // whoever looks again sees a new picture at once
    clearTimeout(this.wakes);
    this.wakes = undefined;
  }

  private plan(): void {
    const due = this.wanted !== null && this.wanted !== this.had;
    if (!due || this.busy || this.wakes !== undefined) return;
    this.wakes = setTimeout(() => void this.pull(), waitMs(this.askedMs, this.clock()));
  }

  private async pull(): Promise<void> {
    this.wakes = undefined;
    this.had = this.wanted;
    this.askedMs = this.clock();
    this.busy = true;
    try {
      await this.ask();
    } finally {
      this.busy = false;
      this.plan();
    }
  }
}
