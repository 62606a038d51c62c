import { describe, expect, it } from "vitest";
import {
  advance,
  ASKED_MS,
  AT_REST,
  FRAME_MS,
  type HandEvent,
  type HandFrame,
  type HandState,
  IDLE_MS,
  SILENT_MS,
  SLEPT_MS,
  type Source,
  type Why,
} from "../src/hand/machine";
import { deflection, keysDeflection, readPad, steers } from "../src/hand/inputs";

type At = readonly [ms: number, event: HandEvent];

/** Run events at their times; return the last state and all frames. */
function run(
  events: readonly At[],
  from: HandState = AT_REST,
): { state: HandState; frames: HandFrame[] } {
  let state = from;
  const frames: HandFrame[] = [];
  for (const [ms, event] of events) {
    const step = advance(state, event, ms);
    state = step.state;
    if (step.frame) frames.push(step.frame);
  }
  return { state, frames };
}

const opened: At = [0, { type: "opened" }];
const beat = (ms: number, by: "me" | "other" | null = null, code: Why | null = null): At => [
  ms,
  { type: "beat", beat: ms, by, code },
];
const press = (ms: number, source: Source = "pointer", forward = 0.5): At => [
  ms,
  { type: "press", source, forward, left: 0 },
];
const release = (ms: number, source: Source = "pointer"): At => [ms, { type: "release", source }];
const tick = (ms: number): At => [ms, { type: "tick" }];
const ticks = (fromMs: number, toMs: number): At[] =>
  Array.from({ length: Math.floor((toMs - fromMs) / FRAME_MS) + 1 }, (_, n) =>
    tick(fromMs + n * FRAME_MS),
  );
const pad = (ms: number, button: boolean, forward = 0): At => [
  ms,
  { type: "pad", forward, left: 0, button },
];
const driving = run([opened, beat(10), press(20), beat(40, "me")]).state;

describe("a stick", () => {
  it("says at once that it is held, and twenty times a second from then on", () => {
    const { frames } = run([opened, beat(10), press(20), beat(60, "me"), ...ticks(70, 270)]);
    expect(frames.every((frame) => frame.held && frame.forward === 0.5)).toBe(true);
    expect(frames).toHaveLength(6);
    expect(frames.map((frame) => frame.seq)).toEqual([1, 2, 3, 4, 5, 6]);
    expect(frames.at(-1)?.beat).toBe(60);
  });

  it("says its release at once", () => {
    const { frames, state } = run([release(60)], driving);
    expect(frames).toEqual([{ seq: 2, beat: 40, forward: 0, left: 0, held: false }]);
    expect([state.held, state.why]).toEqual([null, null]);
  });

  it("shows that it is released four times a second", () => {
    const { frames } = run([opened, ...ticks(50, 1000)]);
    expect(frames).toHaveLength(Math.floor(1000 / IDLE_MS));
    expect(frames.some((frame) => frame.held)).toBe(false);
  });

  it("moves nothing before the socket is open, and says nothing", () => {
    expect(run([press(10), tick(60), release(70)]).frames).toEqual([]);
    expect(run([press(10), tick(60), opened]).state.held).toBeNull();
  });

  const drops: readonly Why[] = ["blur", "hidden", "cancelled", "stopped"];
  it.each(drops)("lets go at once on %s, and stays so while the finger stays down", (why) => {
    const after: At[] = [
      [100, { type: "steer", source: "pointer", forward: 1, left: 0 }],
      tick(110),
    ];
    const { frames, state } = run([[60, { type: "drop", why }], ...after], driving);
    expect(frames).toEqual([{ seq: 2, beat: 40, forward: 0, left: 0, held: false }]);
    expect([state.held, state.why, state.forward]).toEqual([null, why, 0]);
  });

  it("lets go when the socket closes, and a new one finds it released", () => {
    const { frames, state } = run(
      [[60, { type: "closed" }], tick(110), [200, { type: "opened" }]],
      driving,
    );
    expect(frames).toEqual([]);
    expect([state.held, state.why, state.open]).toEqual([null, "closed", true]);
    expect(run([...ticks(250, 450)], state).frames.every((frame) => !frame.held)).toBe(true);
  });

  it("lets go when no beat comes", () => {
    const { frames, state } = run(ticks(60, 60 + SILENT_MS), driving);
    expect(frames.at(-1)?.held).toBe(false);
    expect(state.why).toBe("silent");
  });

  it("lets go when the page has slept, though beats that were kept come first", () => {
    const woke = 60 + SLEPT_MS + 1;
    const { frames, state } = run([tick(60), beat(woke, "me"), tick(woke)], driving);
    expect(frames.at(-1)?.held).toBe(false);
    expect(state.why).toBe("slept");
  });

  it("lets go when the bridge takes it away", () => {
    const { frames, state } = run([beat(60, null)], driving);
    expect([frames[0]?.held, state.why]).toEqual([false, "ended"]);
  });

  it.each(["hand_taken", "hand_late"] as const)("lets go when it is told %s", (code) => {
    const { frames, state } = run([beat(60, null, code)], driving);
    expect([frames[0]?.held, state.why]).toEqual([false, code]);
  });

  it("lets go where another hand drives", () => {
    expect(run([beat(60, "other")], driving).state.why).toBe("hand_taken");
  });

  it("lets go where the bridge does not follow", () => {
    const beats = Array.from({ length: 20 }, (_, n) => beat(20 + n * 50));
    const all = [opened, ...beats, press(20), ...ticks(70, 100 + ASKED_MS)].sort(
      (a, b) => a[0] - b[0],
    );
    expect(run(all).state).toMatchObject({ held: null, why: "not_taken" });
  });

  it("tells a driver from one who has asked", () => {
    expect(run([opened, beat(10), press(20)]).state.driving).toBe(false);
    expect(driving.driving).toBe(true);
  });

  it("forgets why once it is pressed again", () => {
    const { state } = run([[60, { type: "drop", why: "blur" }], press(100)], driving);
    expect([state.held, state.why, state.driving]).toEqual(["pointer", null, false]);
  });

  it("is one source's at a time", () => {
    const { state } = run([press(60, "keys", -1), release(70, "keys")], driving);
    expect([state.held, state.forward]).toEqual(["pointer", 0.5]);
  });

  it.each([Number.NaN, Number.POSITIVE_INFINITY, 7, -7])(
    "asks for no more than all: %d",
    (forward) => {
      const { frames } = run([opened, beat(10), press(20, "pointer", forward)]);
      expect(Math.abs(frames[0]?.forward ?? 9)).toBeLessThanOrEqual(1);
    },
  );
});

