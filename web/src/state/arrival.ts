/** Say how far it is to the end of a goal, and how long that takes: as it was rehearsed, else as it drives. */
import { computed, effect, signal } from "@preact/signals";
import { timeToGo } from "../map/outline";
import { call } from "../net/api";
import type { Rehearsal, RehearsedStep } from "../rehearse/rehearsal";
import type { Step } from "../wire/types";
import { mayForesee } from "./asker";
import { pace } from "./pointing";
import { goals } from "./store";

export type ToGo = {
  readonly left: number; // metres of the step that drives now
  readonly seconds: number | null; // to the end of all that is foreseen
  readonly stepsAfter: number; // which drive, too
};

type Foreseen = Pick<RehearsedStep, "index" | "length_m" | "seconds" | "instead">;

const runs = (step: Step): boolean => step.state === "running" && typeof step.left_m === "number";

/** Return what is left of a plan; null where nothing drives. A step that nobody foresaw has no time. */
export function toGoOf(
  steps: readonly Step[],
  foreseen: readonly Foreseen[],
  paceMps: number,
): ToGo | null {
  const at = steps.findIndex(runs);
  const left = steps[at]?.left_m ?? null;
  if (left === null) return null;
  const after = foreseen.filter(({ index, instead }) => index > at && !instead);
  const asRehearsed = foreseen.find(({ index }) => index === at);
  const speed =
    asRehearsed && asRehearsed.seconds > 0 ? asRehearsed.length_m / asRehearsed.seconds : paceMps;
  const now = timeToGo(left, speed);
  const later = after.reduce((sum, one) => sum + one.seconds, 0);
  const stepsAfter = after.filter(({ length_m }) => length_m > 0).length;
  return { left, seconds: now === null ? null : now + later, stepsAfter };
}

const running = computed(() => goals.value.find((goal) => goal.state === "running") ?? null);
const runningId = computed(() => running.value?.id ?? null);
const plan = signal<{ readonly goal: string; readonly steps: readonly Foreseen[] } | null>(null);

export const toGo = computed(() => {
  const goal = running.value;
  if (goal?.plan == null) return null;
  const steps = plan.value?.goal === goal.id ? plan.value.steps : [];
  return toGoOf(goal.plan.steps, steps, pace.value);
});

/** Have each goal foreseen once, as it sets off; return what ends it. */
export function startArrivals(): () => void {
  return effect(() => {
    const goal = runningId.value;
    if (goal !== null && mayForesee.value && plan.peek()?.goal !== goal) void foresee(goal);
  });
}

async function foresee(goal: string): Promise<void> {
  plan.value = { goal, steps: [] };
  try {
    const { steps } = (await call("POST", "v1/rehearsals", { goal })) as Rehearsal;
    if (plan.peek()?.goal === goal) plan.value = { goal, steps };
  } catch {
    // what can't be foreseen is told by its speed of late
  }
}
