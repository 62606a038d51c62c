/** Hold what a plan would do, as the planner tells it, until it is done or put away. */
import { computed, effect, signal } from "@preact/signals";
import { say, t, word } from "../i18n";
import { call } from "../net/api";
import { mayForesee } from "../state/asker";
import { explain, tell } from "../state/note";
import { currentGoals } from "../state/store";
import type { Bilingual, Goal } from "../wire/types";

export type RehearsedStep = {
  readonly index: number;
  readonly kind: string;
  readonly name: Bilingual | null;
  readonly does: "drives" | "stands" | "open" | "shut";
  readonly branch: boolean;
  readonly instead: boolean;
  readonly points: readonly (readonly [number, number])[];
  readonly length_m: number;
  readonly seconds: number;
  readonly narrowest_m: number | null;
  readonly suspect_m: number;
  readonly hoped: boolean;
  readonly message: Bilingual | null;
};

export type Rehearsal = {
  readonly steps: readonly RehearsedStep[];
  readonly length_m: number;
  readonly seconds: number;
  readonly narrowest_m: number | null;
  readonly is_whole: boolean;
};

/** What is shown, and of what: a goal that waits for a yes, or a sentence that nobody gave yet. */
export type Shown = { readonly of: { goal: string } | { text: string }; readonly plan: Rehearsal };

export const shown = signal<Shown | null>(null);

/** The goal that waits for a person's yes, and moves then. */
export const waiting = computed<Goal | null>(
  () =>
    currentGoals.value.find(
      ({ state, plan }) =>
        state === "awaiting_confirmation" ||
        (state === "needs_clarification" && (plan?.steps.length ?? 0) > 0),
    ) ?? null,
);

const waitsFor = computed(() => waiting.value?.id ?? null);
let asked = 0;

/** Show what a yes would do as soon as one is asked for; put it away with the question. */
export function startRehearsals(): void {
  effect(() => {
    const goal = mayForesee.value ? waitsFor.value : null;
    if (goal !== null) void rehearse({ goal }, true);
    else if (shown.peek() && "goal" in (shown.peek()?.of ?? {})) put(null);
  });
}

/** Ask the planner; quietly where nobody asked for it: a plan that can't be shown is still told. */
export async function rehearse(of: Shown["of"], quietly = false): Promise<void> {
  const mine = ++asked;
  try {
    const plan = (await call("POST", "v1/rehearsals", of)) as Rehearsal;
    if (mine === asked) shown.value = { of, plan };
  } catch (error) {
    if (mine === asked) shown.value = null;
    if (!quietly) tell(explain(error), true);
  }
}

export function put(next: Shown | null): void {
  asked += 1;
  shown.value = next;
}

/** Name a step of a plan that is shown: its place, or what it does. */
export function nameOf(step: Pick<RehearsedStep, "kind" | "name" | "branch">): string {
  const name = step.name ? say(step.name) : word("step", step.kind).replace("{what}", "").trim();
  return step.branch ? `${t("rehearsal.perhaps")} ${name}` : name;
}
