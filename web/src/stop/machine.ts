/**
 * Decide what Stop says and sends. Pure. Only the bridge's own word makes "confirmed": its echo as
 * the planner relays it, or a hold in its status that was not there when Stop was pressed.
 */
export const SHOW_DOUBT_MS = 1000; // without the bridge's word for so long, say so in red
export const REPEAT_MS = 500;
export const GIVE_UP_MS = 10_000; // then the person must act; the red stays

export type StopState =
  | { readonly phase: "idle" }
  | {
      readonly phase: "asking";
      readonly sinceMs: number;
      readonly sentMs: number;
      readonly heldBefore: string | null;
      readonly doubtful: boolean;
    }
  | { readonly phase: "confirmed"; readonly tookMs: number; readonly held: boolean }
  | { readonly phase: "unconfirmed"; readonly heldBefore: string | null; readonly sinceMs: number };

export const IDLE: StopState = { phase: "idle" };

export type StopEvent =
  | { readonly type: "pressed"; readonly held: string | null }
  | { readonly type: "answered"; readonly confirmed: boolean }
  | { readonly type: "held"; readonly held: string | null } // from a fresh status
  | { readonly type: "tick" };

export type StopStep = { readonly state: StopState; readonly send: boolean };

export function advance(state: StopState, event: StopEvent, nowMs: number): StopStep {
  switch (event.type) {
    case "pressed":
      return pressed(state, event.held, nowMs);
    case "answered":
      return { state: event.confirmed ? confirmed(state, nowMs) : state, send: false };
    case "held":
      return { state: seen(state, event.held, nowMs), send: false };
    case "tick":
      return waited(state, nowMs);
  }
}

function pressed(state: StopState, held: string | null, nowMs: number): StopStep {
  // Pressed again while asking: send again, but the doubt keeps the age of the first press.
  const first = state.phase === "asking" ? state : null;
  return {
    state: {
      phase: "asking",
      sinceMs: first?.sinceMs ?? nowMs,
      sentMs: nowMs,
      heldBefore: first ? first.heldBefore : held,
      doubtful: first?.doubtful ?? state.phase === "unconfirmed",
    },
    send: true,
  };
}

function confirmed(state: StopState, nowMs: number): StopState {
  if (state.phase !== "asking" && state.phase !== "unconfirmed") return state;
  return { phase: "confirmed", tookMs: nowMs - state.sinceMs, held: false };
}

function seen(state: StopState, held: string | null, nowMs: number): StopState {
  if (state.phase === "asking" || state.phase === "unconfirmed") {
    const ours = held !== null && held !== state.heldBefore;
    return ours ? { phase: "confirmed", tookMs: nowMs - state.sinceMs, held: true } : state;
  }
  if (state.phase === "confirmed") {
    if (held !== null) return state.held ? state : { ...state, held: true };
    return state.held ? IDLE : state; // a person has let the robot go on
  }
  return state;
}

function waited(state: StopState, nowMs: number): StopStep {
  if (state.phase !== "asking") return { state, send: false };
  if (nowMs - state.sinceMs >= GIVE_UP_MS) {
    const { heldBefore, sinceMs } = state;
    return { state: { phase: "unconfirmed", heldBefore, sinceMs }, send: false };
  }
  const send = nowMs - state.sentMs >= REPEAT_MS;
  return {
    state: {
      ...state,
      sentMs: send ? nowMs : state.sentMs,
      doubtful: state.doubtful || nowMs - state.sinceMs >= SHOW_DOUBT_MS,
    },
    send,
  };
}
