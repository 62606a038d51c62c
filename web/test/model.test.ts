import { describe, expect, it } from "vitest";
import {
  advance,
  ageOf,
  connected,
  EMPTY,
  MAX_GOALS,
  MAX_LOG,
  type Model,
} from "../src/state/model";
import type { Frame } from "../src/wire/types";
import { goal, robot, snapshot } from "./examples";

const at = (seconds: number) => ({ monotonicMs: seconds * 1000, wallMs: 1e12 + seconds * 1000 });
const begun = (): Model => advance(EMPTY, snapshot(1) as Frame, at(0));

describe("frames", () => {
  it("begin with a snapshot, newest goal first", () => {
    expect(begun().goals.map(({ id }) => id)).toEqual(["bb", "a"]);
  });

  it("keep an open goal before all that ended, however old it is", () => {
    let model = begun();
    for (let n = 0; n < 2 * MAX_GOALS; n++) {
      const later = { ...goal(`g${n}`, "succeeded"), created: `2099-01-01T00:00:${10 + n}Z` };
      model = advance(model, { seq: 2 + n, kind: "goal", goal: later }, at(n));
    }
    expect(model.goals).toHaveLength(MAX_GOALS);
    expect(model.goals[0]?.id).toBe("bb");
  });

  it("that were none are counted and change nothing else", () => {
    const before = begun();
    expect(advance(before, null, at(1))).toEqual({ ...before, ignored: 1 });
  });

  it("put a goal in place of the one of its id", () => {
    const after = advance(begun(), { seq: 2, kind: "goal", goal: goal("a", "succeeded") }, at(1));
    expect(after.goals.map(({ id, state }) => [id, state])).toEqual([
      ["bb", "running"],
      ["a", "succeeded"],
    ]);
  });

  it("that are missing ask for a snapshot, and a snapshot ends the asking", () => {
    const next = advance(begun(), { seq: 2, kind: "robot", robot }, at(1));
    expect(next.wantsSnapshot).toBe(false);
    const gap = advance(next, { seq: 9, kind: "robot", robot }, at(2));
    expect([gap.wantsSnapshot, gap.gaps]).toEqual([true, 1]);
    expect(advance(gap, snapshot(10) as Frame, at(3)).wantsSnapshot).toBe(false);
  });

  it("that say they lost some ask for a snapshot too", () => {
    expect(advance(begun(), { seq: 2, kind: "gap" }, at(1)).wantsSnapshot).toBe(true);
  });

  it("count anew on a new connection", () => {
    const again = advance(connected(begun()), { ...(snapshot(1) as Frame) }, at(5));
    expect([again.gaps, again.wantsSnapshot]).toEqual([0, false]);
  });

  it("of any number keep goals and log bounded", () => {
    let model = begun();
    for (let n = 0; n < 400; n += 1) {
      model = advance(model, { seq: 2 + 2 * n, kind: "goal", goal: goal(`g${n}`) }, at(n));
      model = advance(model, { seq: 3 + 2 * n, kind: "say", language: "en", text: "hello" }, at(n));
    }
    expect(model.goals).toHaveLength(MAX_GOALS);
    expect(model.log).toHaveLength(MAX_LOG);
    expect(new Set(model.log.map(({ id }) => id)).size).toBe(MAX_LOG);
  });
});

describe("ages", () => {
  it("are what the planner said and the time since", () => {
    expect(ageOf(begun(), "status", at(3))).toBeCloseTo(3.02);
    expect(ageOf(begun(), "page", at(3))).toBeCloseTo(3);
  });

  it("are unknown before anything was heard", () => {
    expect(ageOf(EMPTY, "status", at(3))).toBeNull();
    expect(ageOf(begun(), "scan", at(3))).toBeNull();
    expect(ageOf(begun(), "nothing of the kind", at(3))).toBeNull();
  });

  it("grow while only snapshots of an old status come", () => {
    const old = { ...robot, ages_s: { ...robot.ages_s, status: 4 } };
    const model = advance(begun(), { seq: 2, kind: "robot", robot: old }, at(9));
    expect(ageOf(model, "status", at(9))).toBeCloseTo(4);
  });
});
