/**
 * Decide what a hand on the stick says to the robot, and when it has let go. Pure: told the time,
 * knows no socket, no screen and no gamepad. Whatever is not surely a hand that holds now is a
 * release; a stick that was taken away must be let go before it is held again.
 */
export const FRAME_MS = 50; // while held; the bridge takes 20 a second
export const IDLE_MS = 250; // while not: shows the bridge a stick that is released
export const SILENT_MS = 400; // without a beat, of which twenty a second come
export const SLEPT_MS = 400; // between two ticks: the page was asleep, whatever it was told since
export const ASKED_MS = 700; // pressed, and the bridge has not followed

export type Source = "pointer" | "keys" | "pad";

export type Why =
  | "blur"
  | "hidden"
  | "cancelled"
  | "closed"
  | "silent"
  | "slept"
  | "unplugged"
  | "stopped"
  | "ended" // the bridge took the stick away
  | "not_taken" // it never gave it
  | "hand_taken"
  | "hand_late";

export type HandState = {
  readonly open: boolean;
  readonly held: Source | null;
  readonly driving: boolean; // the bridge follows this very press
  readonly forward: number;
  readonly left: number;
  readonly why: Why | null; // why the last press ended, where its hand did not let go
  readonly padReady: boolean; // seen with its button free and its axes neutral
  readonly seq: number;
  readonly beat: number;
  readonly beatMs: number;
  readonly tickMs: number;
  readonly sentMs: number;
  readonly pressedMs: number;
};

export const AT_REST: HandState = {
  open: false,
  held: null,
  driving: false,
  forward: 0,
  left: 0,
  why: null,
  padReady: false,
  seq: 0,
  beat: 0,
  beatMs: 0,
  tickMs: 0,
  sentMs: 0,
  pressedMs: 0,
};

export type HandEvent =
  | { readonly type: "opened" }
  | { readonly type: "closed" }
  | { readonly type: "beat"; readonly beat: number; readonly by: By; readonly code: Why | null }
  | {
      readonly type: "press";
      readonly source: Source;
      readonly forward: number;
      readonly left: number;
    }
  | {
      readonly type: "steer";
      readonly source: Source;
      readonly forward: number;
      readonly left: number;
    }
  | { readonly type: "release"; readonly source: Source }
  | { readonly type: "drop"; readonly why: Why }
  | {
      readonly type: "pad";
      readonly forward: number;
      readonly left: number;
      readonly button: boolean;
    }
  | { readonly type: "pad_gone" }
  | { readonly type: "tick" };

/** Whose hand the bridge follows. */
export type By = "me" | "other" | null;

export type HandFrame = {
  readonly seq: number;
  readonly beat: number;
  readonly forward: number;
  readonly left: number;
  readonly held: boolean;
};

export type HandStep = { readonly state: HandState; readonly frame: HandFrame | null };

const NEUTRAL = 0.12; // of a stick's way; nobody holds one straighter

export function advance(state: HandState, event: HandEvent, nowMs: number): HandStep {
  switch (event.type) {
    case "opened":
      return silent({ ...AT_REST, open: true, why: state.why, beatMs: nowMs, tickMs: nowMs });
    case "closed":
      return silent({ ...taken(state, "closed"), open: false });
    case "beat":
      return heard(state, event, nowMs);
    case "press":
      return press(state, event, nowMs);
    case "steer":
      return silent(state.held === event.source ? { ...state, ...bounded(event) } : state);
    case "release":
      return state.held === event.source ? said(rested(state), nowMs) : silent(state);
    case "drop":
      return drop(state, event.why, nowMs);
    case "pad":
      return pad(state, event, nowMs);
    case "pad_gone":
      return state.held === "pad"
        ? drop(state, "unplugged", nowMs)
        : silent({ ...state, padReady: false });
    case "tick":
      return tick(state, nowMs);
  }
}

const silent = (state: HandState): HandStep => ({ state, frame: null });

/** Say how the stick is held now. */
function said(before: HandState, nowMs: number): HandStep {
  if (!before.open) return silent(before);
  const state = { ...before, seq: before.seq + 1, sentMs: nowMs };
  const { seq, beat, forward, left, held } = state;
  return { state, frame: { seq, beat, forward, left, held: held !== null } };
}

const rested = (state: HandState): HandState => ({
  ...state,
  held: null,
  driving: false,
  forward: 0,
  left: 0,
});

/** Take the stick from the hand that holds it. A gamepad's button may still be down. */
const taken = (state: HandState, why: Why): HandState =>
  state.held === null ? { ...state, padReady: false } : { ...rested(state), why, padReady: false };

const drop = (state: HandState, why: Why, nowMs: number): HandStep =>
  state.held === null ? silent(state) : said(taken(state, why), nowMs);

function press(
  state: HandState,
  asked: { readonly source: Source; readonly forward: number; readonly left: number },
  nowMs: number,
): HandStep {
  if (!state.open || state.held !== null) return silent(state); // one source holds at a time
  const held = { ...state, ...bounded(asked), held: asked.source, why: null, pressedMs: nowMs };
  return said(held, nowMs);
}

type Asked = { readonly forward: number; readonly left: number };

const bound = (value: number): number =>
  Number.isFinite(value) ? Math.round(Math.max(-1, Math.min(1, value)) * 1000) / 1000 : 0;
const bounded = ({ forward, left }: Asked): Asked => ({
  forward: bound(forward),
  left: bound(left),
});

function pad(
  state: HandState,
  read: { readonly forward: number; readonly left: number; readonly button: boolean },
  nowMs: number,
): HandStep {
  const neutral = Math.abs(read.forward) <= NEUTRAL && Math.abs(read.left) <= NEUTRAL;
  if (!read.button) {
    const ready = { ...state, padReady: state.padReady || neutral };
    return ready.held === "pad" ? said(rested(ready), nowMs) : silent(ready);
  }
  if (state.held === "pad") return silent({ ...state, ...bounded(read) });
  return state.padReady ? press(state, { ...read, source: "pad" }, nowMs) : silent(state);
}

function heard(
  before: HandState,
  { beat, by, code }: { readonly beat: number; readonly by: By; readonly code: Why | null },
  nowMs: number,
): HandStep {
  const state = { ...before, beat, beatMs: nowMs };
  if (state.held === null) return silent(state);
  if (code !== null) return drop(state, code, nowMs);
  if (by === "me") return silent({ ...state, driving: true });
  if (by === "other") return drop(state, "hand_taken", nowMs);
  return state.driving ? drop(state, "ended", nowMs) : silent(state);
}

function tick(before: HandState, nowMs: number): HandStep {
  const state = { ...before, tickMs: nowMs };
  if (!state.open) return silent(state);
  if (state.held === null) {
    return nowMs - state.sentMs >= IDLE_MS ? said(state, nowMs) : silent(state);
  }
  if (!(nowMs - before.tickMs <= SLEPT_MS)) return drop(state, "slept", nowMs);
  if (!(nowMs - state.beatMs <= SILENT_MS)) return drop(state, "silent", nowMs);
  if (!state.driving && nowMs - state.pressedMs > ASKED_MS) return drop(state, "not_taken", nowMs);
  return said(state, nowMs);
}
