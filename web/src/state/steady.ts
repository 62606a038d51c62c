/**
 * Keep a computed value while nobody could see that it changed: who depends on it then rests, and
 * what rests is not drawn again.
 */
import { computed, type ReadonlySignal } from "@preact/signals";

export type Same<T> = (kept: T, next: T) => boolean;

/** Say whether two values of plain data read the same. */
export const alike = (kept: unknown, next: unknown): boolean =>
  Object.is(kept, next) || JSON.stringify(kept) === JSON.stringify(next);

/** Compute a value anew, and keep the one before wherever `same` says so. */
export function steady<T>(compute: () => T, same: Same<T> = alike): ReadonlySignal<T> {
  let kept: { readonly value: T } | null = null;
  return computed(() => {
    const next = compute();
    if (kept === null || !same(kept.value, next)) kept = { value: next };
    return kept.value;
  });
}
