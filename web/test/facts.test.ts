import { describe, expect, it } from "vitest";
import { asking, headlineNow, heldGoal } from "../src/state/facts";
import { began, receive } from "../src/state/store";
import type { Goal, Status } from "../src/wire/types";
import { goal, robot, snapshot, status } from "./examples";

let seq = 0;

/** Hear a robot in a state, with these goals. */
function hear(said: Partial<Status>, goals: readonly Goal[] = []): void {
  began();
  const frame = { ...snapshot(1), robot: { ...robot, status: { ...status, seq: ++seq, ...said } } };
  receive(JSON.stringify({ ...frame, goals }));
}

const stopped = { held: { reason: "stop", id: "page-1" } };
const battery = { row: "BATTERY", action: "CAP", for_s: 9, evidence: "15 %", binding: true };

describe("what the state's word is made of", () => {
  it.each([
    [{}, [], "mode.HOLD"],
    [{ rows: [battery] }, [], "now.low"],
    [{ rows: [{ ...battery, row: "DEAD_MAN" }] }, [], "mode.HOLD"],
    [{ rows: [{ ...battery, row: "LIDAR_STALE", action: "HOLD2" }] }, [], "now.waits"],
    [{ waiting_for: ["fence_excludes_robot"] }, [], "now.waits"],
    [{ waiting_for: ["recorder_down"] }, [], "mode.HOLD"],
    [{}, [goal("a", "awaiting_confirmation")], "now.asks"],
    [stopped, [goal("a", "paused")], "now.stopped"],
    [{}, [goal("a", "planning")], "now.thinks"],
    [{}, [goal("a", "succeeded")], "mode.HOLD"],
  ] as const)("%j with %j is %s", (said, goals, word) => {
    hear(said, goals);
    expect(headlineNow.value.word).toBe(word);
  });

  it("asks its newest question first", () => {
    const at = (second: number) => ({ updated: `2026-01-01T00:00:0${second}Z` });
    hear({}, [goal("a", "needs_clarification", at(1)), goal("b", "needs_clarification", at(2))]);
    expect(asking.value.map(({ id }) => id)).toEqual(["b", "a"]);
  });

  it("offers to resume the goal that was paused last, while something holds the robot", () => {
    const goals = [
      goal("a", "paused", { updated: "2026-01-01T00:00:01Z" }),
      goal("b", "paused", { updated: "2026-01-01T00:00:02Z" }),
    ];
    hear(stopped, goals);
    expect(heldGoal.value?.id).toBe("b");
    hear({}, goals);
    expect(heldGoal.value).toBeNull();
  });
});
