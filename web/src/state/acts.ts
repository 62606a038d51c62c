/** Do what a person asks for, and tell how it went. Components call these and nothing below them. */
import { say, t } from "../i18n";
import {
  type Act,
  actOnGoal,
  answerGoal,
  changeOrder,
  forgetObject,
  forgetPlace,
  type GoalVerb,
  giveGoal,
  giveOrder,
  hintPose,
  moveGoal,
  type Names,
  operate,
  type Point,
  removeOrder,
  teachPlace,
} from "../net/api";
import { prove, proveGoal } from "../net/proof";
import type { Goal, Taught } from "../wire/types";
import { explain, tell } from "./note";
import { learn, sortedGoals, status } from "./store";

/** Run a request; tell its failure. Return whether it went well. */
export async function attempt(request: () => Promise<Goal | undefined>): Promise<boolean> {
  try {
    const goal = await request();
    if (goal) learn(goal);
    return true;
  } catch (error) {
    tell(explain(error), true);
    return false;
  }
}

export function give(text: string, replace = false): Promise<boolean> {
  return attempt(() => {
    remember(text);
    return giveGoal(text, replace, proveGoal(status.value));
  });
}

export function act(goal: Goal, verb: GoalVerb): Promise<boolean> {
  const asPerson = verb === "resume" || verb === "confirm";
  return attempt(() => actOnGoal(goal.id, verb, asPerson ? proveGoal(status.value) : null));
}

export function answer(goal: Goal, text: string): Promise<boolean> {
  return attempt(() => answerGoal(goal.id, text, proveGoal(status.value)));
}

/** Put a queued goal one place nearer to its turn, or farther from it. */
export function moveBy(goal: Goal, by: -1 | 1): Promise<boolean> {
  const { queued } = sortedGoals.value;
  const index = queued.findIndex((one) => one.id === goal.id);
  const before = queued[by < 0 ? index - 1 : index + 2];
  return attempt(() => moveGoal(goal.id, before?.id ?? null));
}

/** Do a queued goal in place of the running one. */
export async function doInstead(goal: Goal, running: Goal): Promise<boolean> {
  const next = sortedGoals.value.queued[0];
  if (next && next.id !== goal.id) {
    if (!(await attempt(() => moveGoal(goal.id, next.id)))) return false;
  }
  return act(running, "cancel");
}

export function teach(
  name: Names,
  point: Point | null,
  room: string | null = null,
): Promise<boolean> {
  return attempt(async () => {
    const place = await teachPlace(name, point, room);
    tell(t("places.kept", { name: say(place.name) }));
    return undefined;
  });
}

export function hint(where: { point: Point } | { place: string }): Promise<boolean> {
  return attempt(async () => {
    await hintPose(where);
    tell(t("here.accepted"));
    return undefined;
  });
}

export function forget(place: Taught): Promise<boolean> {
  return attempt(async () => {
    await forgetPlace(place.id);
    tell(t("places.gone", { name: say(place.name) }));
    return undefined;
  });
}

export function keepOrder(text: string): Promise<boolean> {
  return attempt(async () => {
    tell(say(await giveOrder(text)));
    return undefined;
  });
}

export function turnOrder(id: string, verb: "pause" | "resume" | "remove"): Promise<boolean> {
  return attempt(async () => {
    await (verb === "remove" ? removeOrder(id) : changeOrder(id, verb));
    return undefined;
  });
}

export function forgetThing(id: string, what: string): Promise<boolean> {
  return attempt(async () => {
    await forgetObject(id);
    tell(t("places.gone", { name: what }));
    return undefined;
  });
}

export function order(kind: Act): Promise<boolean> {
  return attempt(async () => {
    await operate(kind, prove(kind, status.value));
    tell(t("op.done", { what: t(`op.${kind}`) }));
    return undefined;
  });
}

const SLOT = "pons.said";
const MAX_SAID = 50;
const MAX_KEPT_CHARACTERS = 2000;

/** Return what was said on this browser before, newest first. */
export function said(): readonly string[] {
  try {
    const kept: unknown = JSON.parse(localStorage.getItem(SLOT) ?? "[]");
    return Array.isArray(kept) ? kept.filter((text) => typeof text === "string") : [];
  } catch {
    return [];
  }
}

function remember(text: string): void {
  const kept = text.slice(0, MAX_KEPT_CHARACTERS);
  const list = [kept, ...said().filter((known) => known !== kept)].slice(0, MAX_SAID);
  localStorage.setItem(SLOT, JSON.stringify(list));
}
