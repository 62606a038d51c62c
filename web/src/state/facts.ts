/** Gather what the one word of the state is made of, and whom its next act concerns. */
import { computed } from "@preact/signals";
import type { Goal } from "../wire/types";
import { type Facts, headline } from "./headline";
import { steady } from "./steady";
import {
  bridgeFresh,
  bridgeHeard,
  currentGoals,
  open,
  pageFresh,
  pageHeard,
  poseUnknown,
  shownStatus,
} from "./store";
import { inSetup } from "./trial";

const ASKS: ReadonlySet<string> = new Set(["needs_clarification", "awaiting_confirmation"]);
/** What the bridge says of a row that lets the robot drive on. */
const MILD: ReadonlySet<string> = new Set(["NONE", "CAP"]);
const UNRECORDED: ReadonlySet<string> = new Set(["recorder_down", "disk_full"]);

export const asks = (goal: Goal): boolean => ASKS.has(goal.state);

const newestFirst = (goals: readonly Goal[]): readonly Goal[] =>
  [...goals].sort((a, b) => (a.updated < b.updated ? 1 : -1));

/** The goals that wait for a person's word, the newest question first. */
export const asking = computed(() => newestFirst(currentGoals.value.filter(asks)));

/** The goal that goes on where a person lets a held robot go on; null: none, or nothing holds it. */
export const heldGoal = computed(() => {
  if ((shownStatus.value?.held ?? null) === null) return null;
  return newestFirst(currentGoals.value.filter(({ state }) => state === "paused"))[0] ?? null;
});

function link(): Facts["link"] {
  if (!pageHeard.value) return "connecting";
  if (!open.value || !pageFresh.value) return "lost";
  if (!bridgeHeard.value) return "unheard";
  return bridgeFresh.value ? "live" : "silent";
}

function goals(): Facts["goals"] {
  const states = new Set(currentGoals.value.map(({ state }) => state));
  if (states.has("running")) return "running";
  if (states.has("planning")) return "thinking";
  return states.has("paused") ? "paused" : "none";
}

/** The bridge finds the battery low, whether it drives on or not. */
export const isLow = computed(
  () => shownStatus.value?.rows.some(({ row }) => row === "BATTERY") ?? false,
);

export const linkNow = computed(link);

export const headlineNow = steady(() => {
  const said = shownStatus.value;
  const rows = said?.rows.filter(({ binding }) => binding) ?? [];
  return headline({
    link: linkNow.value,
    setup: inSetup.value,
    mode: said?.mode ?? "none",
    held: said?.held?.reason ?? null,
    pose: poseUnknown.value,
    barred:
      rows.some(({ action }) => !MILD.has(action)) ||
      (said?.waiting_for.some((code) => !UNRECORDED.has(code)) ?? false),
    blocked: said?.blocked ?? false,
    low: isLow.value,
    asks: asking.value.length > 0,
    goals: goals(),
  });
});
