import { describe, expect, it } from "vitest";
import { withRuns } from "../src/state/runs";
import type { Goal, OrderRun } from "../src/wire/types";

const goal = (id: string, minute: number): Goal =>
  ({ id, created: new Date(minute * 60_000).toISOString() }) as Goal;
const run = (serial: number, minute: number, of: string | null = null): OrderRun =>
  ({ order: "o", serial, goal: of, at: new Date(minute * 60_000).toISOString() }) as OrderRun;
const told = (past: ReturnType<typeof withRuns>): string =>
  past.map((one) => ("goal" in one ? one.goal.id : `run${one.run.serial}`)).join(" ");

describe("runs of standing orders", () => {
  it("stand among what was said by their time, the newest first", () => {
    const past = [goal("c", 30), goal("b", 20), goal("a", 10)];
    expect(told(withRuns(past, [run(3, 35), run(2, 25), run(1, 5)], past))).toBe(
      "run3 c run2 b a run1",
    );
    expect(told(withRuns([], [run(1, 5)], []))).toBe("run1");
    expect(told(withRuns(past, [], past))).toBe("c b a");
  });

  it("are told once: by the goal that they gave, wherever it stands", () => {
    const [open, past] = [goal("open", 40), goal("past", 30)];
    const ran = [run(2, 40, "open"), run(1, 30, "past"), run(0, 1, "long_gone")];
    expect(told(withRuns([past], ran, [open, past]))).toBe("past run0");
  });
});
