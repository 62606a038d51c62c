/**
 * Carry a stop of all robots to the fleet, again until the fleet answers; who has confirmed is the
 * fleet's word, which repeats the stop to each robot until it does. Depends on no component.
 */
import { signal } from "@preact/signals";
import { authorization } from "../net/token";
import type { Told } from "./decode";

export const AGAIN_MS = 500;
export const DOUBT_MS = 3000; // the fleet itself waits 2 s for robots before it answers
export const GIVE_UP_MS = 15_000; // then the person must act; the red stays

export type Phase = "idle" | "asking" | "doubtful" | "failed";

/** Where the newest press stands; once the fleet has answered, `stopTold` says who confirmed. */
export const phase = signal<Phase>("idle");
export const stopTold = signal<Told | null>(null);

/** The stop that was there when the page came, or before the newest that the fleet could not write down. */
let known: string | null | undefined;
let pressedMs: number | null = null;
let timer: ReturnType<typeof setTimeout> | undefined;

/** Return what to show of a stop: the fleet's newest, where it is news or not confirmed by all. */
export function chosen(
  told: Told | null,
  shown: Told | null,
  seen: string | null | undefined,
): Told | null {
  if (told === null) return shown;
  if (shown?.id === "" && told.id === seen) return shown; // an older one says nothing of it
  if (shown?.id === told.id) return told;
  return told.id !== seen || told.not_reached.length > 0 ? told : shown;
}

/** Take the newest stop that the fleet tells of; another person may have pressed. */
export function heard(told: Told | null): void {
  if (known === undefined) known = told?.id ?? null;
  stopTold.value = chosen(told, stopTold.peek(), known);
  if (stopTold.peek()?.id !== "") known = stopTold.peek()?.id ?? known;
}

/** Press Stop. Never throws, never waits; pressed again it sends again, and doubt keeps its age. */
export function stopAll(): void {
  pressedMs ??= performance.now();
  if (phase.peek() !== "doubtful") phase.value = phase.peek() === "failed" ? "doubtful" : "asking";
  clearTimeout(timer);
  timer = setTimeout(tick, AGAIN_MS);
  void post();
}

let posting: AbortController | null = null;
let sentMs = 0;

async function post(): Promise<void> {
  posting?.abort(); // of those that hang, only the newest may keep a connection
  const mine = (posting = new AbortController());
  sentMs = performance.now();
  try {
    const answer = await fetch("v1/stop", {
      method: "POST",
      headers: { "content-type": "application/json", ...authorization() },
      body: "{}",
      signal: mine.signal,
      keepalive: true,
    });
    const told = (await answer.json()) as Told;
    if (answer.ok && posting === mine) done(told);
  } catch {
    // Not answered is what the state shows already; the next tick tries again.
  }
  if (posting === mine) posting = null;
}

function done(told: Told): void {
  clearTimeout(timer);
  pressedMs = null;
  phase.value = "idle";
  stopTold.value = told;
}

function tick(): void {
  if (pressedMs === null) return;
  const age = performance.now() - pressedMs;
  if (age >= GIVE_UP_MS) {
    pressedMs = null;
    phase.value = "failed";
    return;
  }
  if (age >= DOUBT_MS) phase.value = "doubtful";
  // One that is under way is let answer; it is given up for another when it hangs.
  if (posting === null || performance.now() - sentMs >= DOUBT_MS) void post();
  timer = setTimeout(tick, AGAIN_MS);
}
