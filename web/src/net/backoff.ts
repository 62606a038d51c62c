/** Say how long to wait before the next try. Pure. */

export const FIRST_MS = 250;
export const LONGEST_MS = 4000;

/** Return the wait before try number n (from 0) [ms]; `chance` in 0…1 keeps many pages apart. */
export function waitMs(tries: number, chance: number): number {
  const full = Math.min(LONGEST_MS, FIRST_MS * 2 ** Math.min(tries, 10));
  return full * (0.75 + 0.25 * chance);
}
