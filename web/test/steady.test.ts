import { effect, signal } from "@preact/signals";
import { describe, expect, it } from "vitest";
import { samePose, sameScan, SEEN_CM, SEEN_M, SEEN_RAD } from "../src/map/unmoved";
import { steady } from "../src/state/steady";
import { turning } from "../src/state/turning";
import type { Robot, Status } from "../src/wire/types";
import { robot, status } from "./examples";

describe("a steady value", () => {
  it("tells its readers of what can be seen alone, and never drifts away from it", () => {
    const exact = signal(0);
    const seen = steady(
      () => exact.value,
      (kept, next) => Math.abs(next - kept) <= 1,
    );
    const told: number[] = [];
    const end = effect(() => void told.push(seen.value));
    for (const value of [0.5, 1, 0.9, 1.1, 1.8, 2.2, -5]) exact.value = value;
    end();
    expect(told).toEqual([0, 1.1, 2.2, -5]);
  });

  it("takes plain data that reads the same for the same", () => {
    const source = signal<{ words: string | null }>({ words: "a" });
    const seen = steady(() => ({ ...source.value }));
    const first = seen.value;
    source.value = { words: "a" };
    expect(seen.value).toBe(first);
    source.value = { words: null };
    expect(seen.value).toEqual({ words: null });
  });
});

describe("what is drawn", () => {
  const pose = (x_m: number, yaw_rad: number) => ({ x_m, y_m: 0, yaw_rad });
  const edge = SEEN_RAD * 0.9;

  it.each([
    [pose(0, 0), pose(SEEN_M * 0.9, edge), true],
    [pose(0, 0), pose(SEEN_M * 1.1, 0), false],
    [pose(0, 0), pose(0, SEEN_RAD * 1.1), false],
    [pose(0, Math.PI - edge / 2), pose(0, -Math.PI + edge / 2), true], // over the seam
    [pose(0, 0), pose(Number.NaN, 0), false],
    [null, pose(0, 0), false],
    [null, null, true],
  ])("is the pose %j for %j: %s", (kept, next, same) => {
    expect(samePose(kept, next)).toBe(same);
  });

  const wall = Array.from({ length: 200 }, (_, index) => [3 * index, 100]).flat();
  const noisy = wall.map((value, index) => value + ((index * 7) % 11) / 3 - 1.7);
  const pushed = wall.map((value, index) =>
    index % 2 === 1 && index < 40 ? 100 + 2 * SEEN_CM : value,
  );

  it.each([
    ["noise", noisy, true],
    ["two points less at the edge of its reach", wall.slice(4), true],
    ["something before the wall", pushed, false],
    ["half of it gone", wall.slice(0, 200), false],
    ["nothing", [], false],
  ])("is the scan with %s: %#", (_, next, same) => {
    expect(sameScan(wall, next)).toBe(same);
    expect(sameScan(next, wall)).toBe(same);
  });
});

describe("a turning point", () => {
  const held = { reason: "stop", id: "s1" };
  const row = { row: "LOOP_LATE", action: "CAP", for_s: 1, evidence: "", binding: true };
  const changes: Partial<Status>[] = [
    { mode: "STOPPING" },
    { epoch: "b1-4" },
    { boot: "b2" },
    { held },
    { owner: null },
    { blocked: true },
    { rows: [row] },
    { waiting_for: ["lidar"] },
  ];

  it.each(changes)("is %j", (change) => {
    expect(turning({ ...robot, status: { ...status, ...change } })).not.toBe(turning(robot));
  });

  it("is the first word, of the planner and of the bridge", () => {
    const silent: Robot = { ...robot, status: null };
    expect(new Set([turning(null), turning(silent), turning(robot)]).size).toBe(3);
  });

  it("is no change of numbers", () => {
    const later = { ...status, seq: 8, base_in_map: null, operator_seconds: 3599 };
    expect(turning({ ...robot, status: later })).toBe(turning(robot));
    const longer = { ...row, for_s: 2, evidence: "more" };
    const up = (rows: Status["rows"]): string => turning({ ...robot, status: { ...status, rows } });
    expect(up([row])).toBe(up([longer]));
  });
});
