import { describe, expect, it } from "vitest";
import { stops } from "../src/stop/keys";
import {
  advance,
  GIVE_UP_MS,
  IDLE,
  REPEAT_MS,
  SHOW_DOUBT_MS,
  type StopEvent,
  type StopState,
} from "../src/stop/machine";

const press: StopEvent = { type: "pressed", held: null };
const tick: StopEvent = { type: "tick" };

/** Run events at their times [ms]; return the last state and the times of sending. */
function run(...events: readonly (readonly [number, StopEvent])[]): {
  state: StopState;
  sent: number[];
} {
  let state: StopState = IDLE;
  const sent: number[] = [];
  for (const [at, event] of events) {
    const step = advance(state, event, at);
    state = step.state;
    if (step.send) sent.push(at);
  }
  return { state, sent };
}

const ticks = (fromMs: number, toMs: number): [number, StopEvent][] =>
  Array.from({ length: Math.floor((toMs - fromMs) / 100) + 1 }, (_, n) => [fromMs + n * 100, tick]);

describe("stop", () => {
  it("is sent at once, and again on every press", () => {
    expect(run([5, press], [6, press], [7, press]).sent).toEqual([5, 6, 7]);
  });

  it("is repeated until the bridge confirms", () => {
    const { sent, state } = run(
      [0, press],
      ...ticks(100, 1200),
      [1250, { type: "answered", confirmed: true }],
      ...ticks(1300, 3000),
    );
    expect(sent).toEqual([0, REPEAT_MS, 2 * REPEAT_MS]);
    expect(state).toEqual({ phase: "confirmed", tookMs: 1250, held: false });
  });

  it("is in doubt after a second, not before", () => {
    expect(run([0, press], ...ticks(100, SHOW_DOUBT_MS - 100)).state).toMatchObject({
      doubtful: false,
    });
    expect(run([0, press], ...ticks(100, SHOW_DOUBT_MS)).state).toMatchObject({ doubtful: true });
  });

  it("stays unconfirmed where the planner answers that the bridge did not", () => {
    const { state } = run([0, press], [2100, { type: "answered", confirmed: false }], [2200, tick]);
    expect(state).toMatchObject({ phase: "asking", doubtful: true });
  });

  it("gives up sending but not the red; a late word still confirms", () => {
    const late = run([0, press], ...ticks(100, GIVE_UP_MS + 500));
    expect(late.state.phase).toBe("unconfirmed");
    expect(
      advance(late.state, { type: "answered", confirmed: true }, GIVE_UP_MS + 900).state.phase,
    ).toBe("confirmed");
    expect(advance(late.state, press, GIVE_UP_MS + 900)).toMatchObject({
      send: true,
      state: { phase: "asking", doubtful: true },
    });
  });

  it("believes a hold of the bridge that was not there before, and no other", () => {
    expect(
      run([0, { type: "pressed", held: "old" }], [50, { type: "held", held: "old" }]).state.phase,
    ).toBe("asking");
    expect(
      run([0, { type: "pressed", held: "old" }], [50, { type: "held", held: "new" }]).state.phase,
    ).toBe("confirmed");
    expect(run([0, press], [50, { type: "held", held: null }]).state.phase).toBe("asking");
  });

  it("says nothing more once a person has let the robot go on", () => {
    const { state } = run(
      [0, press],
      [40, { type: "answered", confirmed: true }],
      [60, { type: "held", held: "s" }],
      [900, { type: "held", held: null }],
    );
    expect(state).toEqual(IDLE);
  });

  it("does not forget the confirmation before the hold is seen", () => {
    const { state } = run(
      [0, press],
      [40, { type: "answered", confirmed: true }],
      [60, { type: "held", held: null }],
    );
    expect(state.phase).toBe("confirmed");
  });

  it("is not started by an answer, a hold or time", () => {
    expect(
      run([0, { type: "answered", confirmed: true }], [1, { type: "held", held: "s" }], [2, tick]),
    ).toEqual({ state: IDLE, sent: [] });
  });
});

describe("keys", () => {
  it.each([
    ["Escape", "Escape", false, true],
    ["Escape", "Escape", true, true],
    ["Process", "Escape", true, true], // an input method has the key
    [" ", "Space", false, true],
    [" ", "Space", true, false],
    ["Enter", "Enter", false, false],
    ["s", "KeyS", false, false],
  ])("%s (%s), typing %s: %s", (key, code, typing, expected) => {
    expect(stops({ key, code, typing })).toBe(expected);
  });
});
