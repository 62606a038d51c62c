/**
 * Say how long ago something was. The monotonic clock of some browsers sleeps with the machine and
 * the wall clock can be set, so the longer of the two counts: old data must never look fresh.
 */
export type Moment = { readonly monotonicMs: number; readonly wallMs: number };

export function moment(): Moment {
  return { monotonicMs: performance.now(), wallMs: Date.now() };
}

/** Return the seconds from one moment to another; never below zero. */
export function since(then: Moment, now: Moment): number {
  const ms = Math.max(now.monotonicMs - then.monotonicMs, now.wallMs - then.wallMs, 0);
  return ms / 1000;
}

/** Older than this is not now. With the clock's step of 0.2 s all old is grey within a second. */
export const STALE_S = 0.75;

/** Say whether an age may be shown as now. Written so that a missing or broken age may not. */
export function fresh(ageS: number | null): boolean {
  return ageS !== null && ageS <= STALE_S;
}
