/** Keep the last minute of wheel speeds and tick lateness for the plots. Knows no screen. */
import type { About, Status, Twist } from "../wire/types";

export const WINDOW_S = 60;

export type Wheels = { readonly left: number; readonly right: number };

/** Return the wheel speeds [rad/s] of a body speed: differential drive. */
export function wheels(twist: Twist, base: About["base"]): Wheels {
  const turn = (twist.w_radps * base.wheel_separation_m) / 2;
  return {
    left: (twist.v_mps - turn) / base.wheel_radius_m,
    right: (twist.v_mps + turn) / base.wheel_radius_m,
  };
}

export type Sample = {
  readonly atS: number;
  readonly asked: Wheels;
  readonly sent: Wheels;
  readonly measured: Wheels;
  readonly lateP50Ms: number;
  readonly lateMaxMs: number;
};

export class History {
  private kept: Sample[] = [];
  private newest: Status | null = null;

  /** Take a status unless it is the one taken last: a frozen bridge must draw no line. */
  take(status: Status, base: About["base"], atS: number): void {
    const same = this.newest?.boot === status.boot && this.newest.seq === status.seq;
    if (same) return;
    this.newest = status;
    this.kept.push({
      atS,
      asked: wheels(status.asked, base),
      sent: wheels(status.sent, base),
      measured: wheels(status.measured, base),
      lateP50Ms: status.ticks.late_p50_us / 1000,
      lateMaxMs: status.ticks.late_max_us / 1000,
    });
    const firstKept = this.kept.findIndex((sample) => sample.atS > atS - WINDOW_S);
    if (firstKept > 0) this.kept = this.kept.slice(firstKept);
  }

  get samples(): readonly Sample[] {
    return this.kept;
  }
}

/** Return one value per sample by seconds ago, with a hole where nothing came for a second. */
export function series(
  samples: readonly Sample[],
  nowS: number,
  values: readonly ((sample: Sample) => number)[],
): (number | null)[][] {
  const columns: (number | null)[][] = [[], ...values.map(() => [])];
  let beforeS: number | null = null;
  for (const sample of samples) {
    if (beforeS !== null && sample.atS - beforeS > 1) push(columns, beforeS + 0.01 - nowS, null);
    beforeS = sample.atS;
    push(
      columns,
      sample.atS - nowS,
      values.map((value) => value(sample)),
    );
  }
  return columns;
}

function push(columns: (number | null)[][], x: number, row: readonly number[] | null): void {
  columns.forEach((column, index) => {
    column.push(index === 0 ? x : (row?.[index - 1] ?? null));
  });
}
