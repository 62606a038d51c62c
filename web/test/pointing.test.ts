import { describe, expect, it } from "vitest";
import {
  cornerAt,
  crossesItself,
  type Outline,
  withCorner,
  withCornerBetween,
} from "../src/map/outline";
import { placeAt } from "../src/map/resolve";
import type { Marks } from "../src/net/marks";
import { toGoOf } from "../src/state/arrival";
import {
  beginOutline,
  changeMark,
  drawn,
  gripCorner,
  marking,
  slowMps,
  undoCorner,
  withDrawn,
} from "../src/state/pointing";
import type { Place, Step } from "../src/wire/types";

const square: Outline = [
  [0, 0],
  [2, 0],
  [2, 2],
  [0, 2],
];
const other: Outline = [
  [5, 5],
  [6, 5],
  [6, 6],
];
const marks: Marks = {
  version: 1,
  map_id: "m",
  keep_outs: [square, other],
  speed_zones: [{ polygon: other, max_speed_mps: 0.25 }],
};

describe("corners", () => {
  it("are taken hold of only from near by, the nearest of several", () => {
    expect(cornerAt(square, { x: 1.9, y: 0.1 }, 0.3)).toBe(1);
    expect(cornerAt(square, { x: 1, y: 1 }, 0.3)).toBeNull();
    expect(cornerAt([], { x: 1, y: 1 }, 9)).toBeNull();
    expect(withCorner(square, 1, { x: 3.00004, y: -1 })[1]).toEqual([3, -1]);
  });

  it("of a finished outline are added in the side that is nearest", () => {
    expect(withCornerBetween(square, { x: 1, y: -0.2 })[1]).toEqual([1, -0.2]);
    expect(withCornerBetween(square, { x: -0.2, y: 1 })[4]).toEqual([-0.2, 1]);
    for (const at of [0.2, 1, 1.8])
      expect(crossesItself(withCornerBetween(square, { x: 2.3, y: at }))).toBe(false);
  });

  it("follow the finger, and go back where the drag is broken off", () => {
    beginOutline("keep_out", { x: 1, y: 1 });
    const grip = gripCorner({ x: 1.1, y: 1 }, 0.2);
    grip?.move({ x: 4, y: 4 });
    expect(drawn.value?.corners).toEqual([[4, 4]]);
    grip?.cancel();
    expect(drawn.value?.corners).toEqual([[1, 1]]);
    expect(gripCorner({ x: 3, y: 1 }, 0.2)).toBeNull();
    undoCorner();
    expect(gripCorner({ x: 1, y: 1 }, 9)).toBeNull();
  });
});

describe("a mark that is changed", () => {
  it("takes the place of the one before, and nothing else changes", () => {
    const moved = withCorner(square, 2, { x: 3, y: 3 });
    const changed = { kind: "keep_out", corners: moved, insteadOf: square } as const;
    expect(withDrawn(marks, changed, 0.2)).toEqual({ ...marks, keep_outs: [other, moved] });
  });

  it("is one more where the one before has gone meanwhile", () => {
    const changed = { kind: "keep_out", corners: square, insteadOf: [...square, [1, 3]] } as const;
    expect(withDrawn({ ...marks, keep_outs: [other] }, changed, 0.2).keep_outs).toHaveLength(2);
  });

  it("keeps its speed, and stays in force until it is saved", () => {
    marking.value = { marks, marks_hash: "h", agreed: true };
    changeMark("slow", 0);
    expect(slowMps.value).toBe(0.25);
    expect(drawn.value).toEqual({ kind: "slow", corners: other, insteadOf: other });
    expect(marking.value.marks).toBe(marks);
    if (drawn.value) expect(withDrawn(marks, drawn.value, slowMps.value)).toEqual(marks);
    changeMark("slow", 7);
    expect(drawn.value?.corners).toBe(other);
    drawn.value = null;
  });
});

describe("a place that may be moved", () => {
  it("is the nearest one, and never a room", () => {
    const place = (id: string, kind: "room" | "place", x_m: number): Place =>
      ({ id, kind, pose: { x_m, y_m: 0, yaw_rad: 0 } }) as Place;
    const all = [
      place("kitchen", "room", 0),
      place("desk", "place", 0.3),
      place("bed", "place", 2),
    ];
    expect(placeAt(all, { x: 0, y: 0 }, 0.45)?.id).toBe("desk");
    expect(placeAt(all, { x: 0, y: 0 }, 0.2)).toBeNull();
  });
});

describe("how long it takes", () => {
  const step = (state: string, left_m: number | null = null) => ({ state, left_m }) as Step;
  const foreseen = (index: number, length_m: number, seconds: number, instead = false) => ({
    index,
    length_m,
    seconds,
    instead,
  });
  const steps = [step("succeeded"), step("running", 2), step("pending"), step("pending")];

  it("is what is left of this step at its rehearsed speed, and all of those that follow", () => {
    const plan = [
      foreseen(1, 4, 20),
      foreseen(2, 0, 5),
      foreseen(3, 3, 12),
      foreseen(3, 9, 99, true),
    ];
    expect(toGoOf(steps, plan, 0.5)).toEqual({ left: 2, seconds: 27, stepsAfter: 1 });
  });

  it("goes by the speed of late where nobody foresaw it, and is unknown where it stands", () => {
    expect(toGoOf(steps, [], 0.5)).toEqual({ left: 2, seconds: 4, stepsAfter: 0 });
    expect(toGoOf(steps, [], 0)).toEqual({ left: 2, seconds: null, stepsAfter: 0 });
    expect(toGoOf([step("running")], [], 0.5)).toBeNull();
    expect(toGoOf([], [], 0.5)).toBeNull();
  });
});