describe("a gamepad", () => {
  const plugged = [opened, beat(10)];

  it("moves nothing until it was seen neutral with its button free", () => {
    expect(run([...plugged, pad(20, true, 1), pad(70, true, 0)]).state.held).toBeNull();
    expect(run([...plugged, pad(20, false, 1), pad(70, true, 1)]).state.held).toBeNull();
    expect(run([...plugged, pad(20, false, 0), pad(70, true, 1)]).state.held).toBe("pad");
  });

  const held = run([...plugged, pad(20, false), pad(70, true, 1), beat(80, "me")]).state;

  it("stops when its button is let go", () => {
    const { frames, state } = run([pad(120, false, 1)], held);
    expect([frames[0]?.held, state.why]).toEqual([false, null]);
  });

  it("stops when it is pulled out, and must be neutral once more", () => {
    const { frames, state } = run([[120, { type: "pad_gone" }], pad(170, true, 1)], held);
    expect([frames[0]?.held, state.held, state.why]).toEqual([false, null, "unplugged"]);
    expect(run([[120, { type: "pad_gone" }]], driving).state.held).toBe("pointer");
  });

  it("stays let go while its button stays down", () => {
    const all: At[] = [[120, { type: "drop", why: "blur" }], pad(170, true, 1), pad(220, true, 0)];
    expect(run(all, held).state.held).toBeNull();
    expect(run([...all, pad(270, false), pad(320, true, 1)], held).state.held).toBe("pad");
  });

  it("is read by its left stick and its shoulders, all its sticks at rest", () => {
    const buttons = Array.from({ length: 17 }, () => ({ pressed: false }));
    const shoulder = buttons.map((_, index) => ({ pressed: index === 5 }));
    const read = (axes: readonly number[], down = buttons) =>
      readPad({ axes, buttons: down, connected: true });
    expect(read([0, 0, 0, 0])).toEqual({ forward: 0, left: 0, button: false });
    expect(read([0, -1, 0, 0], shoulder)).toMatchObject({ forward: 1, button: true });
    expect(read([-1, 0, 0, 0], shoulder).left).toBeCloseTo(1);
    expect(read([0, 0, 0.8, 0]).forward).toBe(1); // not neutral
    expect(read([0, 0, 0, 0, -1, -1]).forward).toBe(0); // triggers of an odd pad
    expect(read([])).toEqual({ forward: 0, left: 0, button: false });
  });
});

describe("fingers and keys", () => {
  it("ask in fractions of the way, and for nothing in the middle", () => {
    expect(deflection(0, -80, 80).forward).toBeCloseTo(1);
    expect(deflection(0, -800, 80).forward).toBeCloseTo(1);
    expect(deflection(80, 0, 80).left).toBeCloseTo(-1);
    expect(deflection(5, 5, 80)).toEqual({ forward: 0, left: 0 });
    expect(deflection(0, 0, 0)).toEqual({ forward: 0, left: 0 });
  });

  it("add up", () => {
    expect(keysDeflection(new Set(["KeyW", "ArrowLeft"]))).toEqual({ forward: 1, left: 1 });
    expect(keysDeflection(new Set(["KeyW", "ArrowDown"]))).toEqual({ forward: 0, left: 0 });
    expect([steers("KeyS"), steers("Space"), steers("constructor")]).toEqual([true, false, false]);
  });
});
