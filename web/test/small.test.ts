import { describe, expect, it } from "vitest";
import { FIRST_MS, LONGEST_MS, waitMs } from "../src/net/backoff";
import { fixed, seconds, when, steadySpeed, wayLeft } from "../src/panels/format";
import { busy, onlyPartly, sorted, withProgress } from "../src/state/goals";
import { whole } from "../src/panels/Draft";
import { goal } from "./examples";

describe("back-off", () => {
  it("grows to a bound", () => {
    expect(waitMs(0, 1)).toBe(FIRST_MS);
    expect(waitMs(1, 1)).toBe(2 * FIRST_MS);
    expect(waitMs(1000, 1)).toBe(LONGEST_MS);
    expect(waitMs(1000, 0)).toBe(0.75 * LONGEST_MS);
  });
});

describe("numbers", () => {
  it.each([
    [0.04, "0.0 s"],
    [9.94, "9.9 s"],
    [61, "61 s"],
    [600, "10 min"],
    [10_000, "3 h"],
    [null, "–"],
    [Number.NaN, "–"],
  ])("%s s is %s", (value, text) => {
    expect(seconds(value)).toBe(text);
  });

  it("have no minus zero and no NaN", () => {
    expect(fixed(-0.001, 2, "m")).toBe("0.00 m");
    expect(fixed(Number.NaN, 2, "m")).toBe("–");
    expect(fixed(undefined, 2)).toBe("–");
  });
});

describe("when something was", () => {
  const at = (day: number, hour: number) => new Date(2026, 10, day, hour, 5).getTime();

  it("is a time of day, with its date where that is not today's", () => {
    expect(when(at(29, 21), at(29, 23))).toBe("21:05");
    expect(when(at(28, 21), at(29, 1))).toBe("Nov 28 21:05");
  });
});

describe("goals", () => {
  it("that left a part undone are not done", () => {
    const words = { en: "", zh: "" };
    const at = { asked: null, reached: null, metres: null, seconds: null, limited_by: [] };
    const outcome = { code: "done", message: words, ...at };
    const plan = (more: object) => ({
      kind: "plan",
      steps: [{ ...whole({ kind: "explore", state: "succeeded" }), ...more }],
      code: null,
      text: null,
      options: [],
    });
    const told = (more: object) => onlyPartly(goal("a", "succeeded", { outcome, ...more }));
    expect(told({})).toBe(false);
    expect(told({ plan: plan({ code: "explored" }) })).toBe(false);
    expect(told({ outcome: { ...outcome, code: "partly_explored" } })).toBe(true);
    expect(told({ plan: plan({ code: "partly_explored" }) })).toBe(true);
    expect(told({ plan: plan({ stops: [{ place: "p", said: words, shut: true }] }) })).toBe(true);
    expect(onlyPartly(goal("a", "failed", { plan: plan({ code: "partly_explored" }) }))).toBe(
      false,
    );
  });

  it("are sorted into what runs, waits and was", () => {
    const found = sorted([
      goal("z", "succeeded"),
      goal("q2", "queued", { position: 1 }),
      goal("p", "paused"),
      goal("q1", "queued", { position: 0 }),
      goal("r", "running"),
    ]);
    expect(found.current.map(({ id }) => id)).toEqual(["r", "p"]);
    expect(found.queued.map(({ id }) => id)).toEqual(["q1", "q2"]);
    expect(found.past.map(({ id }) => id)).toEqual(["z"]);
  });

  it("that are paused or ended keep nobody waiting", () => {
    expect(busy([goal("a", "paused"), goal("b", "failed")])).toBe(false);
    expect(busy([goal("a", "queued")])).toBe(true);
  });
});

describe("progress", () => {
  const steps = ["go_to", "wait"].map((kind) => whole({ kind, state: "running", left_m: 2.04 }));
  const plan = { kind: "plan", steps, code: null, text: null, options: [] };
  const goals = [goal("a", "running", { plan }), goal("b")];

  it("is put into its step alone", () => {
    const after = withProgress(goals, { goal: "a", step: 1, left_s: 3 });
    expect(after[0]?.plan?.steps).toEqual([steps[0], { ...steps[1], left_s: 3 }]);
    expect(after[1]).toBe(goals[1]);
  });

  it.each([
    ["reads as before", { goal: "a", step: 0, left_m: 1.96 }],
    ["is of another goal", { goal: "c", step: 0, left_m: 1 }],
    ["is of a goal without a plan", { goal: "b", step: 0, left_m: 1 }],
    ["is of no step", { goal: "a", step: 2, left_m: 1 }],
  ])("changes nothing where it %s", (_, progress) => {
    expect(withProgress(goals, progress)).toBe(goals);
  });
});

describe("figures that rest", () => {
  it.each([
    [0.021, "0.05"],
    [0.484, "0.50"],
    [-0.5, "0.50"],
    [0.26, "0.25"],
  ])("writes %s m/s in steps that do not tremble", (speed, text) => {
    expect(steadySpeed(speed)).toBe(text);
  });

  it("writes a way in tenths only where it is near", () => {
    expect([9.74, 3, 2.96, 0.04].map(wayLeft)).toEqual(["10 m", "3 m", "3.0 m", "0.0 m"]);
  });
});
