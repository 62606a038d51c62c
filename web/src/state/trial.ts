/**
 * Watch a trial that this page began: while wheels may turn it says three times a second that a person
 * is here, and how far the questions are answered. What falls silent for 1.5 s ends the trial, so a page
 * that is hidden says nothing on purpose.
 */
import { computed, effect, signal } from "@preact/signals";
import { t } from "../i18n";
import { askTrial, enterSetup, newId } from "../net/api";
import { markOf, prove } from "../net/proof";
import type { Trial } from "../wire/types";
import { explain, tell } from "./note";
import { setup, status } from "./store";
import { steady } from "./steady";

const WATCH_MS = 300;
const MOST_WAITING = 2; // a browser has few connections, and Stop needs one

/** The trial as set-up tells it; null while a bridge drives. */
export const trial = computed<Trial | null>(() => setup.value?.trial ?? null);
export const inSetup = steady(() => trial.value !== null);
/** Wheels may turn now. */
export const isTrying = computed(() => trial.value?.phase === "trying");
/** The begin of this page; null where it has begun none. */
export const mine = signal<string | null>(null);
export const isMine = computed(() => mine.value !== null && trial.value?.by === markOf(mine.value));
export const busy = signal(false);

let answered = 0;
let waiting = 0;
let timer: ReturnType<typeof setInterval> | undefined;

function watch(): void {
  if (mine.value === null || document.hidden) return;
  if (waiting >= MOST_WAITING) return;
  waiting += 1;
  void askTrial("watch", mine.value, answered)
    .catch(() => undefined) // its silence is what counts
    .finally(() => (waiting -= 1));
}

/** Say that what was asked is done. */
export function answer(question: number): void {
  answered = question;
  watch();
}

async function attempt(request: () => Promise<void>): Promise<void> {
  if (busy.value) return;
  busy.value = true;
  try {
    await request();
  } catch (error) {
    tell(explain(error), true);
  } finally {
    busy.value = false;
  }
}

/** Begin, with the operator's proof; from then on this page watches. */
export function begin(): Promise<void> {
  return attempt(async () => {
    const proved = prove("trial", status.peek());
    if (proved === null) return;
    answered = 0;
    mine.value = proved.id;
    clearInterval(timer);
    timer = setInterval(watch, WATCH_MS);
    void keepAwake();
    await askTrial("begin", proved.id, 0, proved.proof);
  });
}

export const find = (): Promise<void> => attempt(() => askTrial("find", newId("page"), 0));
export const leave = (): Promise<void> => attempt(() => askTrial("leave", newId("page"), 0));
export const enter = (): Promise<void> =>
  attempt(async () => {
    await enterSetup();
    tell(t("setup.entering"));
  });

effect(() => {
  if (trial.value === null || (isMine.value && !isTrying.value)) clearInterval(timer);
});

/** Keep a phone's screen on: where it goes dark, nobody watches. */
async function keepAwake(): Promise<void> {
  await navigator.wakeLock?.request("screen").catch(() => undefined);
}
