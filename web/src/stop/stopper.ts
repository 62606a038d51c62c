/**
 * Carry a stop to the planner over WebSocket and POST at once, and again until the bridge confirms.
 * Depends on no component: it works before the first view is drawn and after one has failed.
 */
import { effect, signal } from "@preact/signals";
import { authorization } from "../net/token";
import { bridgeFresh, status, stopAnswer } from "../state/store";
import { advance, IDLE, type StopEvent, type StopState } from "./machine";

const TICK_MS = 100;

export const stopState = signal<StopState>(IDLE);

type Send = (message: object) => boolean;
let overSocket: Send = () => false;
let breakOff: () => void = () => undefined;
let posting: AbortController | null = null;

/** Press Stop. Never throws, never waits. */
export function stop(): void {
  breakOff();
  take({ type: "pressed", held: freshHold() });
}

export function startStopper(send: Send, hush: () => void): void {
  overSocket = send;
  breakOff = hush;
  setInterval(() => take({ type: "tick" }), TICK_MS);
  effect(() => {
    if (stopAnswer.value) take({ type: "answered", confirmed: stopAnswer.value.confirmed });
  });
  effect(() => {
    if (bridgeFresh.value) take({ type: "held", held: status.value?.held?.id ?? null });
  });
}

function take(event: StopEvent): void {
  const step = advance(stopState.peek(), event, performance.now());
  stopState.value = step.state;
  if (step.send) {
    overSocket({ stop: true });
    void overPost();
  }
}

const freshHold = (): string | null =>
  bridgeFresh.peek() ? (status.peek()?.held?.id ?? null) : null;

async function overPost(): Promise<void> {
  posting?.abort(); // of those that hang, only the newest may keep a connection
  posting = new AbortController();
  try {
    const answer = await fetch("v1/stop", {
      method: "POST",
      headers: { "content-type": "application/json", ...authorization() },
      body: '{"source":"page"}',
      signal: posting.signal,
      keepalive: true,
    });
    const content = (await answer.json()) as { confirmed?: unknown };
    if (answer.ok) take({ type: "answered", confirmed: content.confirmed === true });
  } catch {
    // Not answered is what the state shows already; the next tick tries again.
  }
}
