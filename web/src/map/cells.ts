/** Read a map's cells: what is known, what stands there, and where a name may be written. Pure. */
import type { Grid, Place } from "../wire/types";
import { contains, middle, type Point } from "./resolve";

export const FREE = 0;
export const OCCUPIED = 1;

export type Box = {
  readonly left: number;
  readonly bottom: number;
  readonly right: number;
  readonly top: number;
};

/** Hold a grid's cells, a byte each, its first row the lowest y. */
export class Cells {
  readonly bytes: Uint8Array;

  constructor(readonly grid: Grid) {
    this.bytes = Uint8Array.from(atob(grid.cells), (one) => one.charCodeAt(0));
  }

  /** Say whether there are as many cells as the grid says. */
  get whole(): boolean {
    return this.bytes.length === this.grid.width * this.grid.height;
  }

  at(column: number, row: number): number | undefined {
    if (column < 0 || row < 0 || column >= this.grid.width) return undefined;
    return this.bytes[row * this.grid.width + column];
  }

  /** Return how much floor is known [m²]. */
  get floor(): number {
    const size = this.grid.resolution_m;
    return this.bytes.reduce((sum, cell) => sum + (cell === FREE ? size * size : 0), 0);
  }

  /** Return the middle of a cell [m]. */
  point(column: number, row: number): Point {
    const { origin, resolution_m: size } = this.grid;
    return { x: origin.x_m + (column + 0.5) * size, y: origin.y_m + (row + 0.5) * size };
  }

  /** Return the box around all that is known [m]; the whole grid where nothing is. */
  known(): Box {
    const { width, height, origin, resolution_m: size } = this.grid;
    let [left, bottom, right, top] = [width, height, 0, 0];
    this.bytes.forEach((cell, index) => {
      if (cell !== FREE && cell !== OCCUPIED) return;
      const [column, row] = [index % width, Math.floor(index / width)];
      [left, right] = [Math.min(left, column), Math.max(right, column + 1)];
      [bottom, top] = [Math.min(bottom, row), Math.max(top, row + 1)];
    });
    if (right <= left) [left, bottom, right, top] = [0, 0, width, height];
    return {
      left: origin.x_m + left * size,
      bottom: origin.y_m + bottom * size,
      right: origin.x_m + right * size,
      top: origin.y_m + top * size,
    };
  }

  /** Count what stands within a box [cells]. */
  standing(box: Box): number {
    const { origin, resolution_m: size } = this.grid;
    let count = 0;
    for (let y = box.bottom; y <= box.top; y += 2 * size) {
      for (let x = box.left; x <= box.right; x += 2 * size) {
        const cell = this.at(
          Math.floor((x - origin.x_m) / size),
          Math.floor((y - origin.y_m) / size),
        );
        if (cell !== FREE) count += 1;
      }
    }
    return count;
  }
}

const STEP_M = 0.2;
const NAME_HALF_M = { x: 0.85, y: 0.3 }; // half of what a room's name covers
const MARK_HALF_M = { x: 0.75, y: 0.35 }; // half of what a place's dot and name cover

const around = ({ x, y }: Point, half: { readonly x: number; readonly y: number }): Box => ({
  left: x - half.x,
  bottom: y - half.y,
  right: x + half.x,
  top: y + half.y,
});

const overlap = (a: Box, b: Box): number =>
  Math.max(0, Math.min(a.right, b.right) - Math.max(a.left, b.left)) *
  Math.max(0, Math.min(a.top, b.top) - Math.max(a.bottom, b.bottom));

/**
 * Return where a room's name is written: where it covers least furniture and fewest other names,
 * and, of such spots, the one nearest to the room's middle.
 */
export function nameSpot(room: Place, places: readonly Place[], cells: Cells | null): Point {
  const outline = room.polygon;
  if (outline === null) return { x: room.pose.x_m, y: room.pose.y_m };
  const home = middle(outline);
  if (cells === null) return home;
  const marks = places
    .filter((place) => place.kind === "place")
    .map((place) => around({ x: place.pose.x_m, y: place.pose.y_m - 0.15 }, MARK_HALF_M));
  const xs = outline.map(([x]) => x);
  const ys = outline.map(([, y]) => y);
  let best = { spot: home, cost: Number.POSITIVE_INFINITY };
  for (let y = Math.min(...ys) + STEP_M; y < Math.max(...ys); y += STEP_M) {
    for (let x = Math.min(...xs) + STEP_M; x < Math.max(...xs); x += STEP_M) {
      const spot = { x, y };
      if (!contains(outline, spot)) continue;
      const box = around(spot, NAME_HALF_M);
      const hidden =
        cells.standing(box) + 60 * marks.reduce((sum, one) => sum + overlap(box, one), 0);
      const cost = 4 * hidden + Math.hypot(x - home.x, y - home.y);
      if (cost < best.cost) best = { spot, cost };
    }
  }
  return best.spot;
}
