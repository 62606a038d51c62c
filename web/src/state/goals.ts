/** Sort goals for the page: what runs, what waits for a person, what is queued, what has ended. */
import type { Goal, Progress, Step } from "../wire/types";

const ENDED = new Set(["succeeded", "failed", "refused", "cancelled"]);

export const ended = (goal: Goal): boolean => ENDED.has(goal.state);

/** Say whether a goal that went well has left a part of what was asked undone. */
export const onlyPartly = ({ state, outcome, plan }: Goal): boolean =>
  state === "succeeded" &&
  (outcome?.code === PARTLY ||
    (plan?.steps ?? []).some(
      ({ code, stops }) => code === PARTLY || stops?.some(({ shut }) => shut),
    ));

const PARTLY = "partly_explored";

export type Sorted = {
  readonly current: readonly Goal[]; // running first, then those that wait for a person
  readonly queued: readonly Goal[]; // next first
  readonly past: readonly Goal[]; // newest first
};

const RANK: { readonly [state: string]: number } = {
  running: 0,
  planning: 1,
  needs_clarification: 2,
  awaiting_confirmation: 2,
  paused: 3,
};

export function sorted(goals: readonly Goal[]): Sorted {
  const open = goals.filter((goal) => !ended(goal));
  return {
    current: open
      .filter((goal) => goal.state !== "queued")
      .sort((a, b) => (RANK[a.state] ?? 9) - (RANK[b.state] ?? 9)),
    queued: open
      .filter((goal) => goal.state === "queued")
      .sort((a, b) => (a.position ?? 99) - (b.position ?? 99)),
    past: goals.filter(ended),
  };
}

/** Say whether a new goal would have to wait. */
export function busy(goals: readonly Goal[]): boolean {
  return goals.some((goal) => ["running", "planning", "queued"].includes(goal.state));
}

type Left = Partial<Pick<Step, "left_m" | "left_rad" | "left_s">>;

/** Return what is left as a person reads it: to the decimetre, the degree and the second. */
const readable = ({ left_m, left_rad, left_s }: Left): string =>
  [
    [left_m, 10],
    [left_rad, 180 / Math.PI],
    [left_s, 1],
  ]
    .map(([left, fine]) => (typeof left === "number" ? Math.round(left * (fine ?? 1)) : ""))
    .join();

/** Put what is left of a step into its goal; the very same goals where it would read the same. */
export function withProgress(goals: readonly Goal[], progress: Progress): readonly Goal[] {
  const { goal: id, step: index, ...left } = progress;
  const plan = goals.find((goal) => goal.id === id)?.plan;
  const before = plan?.steps[index];
  if (!plan || !before || readable(before) === readable(left)) return goals;
  const steps = plan.steps.map((step, at) => (at === index ? { ...step, ...left } : step));
  return goals.map((goal) => (goal.id === id ? { ...goal, plan: { ...plan, steps } } : goal));
}
