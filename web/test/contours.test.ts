import { describe, expect, it } from "vitest";
import { Cells } from "../src/map/cells";
import * as made from "../src/map/contours";
import { contourPath, contours, simplified } from "../src/map/contours";
import { area, type Outline } from "../src/map/outline";
import type { Grid } from "../src/wire/types";
import { someNumbers } from "./numbers";

const gridOf = (rows: readonly string[]): Grid =>
  ({
    width: rows[0]?.length ?? 0,
    height: rows.length,
    resolution_m: 0.1,
    origin: { x_m: -1, y_m: 2 },
    cells: btoa([...rows].reverse().join("").replaceAll(".", "\x00").replaceAll("#", "\x01")),
  }) as Grid;
const outlines = (rows: readonly string[]) => contours(new Cells(gridOf(rows)));

/** Furniture of 3 × 3 cells and more, thrown about. */
const homes = (): string[][] =>
  Array.from({ length: 12 }, (_, seed) =>
    someNumbers(8, 9, seed + 3).flatMap((row) => {
      const line = row.map((one) => (one > 0.1 ? "###" : "...")).join("");
      return [line, line, line];
    }),
  );

/** Return an outline's area, counted negative where it runs clockwise: around a hole. */
const signed = (outline: Outline): number => {
  const turns = outline.reduce((sum, [x, y], index) => {
    const [nextX, nextY] = outline[(index + 1) % outline.length] ?? [0, 0];
    return sum + x * nextY - nextX * y;
  }, 0);
  return Math.sign(turns) * area(outline);
};

describe("outlines of what stands", () => {
  it("keep corners and straight walls where they are, in metres", () => {
    const [block, ...others] = outlines([
      "........",
      ".######.",
      ".######.",
      ".######.",
      "........",
    ]);
    expect(others).toEqual([]);
    expect(block).toHaveLength(4);
    expect(area(block ?? [])).toBeCloseTo(0.18, 9);
    expect(outlines(["...", ".#.", "..."])[0]).toHaveLength(4);
    const niche = [
      "......##",
      "......##",
      "...#####",
      "...#####",
      "...#####",
      "......##",
      "......##",
    ];
    const [wall = []] = outlines(niche);
    expect(area(wall)).toBeCloseTo(0.23, 9);
    for (const [index, [x, y]] of wall.entries()) {
      const [nextX, nextY] = wall[(index + 1) % wall.length] ?? [x, y];
      expect(Math.min(Math.abs(nextX - x), Math.abs(nextY - y))).toBeCloseTo(0, 9);
    }
    expect(outlines(["...", "..."])).toEqual([]);
  });

  it("leave holes as outlines that run the other way", () => {
    const ring = outlines(["#####", "#...#", "#...#", "#...#", "#####"]);
    expect(ring.map(signed).map(Math.sign).sort()).toEqual([-1, 1]);
  });

  it("close around every side of what stands, and enclose about as much", () => {
    for (const rows of homes()) {
      const standing = rows.join("").replaceAll(".", "").length * 0.01;
      const loops = outlines(rows);
      const enclosed = loops.reduce((sum, loop) => sum + signed(loop), 0);
      expect(Math.abs(enclosed - standing)).toBeLessThan(0.2 * standing);
      for (const loop of loops) expect(loop.length).toBeGreaterThanOrEqual(3);
    }
  });

  it("lie within a cell of the border between what stands and what does not", () => {
    for (const rows of homes()) {
      const cells = new Cells(gridOf(rows));
      for (const [x, y] of contours(cells).flat()) {
        const [column, row] = [Math.round((x + 1) / 0.1), Math.round((y - 2) / 0.1)];
        const near = [-1, 0].flatMap((dx) =>
          [-1, 0].map((dy) => cells.at(column + dx, row + dy) === 1),
        );
        expect(new Set(near).size).toBe(2);
      }
    }
  });

  it("free a slanted wall of its steps", () => {
    const wall = Array.from({ length: 30 }, (_, row) =>
      Array.from({ length: 40 }, (_, column) => (column < row + 5 ? "#" : ".")).join(""),
    );
    expect(outlines(wall)[0]?.length ?? 99).toBeLessThan(14);
    expect(simplified([], 1)).toEqual([]);
  });

  it("are worked out once for a grid, however often it is drawn", () => {
    const grid = gridOf(["....", ".##.", "...."]);
    const before = made.computed;
    const paths = Array.from({ length: 5 }, () => contourPath(grid));
    expect(made.computed).toBe(before + 1);
    expect(new Set(paths).size).toBe(1);
    expect(paths[0]).toMatch(/^M.*Q.*Z$/);
  });
});
