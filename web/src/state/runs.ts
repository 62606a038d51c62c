/** Keep the newest runs of standing orders, and set those that no goal tells among what was said. */
import { computed, effect, signal } from "@preact/signals";
import { fetchRuns } from "../net/api";
import type { Goal, OrderRun } from "../wire/types";
import { goals, orderTold, ordersVersion, pastGoals } from "./store";

export const runs = signal<readonly OrderRun[]>([]);

export type Past = { readonly goal: Goal } | { readonly run: OrderRun };

/** Return goals and runs, the newest first; a run whose goal is known is told by that goal. */
export function withRuns(
  past: readonly Goal[],
  ran: readonly OrderRun[],
  known: readonly Goal[],
): readonly Past[] {
  const told = new Set(known.map((goal) => goal.id));
  const left = ran.filter(({ goal }) => goal === null || !told.has(goal));
  const all: Past[] = [];
  let next = 0;
  const tellRuns = (sinceMs: number): void => {
    for (let run = left[next]; run && Date.parse(run.at) >= sinceMs; run = left[next]) {
      all.push({ run });
      next += 1;
    }
  };
  for (const goal of past) {
    tellRuns(Date.parse(goal.created));
    all.push({ goal });
  }
  tellRuns(Number.NEGATIVE_INFINITY);
  return all;
}

export const pastWithRuns = computed(() => withRuns(pastGoals.value, runs.value, goals.value));

/** Load the runs whenever orders changed or one was told of; return what ends it. */
export function startRuns(): () => void {
  return effect(() => {
    if (ordersVersion.value + (orderTold.value?.id ?? 0) === 0) return; // nobody was heard yet
    void fetchRuns().then(
      (newest) => (runs.value = newest),
      () => undefined, // the next word of an order asks again
    );
  });
}
