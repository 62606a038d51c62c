/** Hold what the fleet told last, and ask again each second while somebody looks. */
import { batch, computed, effect, signal } from "@preact/signals";
import { ApiError, call, newId } from "../net/api";
import { waitMs } from "../net/backoff";
import { explain, tell } from "../state/note";
import { visible } from "../state/visible";
import {
  feed,
  type FleetGrid,
  type Mission,
  missions as decoded,
  type Robot,
  type Told,
} from "./decode";
import { heard, stopTold } from "./stopAll";

const EACH_MS = 1000;
const SILENT_AFTER = 3; // answers missed
const MOST_MISSIONS = 200;
const ENDED = new Set(["succeeded", "failed", "refused", "cancelled", "given_up"]);

export const robots = signal<readonly Robot[] | null>(null);
export const missions = signal<ReadonlyMap<string, Mission>>(new Map());
export const isViewer = signal(true);
export const missed = signal(0);
export const heardMs = signal(0);
export const maps = signal<ReadonlyMap<string, FleetGrid>>(new Map());

/** How the page hears: what is shown of a silent service is old. */
export const link = computed(() => {
  if (robots.value === null) return missed.value < SILENT_AFTER ? "connecting" : "bad";
  return missed.value < SILENT_AFTER ? "good" : "bad";
});

export const isOver = ({ state }: Mission): boolean => ENDED.has(state);

/** Return missions by what they want of a person: those that are open first, then the newest. */
export function sorted(all: Iterable<Mission>): { open: Mission[]; past: Mission[] } {
  const newest = [...all].sort((one, other) => other.atUnixS - one.atUnixS);
  return { open: newest.filter((one) => !isOver(one)), past: newest.filter(isOver) };
}

export const shown = computed(() => sorted(missions.value.values()));
export const asking = computed(() =>
  shown.value.open.filter((one) => one.state === "asking" && one.question !== null),
);

let cursor: number | null = null;

/** Take missions that changed; of the oldest that are over, the page lets go. */
export function learn(changed: readonly Mission[]): void {
  if (changed.length === 0) return;
  const all = new Map(missions.peek());
  for (const one of changed) all.set(one.id, one);
  const { open, past } = sorted(all.values());
  const kept = [...open, ...past.slice(0, MOST_MISSIONS)];
  missions.value = new Map(kept.map((one) => [one.id, one]));
}

async function ask(): Promise<void> {
  const told = feed(await call("GET", cursor === null ? "v1/page" : `v1/page?after=${cursor}`));
  batch(() => {
    robots.value = told.robots;
    isViewer.value = told.you !== "operator";
    learn(told.missions);
    heard(told.stop);
    cursor = told.next;
    missed.value = 0;
    heardMs.value = Date.now();
  });
  await fetchMaps(told.robots);
}

const wanted = new Set<string>();

/** Fetch the maps that robots show and the page has not; what fails is tried at the next turn. */
async function fetchMaps(all: readonly Robot[]): Promise<void> {
  const named = new Set(all.map((robot) => robot.map).filter((name) => name !== null));
  for (const digest of named) {
    if (maps.peek().has(digest) || wanted.has(digest)) continue;
    wanted.add(digest);
    const found = await call("GET", `v1/maps/${encodeURIComponent(digest)}`).catch(() => null);
    wanted.delete(digest);
    if (found !== null) maps.value = new Map(maps.peek()).set(digest, found as FleetGrid);
  }
  if ([...maps.peek().keys()].every((digest) => named.has(digest))) return;
  maps.value = new Map([...maps.peek()].filter(([digest]) => named.has(digest)));
}

let timer: ReturnType<typeof setTimeout> | undefined;
let running = false;

/** Ask now, and each second from then on. */
export async function askNow(): Promise<void> {
  clearTimeout(timer);
  if (running) return;
  running = true;
  try {
    await ask();
  } catch (error) {
    missed.value += 1;
    if (error instanceof ApiError && error.code === "token_needed") cursor = null;
  } finally {
    running = false;
  }
  const wait = missed.peek() === 0 ? EACH_MS : waitMs(missed.peek(), Math.random());
  if (visible.peek()) timer = setTimeout(() => void askNow(), wait);
}

/** Begin; while nobody can see the page it asks nothing. */
export function startFleet(): void {
  effect(() => {
    if (visible.value) void askNow();
    else clearTimeout(timer);
  });
}

/** Run a request; tell its failure. Return whether it went well. */
async function attempt(request: () => Promise<void>): Promise<boolean> {
  try {
    await request();
    void askNow();
    return true;
  } catch (error) {
    tell(explain(error), true);
    return false;
  }
}

let given = { text: "", key: "" };

/** Give an order to the house; the same text after a failure is the same order. */
export function order(text: string): Promise<boolean> {
  return attempt(async () => {
    if (given.text !== text) given = { text, key: newId("fleet-page") };
    const headers = { "idempotency-key": given.key };
    const told = (await call("POST", "v1/missions", { text }, headers)) as {
      missions: unknown;
      stop: Told | null;
    };
    given = { text: "", key: "" };
    learn(decoded(told.missions));
    if (told.stop) stopTold.value = told.stop;
  });
}

const path = (one: Mission, verb: string): string =>
  `v1/missions/${encodeURIComponent(one.id)}/${verb}`;

export function answer(one: Mission, text: string): Promise<boolean> {
  return attempt(async () => {
    learn(decoded([await call("POST", path(one, "answer"), { text })]));
  });
}

/** End a mission; `giveUp` where its robot is silent. */
export function end(one: Mission, giveUp: boolean): Promise<boolean> {
  return attempt(async () => {
    learn(decoded([await call("POST", path(one, "cancel"), { give_up: giveUp })]));
  });
}

export function stopOne(name: string): Promise<boolean> {
  return attempt(async () => {
    stopTold.value = (await call("POST", "v1/stop", { robots: [name] })) as Told;
  });
}
