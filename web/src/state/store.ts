/** Hold the page's signals: the one place that components read and the socket writes. */
import { batch, computed, signal } from "@preact/signals";
import { decode } from "../wire/decode";
import type {
  Candidate,
  Frame,
  Goal,
  Grid,
  Objects,
  Place,
  ProposedRoom,
  Robot,
  Taught,
} from "../wire/types";
import { busy, sorted } from "./goals";
import { History } from "./history";
import { advance, ageOf, connected, EMPTY, type Model, withGoal } from "./model";
import { fresh, type Moment, moment } from "./moment";
import { steady } from "./steady";
import { listed } from "./things";
import { turning } from "./turning";

const TICK_MS = 200;
const EARLY_MS = 30; // frames come each 100 ms: the second one after a tick is the next, not the third

const model = signal<Model>(EMPTY);
/** Up to when the page speaks: ages are as of it, and so is `shown`. */
export const now = signal<Moment>(moment());
/** The robot as panels show it: at most five times a second, at once at a turning point. */
export const shown = signal<Robot | null>(null);
export const open = signal(false); // the socket is open
export const places = signal<readonly Place[]>([]);
export const taught = signal<readonly Taught[]>([]);
export const mostTaught = signal(0);
export const proposedRooms = signal<readonly ProposedRoom[]>([]);
export const grid = signal<Grid | null>(null);
/** A home is being mapped. */
export const isGrowing = computed(() => (grid.value?.growing ?? null) !== null);
export const history = new History();

/** The bridge's newest word, as it comes: to act upon and to draw. Panels read `shown`. */
export const status = computed(() => model.value.robot?.status ?? null);
/** What set-up says; null before anything was heard. */
export const setup = computed(() => model.value.robot?.setup ?? null);
export const shownStatus = computed(() => shown.value?.status ?? null);
/** The localizer is without a pose: since the start, or since it was carried. */
export const poseLost = computed(() => {
  const state = shown.value?.localizer;
  return state === "searching" || state === "lost" ? state : null;
});
/** Why the localizer is without a pose and what helps; null where it does not know. */
export const poseTrouble = steady(() =>
  poseLost.value === null ? null : (shown.value?.localizer_trouble ?? null),
);
/** The robot does not know where it is: the localizer says so, or the bridge, which then holds it. */
export const poseUnknown = computed(
  () => poseLost.value ?? (shownStatus.value?.rows.some(isPoseLost) ? "lost" : null),
);
const isPoseLost = ({ row }: { readonly row: string }): boolean =>
  row.split(".")[0] === "POSE_LOST";
/** Scans do not confirm the pose that is drawn: it goes by its wheels, or nobody knows. */
export const poseDoubtful = computed(() => {
  const state = shown.value?.localizer ?? null;
  return state !== null && state !== "tracking";
});
const NO_CANDIDATES: readonly Candidate[] = [];
/** Where it might be, best first, while it looks for its pose. */
export const candidates = steady(() =>
  poseLost.value === null ? NO_CANDIDATES : (shown.value?.match?.candidates ?? NO_CANDIDATES),
);
/** How well lidar and map agree, in steps that do not tremble; null where nobody compares. */
export const matchShare = computed(() => {
  const match = shown.value?.match ?? null;
  return match && Math.round(20 * Math.max(0, match.score)) / 20;
});
export const mind = steady(() => shown.value?.brain ?? null);
export const goals = computed(() => model.value.goals);
export const drafts = computed(() => model.value.drafts);
export const usage = computed(() => model.value.usage);
export const placesVersion = computed(() => model.value.placesVersion);
export const ordersVersion = computed(() => model.value.ordersVersion);
export const orderTold = computed(() => model.value.told);
export const sight = computed(() => model.value.sight);
export const sightAt = computed(() => model.value.sightAt);
export const blindAt = computed(() => model.value.blindAt);
/** The things that the robot remembers, each with when it was last spoken of. */
export const known = computed(() => model.value.things);
export const about = computed(() => model.value.about);
export const path = computed(() => model.value.path);
export const scan = computed(() => model.value.scan);
export const layers = computed(() => model.value.layers);
export const log = computed(() => model.value.log);
export const stopAnswer = computed(() => model.value.stopAnswer);
export const spoken = computed(() => model.value.spoken);
export const ignored = computed(() => model.value.ignored);
export const gaps = computed(() => model.value.gaps);
export const wantsSnapshot = computed(() => model.value.wantsSnapshot);
export const sortedGoals = computed(() => sorted(goals.value));
const sameItems = (kept: readonly Goal[], next: readonly Goal[]): boolean =>
  kept.length === next.length && kept.every((goal, index) => goal === next[index]);
export const currentGoals = steady(() => sortedGoals.value.current, sameItems);
export const queuedGoals = steady(() => sortedGoals.value.queued, sameItems);
export const pastGoals = steady(() => sortedGoals.value.past, sameItems);
export const isBusy = computed(() => busy(goals.value));

/** Return the age of a source as of the newest tick [s]. Changes at each: ask it of the old alone. */
export const age = (source: string): number | null => ageOf(model.peek(), source, now.value);

export const pageFresh = computed(() => fresh(age("page")));
export const bridgeFresh = computed(() => fresh(age("status")));
export const scanFresh = computed(() => fresh(age("scan")));
/** Say whether anything has been heard yet, of the planner and of the bridge. */
export const pageHeard = computed(() => age("page") !== null);
export const bridgeHeard = computed(() => age("status") !== null);

/** What a person need not see before the robot's next word: each alone would cost a frame of its own. */
const PATIENT: ReadonlySet<Frame["kind"]> = new Set(["scan", "progress", "obstacles"]);
let waiting: readonly Frame[] = [];

/** Take what came over the socket, in its order; what is patient is drawn with the next of the others. */
export function receive(data: unknown): void {
  const frame = decode(data);
  if (frame !== null && PATIENT.has(frame.kind)) waiting = [...waiting, frame];
  else take([...waiting, frame], moment());
}

function take(frames: readonly (Frame | null)[], at: Moment): void {
  waiting = [];
  batch(() => {
    model.value = frames.reduce((known, frame) => advance(known, frame, at), model.value);
    if (due(at) || turning(model.value.robot) !== turning(shown.value)) show(at);
  });
  const { robot: seen, about: body } = model.value;
  if (seen?.status && body && fresh(seen.ages_s.status ?? null)) {
    history.take(seen.status, body.base, at.monotonicMs / 1000);
  }
}

const due = (at: Moment): boolean => at.monotonicMs - now.peek().monotonicMs >= TICK_MS - EARLY_MS;

function show(at: Moment): void {
  batch(() => {
    now.value = at;
    shown.value = model.peek().robot;
  });
}

export function began(): void {
  waiting = []; // of the connection that is gone
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

/** Take the whole list of things. */
export function learnThings({ objects }: Objects): void {
  model.value = { ...model.value, things: listed(objects, moment()) };
}

/** Let time pass, so that what is old shows its age. */
export function startClock(): void {
  setInterval(() => {
    const at = moment();
    if (waiting.length > 0) take(waiting, at);
    else if (due(at)) show(at);
  }, TICK_MS);
}
