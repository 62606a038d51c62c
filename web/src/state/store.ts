/** Hold the page's signals: the one place that components read and the socket writes. */
import { batch, computed, signal } from "@preact/signals";
import { decode } from "../wire/decode";
import type { Goal, Grid, Place, Taught } from "../wire/types";
import { busy, sorted } from "./goals";
import { History } from "./history";
import { advance, ageOf, connected, EMPTY, type Model, withGoal } from "./model";
import { fresh, type Moment, moment } from "./moment";

const TICK_MS = 200;

const model = signal<Model>(EMPTY);
export const now = signal<Moment>(moment());
export const open = signal(false); // the socket is open
export const places = signal<readonly Place[]>([]);
export const taught = signal<readonly Taught[]>([]);
export const mostTaught = signal(0);
export const grid = signal<Grid | null>(null);
export const history = new History();

export const robot = computed(() => model.value.robot);
export const mind = computed(() => model.value.robot?.brain ?? null);
export const status = computed(() => model.value.robot?.status ?? null);
export const goals = computed(() => model.value.goals);
export const drafts = computed(() => model.value.drafts);
export const usage = computed(() => model.value.usage);
export const placesVersion = computed(() => model.value.placesVersion);
export const about = computed(() => model.value.about);
export const path = computed(() => model.value.path);
export const scan = computed(() => model.value.scan);
export const log = computed(() => model.value.log);
export const stopAnswer = computed(() => model.value.stopAnswer);
export const ignored = computed(() => model.value.ignored);
export const gaps = computed(() => model.value.gaps);
export const wantsSnapshot = computed(() => model.value.wantsSnapshot);
export const sortedGoals = computed(() => sorted(goals.value));
export const isBusy = computed(() => busy(goals.value));

/** Return the age of a source as of the newest tick [s]. */
export const age = (source: string): number | null => ageOf(model.value, source, now.value);

export const pageFresh = computed(() => fresh(ageOf(model.value, "page", now.value)));
export const bridgeFresh = computed(() => fresh(ageOf(model.value, "status", now.value)));

/** Take what came over the socket. */
export function receive(data: unknown): void {
  const at = moment();
  batch(() => {
    model.value = advance(model.value, decode(data), at);
    if (at.monotonicMs - now.value.monotonicMs >= TICK_MS) now.value = at;
  });
  const { robot: seen, about: body } = model.value;
  if (seen?.status && body && fresh(seen.ages_s.status ?? null)) {
    history.take(seen.status, body.base, at.monotonicMs / 1000);
  }
}

export function began(): void {
  batch(() => {
    model.value = connected(model.value);
    open.value = true;
  });
}

/** Take a goal that a request returned, so that the page need not wait for the event. */
export function learn(goal: Goal): void {
  const known = model.value.goals.find((one) => one.id === goal.id);
  if (known && known.updated > goal.updated) return;
  model.value = { ...model.value, goals: withGoal(model.value.goals, goal) };
}

/** Let time pass, so that what is old shows its age. */
export function startClock(): void {
  setInterval(() => {
    now.value = moment();
  }, TICK_MS);
}
