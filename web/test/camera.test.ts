import { describe, expect, it } from "vitest";
import {
  type Camera,
  changed,
  fitting,
  heldOver,
  MAX_PX_PER_M,
  originOf,
  pinned,
  revealing,
  toPixel,
  toPoint,
  unmovedPixel,
} from "../src/map/camera";
import { stepped } from "../src/map/outline";
import { someNumbers } from "./numbers";

const view: Camera = { x: 2, y: 3, scale: 50, turn: 0, width: 400, height: 300 };
const box = { left: 0, bottom: 0, right: 10, top: 6 };

const cameras = (): Camera[] =>
  someNumbers(60, 5).map(([x = 0, y = 0, s = 0, turn = 0]) => ({
    x: 10 * x,
    y: 10 * y,
    scale: 60 + 50 * s,
    turn: 3 * turn,
    width: 390,
    height: 340,
  }));

describe("a camera", () => {
  it("shows y up, and its middle in the middle", () => {
    expect(toPixel(view, { x: 2, y: 3 })).toEqual({ x: 200, y: 150 });
    expect(toPixel(view, { x: 3, y: 4 })).toEqual({ x: 250, y: 100 });
  });

  it("turned a quarter clockwise shows east below", () => {
    const at = toPixel({ ...view, turn: Math.PI / 2 }, { x: 3, y: 3 });
    expect(at.x).toBeCloseTo(200);
    expect(at.y).toBeCloseTo(200);
  });

  it("finds the point under each pixel again, however it is turned", () => {
    for (const camera of cameras()) {
      const there = toPoint(camera, toPixel(camera, { x: 1.5, y: -2.5 }));
      expect(there.x).toBeCloseTo(1.5, 6);
      expect(there.y).toBeCloseTo(-2.5, 6);
    }
  });

  it("keeps what lies under the fingers while it zooms and turns", () => {
    for (const camera of cameras()) {
      const fingers = { x: 100, y: 222 };
      const [before, next] = [toPoint(camera, fingers), changed(camera, 1.3, 0.4, fingers)];
      const after = toPoint(next, fingers);
      expect(after.x).toBeCloseTo(before.x, 6);
      expect(after.y).toBeCloseTo(before.y, 6);
    }
    expect(changed(view, 1e9, 0, { x: 0, y: 0 }).scale).toBe(MAX_PX_PER_M);
  });

  it("moves labels by its origin alone while it pans", () => {
    const moved = pinned(view, { x: 0, y: 0 }, { x: 7, y: 9 });
    expect(unmovedPixel(moved, { x: 5, y: 5 })).toEqual(unmovedPixel(view, { x: 5, y: 5 }));
    expect(originOf(moved).x).toBeCloseTo(7);
    expect(originOf(moved).y).toBeCloseTo(9);
  });

  it("fits a box whole, however it is turned, and touches two sides", () => {
    for (const { turn } of cameras()) {
      const fit = fitting({ ...view, turn }, box, 10);
      const corners = [
        [0, 0],
        [10, 0],
        [10, 6],
        [0, 6],
      ].map(([x = 0, y = 0]) => toPixel(fit, { x, y }));
      const spare = corners.flatMap(({ x, y }) => [x, view.width - x, y, view.height - y]);
      expect(Math.min(...spare)).toBeCloseTo(10, 6);
    }
  });

  it("is held over the map, and brings a point into view by the shortest way", () => {
    expect(heldOver({ ...view, x: -4, y: 99 }, box)).toMatchObject({ x: 0, y: 6 });
    expect(revealing(view, { x: 2, y: 3 }, 40)).toBe(view);
    for (const camera of cameras()) {
      const at = toPixel(revealing(camera, { x: 0, y: 0 }, 40), { x: 0, y: 0 });
      expect(at.x).toBeGreaterThanOrEqual(40 - 1e-6);
      expect(at.y).toBeLessThanOrEqual(300 + 1e-6);
    }
  });

  it("takes the arrow keys as they point on the screen", () => {
    const turn = Math.PI / 2; // east lies below
    const to = stepped({ x: 0, y: 0 }, "ArrowDown", false, turn);
    expect(to?.x).toBeCloseTo(0.1);
    expect(to?.y).toBeCloseTo(0);
  });
});
