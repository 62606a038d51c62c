import { describe, expect, it } from "vitest";
import { percent } from "../src/panels/format";
import {
  candidates,
  matchShare,
  path,
  poseDoubtful,
  poseLost,
  poseTrouble,
  poseUnknown,
  receive,
  shown,
} from "../src/state/store";
import type { Robot } from "../src/wire/types";
import { robot, status } from "./examples";

const guess = { pose: { x_m: 1, y_m: 2, yaw_rad: 0 }, score: 0.54 };
function hear(more: Partial<Robot>): void {
  shown.value = { ...robot, ...more };
}

describe("the match of lidar and map", () => {
  it("is shown in steps that do not tremble, never below nothing", () => {
    for (const [score, share] of [
      [0.93, 0.95],
      [0.94, 0.95],
      [-0.4, 0],
    ] as const) {
      hear({ match: { score, candidates: [] } });
      expect(matchShare.value).toBeCloseTo(share);
    }
  });

  it("is nothing where nobody compares", () => {
    hear({ localizer: null, match: null });
    expect(matchShare.value).toBeNull();
  });

  it("is written as a share of a hundred", () => {
    expect(percent(0.549)).toBe("55 %");
    expect(percent(-0.1)).toBe("0 %");
  });
});

describe("a pose that scans do not confirm", () => {
  it.each([
    ["tracking", false],
    ["coasting", true],
    ["lost", true],
    ["searching", true],
    [null, false],
  ] as const)("is doubtful while the localizer is %s: %s", (localizer, doubtful) => {
    hear({ localizer });
    expect(poseDoubtful.value).toBe(doubtful);
  });
});

describe("a robot that is lost", () => {
  it.each([
    ["tracking", [], null],
    ["coasting", [], null],
    ["coasting", ["POSE_LOST.0"], "lost"],
    [null, ["POSE_LOST.1"], "lost"],
    ["tracking", ["LIDAR_STALE.0", "POSE_LOST.0"], "lost"],
    ["tracking", ["POSE_JUMP.0"], null],
    ["searching", ["POSE_LOST.0"], "searching"],
    ["lost", [], "lost"],
  ] as const)("is known by localizer %s and rows %j: %s", (localizer, names, unknown) => {
    const rows = names.map((row) => ({
      row,
      action: "HOLD2",
      for_s: 1,
      evidence: "",
      binding: false,
    }));
    hear({ localizer, status: { ...status, rows } });
    expect(poseUnknown.value).toBe(unknown);
  });
});

describe("why it is lost", () => {
  const message = { en: "Put me back.", zh: "请放回原处。" };
  const localizer_trouble = { code: "carried_while_mapping", message };

  it("is told while it is lost, and no longer", () => {
    hear({ localizer: "lost", localizer_trouble });
    expect(poseTrouble.value?.message).toEqual(message);
    hear({ localizer: "lost" });
    expect(poseTrouble.value).toBeNull();
    hear({ localizer: "tracking", localizer_trouble });
    expect(poseTrouble.value).toBeNull();
  });
});

describe("candidates", () => {
  it("are shown while it looks for itself", () => {
    hear({ localizer: "searching", match: { score: 0, candidates: [guess] } });
    expect(poseLost.value).toBe("searching");
    expect(candidates.value).toEqual([guess]);
  });

  it("are gone once it knows where it is", () => {
    hear({ localizer: "tracking", match: { score: 0.9, candidates: [guess] } });
    expect(candidates.value).toEqual([]);
  });
});

describe("a way that bends", () => {
  it("says why, and where", () => {
    const doubt = {
      code: "route_bent",
      message: { en: "The way leads round something.", zh: "绕行。" },
      x_m: 1,
      y_m: 2,
    };
    receive(
      JSON.stringify({ seq: 1, kind: "path", path: { goal: "g", leg: 1, points: [], doubt } }),
    );
    expect(path.value?.doubt).toEqual(doubt);
  });
});
