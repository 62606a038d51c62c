import { describe, expect, it } from "vitest";
import {
  area,
  crossesItself,
  flawOf,
  headingTo,
  rounded,
  stepped,
  timeToGo,
  TRAIL_MOST,
  withTrail,
  type Outline,
} from "../src/map/outline";
import { pose } from "../src/map/pointDrawing";

const square: Outline = [
  [0, 0],
  [1, 0],
  [1, 1],
  [0, 1],
];

describe("an outline", () => {
  it("has an area whichever way round it runs", () => {
    expect(area(square)).toBe(1);
    expect(area([...square].reverse())).toBe(1);
    expect(area([])).toBe(0);
  });

  it("crosses itself or does not", () => {
    expect(crossesItself(square)).toBe(false);
    expect(
      crossesItself([
        [0, 0],
        [1, 1],
        [1, 0],
        [0, 1],
      ]),
    ).toBe(true);
  });

  it("is told what is wrong with it", () => {
    expect(flawOf(square)).toBeNull();
    expect(flawOf(square.slice(0, 2))).toBe("few");
    expect(flawOf(Array.from({ length: 101 }, (_, n): [number, number] => [n, n * n]))).toBe(
      "many",
    );
    expect(
      flawOf([
        [0, 0],
        [2, 2],
        [2, 0],
        [0, 2],
      ]),
    ).toBe("crosses");
    expect(
      flawOf([
        [0, 0],
        [0.1, 0],
        [0, 0.1],
      ]),
    ).toBe("small");
  });

  it("keeps millimetres", () => {
    expect(rounded([1.23456, -0.0004])).toEqual([1.235, -0]);
  });
});

describe("a heading", () => {
  it("leads from one point to another, and nowhere on the spot", () => {
    expect(headingTo({ x: 1, y: 1 }, { x: 1, y: 3 })).toBeCloseTo(Math.PI / 2);
    expect(headingTo({ x: 1, y: 1 }, { x: 1, y: 1.01 })).toBeNull();
  });

  it("is drawn as a line out of the ring", () => {
    expect(pose(0, 0, 0)).toContain("l0.45 0");
    expect(pose(0, 0, undefined)).not.toContain("l");
  });
});

describe("the arrow keys", () => {
  it("move a point, farther with shift, and no other key does", () => {
    expect(stepped({ x: 0, y: 0 }, "ArrowUp", false)).toEqual({ x: 0, y: 0.1 });
    expect(stepped({ x: 0, y: 0 }, "ArrowLeft", true)).toEqual({ x: -0.5, y: 0 });
    expect(stepped({ x: 0, y: 0 }, "a", false)).toBeNull();
  });
});

describe("a trail", () => {
  it("grows as the robot moves and no longer than is drawn", () => {
    let trail: Outline = withTrail([], { x: 0, y: 0 });
    expect(withTrail(trail, { x: 0.05, y: 0 })).toBe(trail);
    for (let n = 1; n < 2 * TRAIL_MOST; n += 1) trail = withTrail(trail, { x: n, y: 0 });
    expect(trail).toHaveLength(TRAIL_MOST);
    expect(trail.at(-1)).toEqual([2 * TRAIL_MOST - 1, 0]);
  });
});

describe("the time to go", () => {
  it("is known while it moves", () => {
    expect(timeToGo(6, 0.3)).toBeCloseTo(20);
    expect(timeToGo(6, 0)).toBeNull();
  });
});
