/**
 * Turn what stands on a map's cells into outlines: traced along the sides of the cells, freed of their
 * steps, and with corners rounded by a cell. Pure; worked out once for a grid.
 */
import { Cells, OCCUPIED } from "./cells";
import type { Corner, Outline } from "./outline";
import type { Grid } from "../wire/types";

/** The steps of a wall at 45 degrees lie 0.71 cells from its line; a cell would make corners of circles. */
export const TOLERANCE_CELLS = 0.75;

const known = new WeakMap<Grid, string>();
/** How often outlines were worked out: a frame must not. */
export let computed = 0;

/** Return the outlines of all that stands on a grid as a path in metres, its holes left out (evenodd). */
export function contourPath(grid: Grid): string {
  const kept = known.get(grid);
  if (kept !== undefined) return kept;
  const path = contours(new Cells(grid))
    .map((loop) => rounded(loop, grid.resolution_m))
    .join("");
  known.set(grid, path);
  return path;
}

/** Return the closed outlines of all that stands, in metres. */
export function contours(cells: Cells): readonly Outline[] {
  computed += 1;
  const { origin, resolution_m: size } = cells.grid;
  return traced(cells).map((loop) =>
    simplified(loop, TOLERANCE_CELLS).map(([column, row]): Corner => [
      origin.x_m + column * size,
      origin.y_m + row * size,
    ]),
  );
}

/** The sides of a cell as steps, what stands on their left: along the bottom, right, top and left. */
const STEPS = [
  [1, 0],
  [0, 1],
  [-1, 0],
  [0, -1],
] as const;

/** Return the corners of the cells around all that stands, in order [cells]. */
function traced(cells: Cells): Outline[] {
  const { width, height } = cells.grid;
  const wide = width + 1;
  const standing = (column: number, row: number): boolean => cells.at(column, row) === OCCUPIED;
  const left = new Map<number, number>(); // a side by its begin and step: the same number once
  const begin = (column: number, row: number, step: number): void => {
    const [x, y] = [column + (step === 1 || step === 2 ? 1 : 0), row + (step >= 2 ? 1 : 0)];
    const key = (y * wide + x) * 4 + step;
    left.set(key, key);
  };
  for (let row = 0; row < height; row += 1) {
    for (let column = 0; column < width; column += 1) {
      if (!standing(column, row)) continue;
      if (!standing(column, row - 1)) begin(column, row, 0);
      if (!standing(column + 1, row)) begin(column, row, 1);
      if (!standing(column, row + 1)) begin(column, row, 2);
      if (!standing(column - 1, row)) begin(column, row, 3);
    }
  }
  const loops: Outline[] = [];
  for (const first of left.keys()) {
    const loop: Corner[] = [];
    let key: number | undefined = first;
    while (key !== undefined && left.delete(key)) {
      const step: number = key % 4;
      const [dx, dy] = STEPS[step] ?? STEPS[0];
      const [x, y] = [Math.floor(key / 4) % wide, Math.floor(key / 4 / wide)];
      loop.push([x, y]);
      const at: number = ((y + dy) * wide + x + dx) * 4;
      // Cells that touch by a corner alone are two: the left turn comes first.
      key = [step + 1, step, step + 3]
        .map((next) => at + (next % 4))
        .find((next) => left.has(next));
    }
    if (loop.length > 0) loops.push(loop);
  }
  return loops;
}

const distance = ([px, py]: Corner, [ax, ay]: Corner, [bx, by]: Corner): number => {
  const [dx, dy] = [bx - ax, by - ay];
  const length = dx * dx + dy * dy;
  const share =
    length === 0 ? 0 : Math.min(1, Math.max(0, ((px - ax) * dx + (py - ay) * dy) / length));
  return Math.hypot(px - ax - share * dx, py - ay - share * dy);
};

/** Return a closed outline without the corners that lie so near to the line between others. */
export function simplified(loop: Outline, tolerance: number): Outline {
  const start = loop[0];
  if (start === undefined || loop.length <= 4) return loop;
  const away = loop.map(([x, y]) => Math.hypot(x - start[0], y - start[1]));
  const far = away.indexOf(Math.max(...away));
  const kept = new Set([0, far]);
  const open: [number, number][] = [
    [0, far],
    [far, loop.length],
  ];
  for (let span = open.pop(); span !== undefined; span = open.pop()) {
    const [from, to] = span;
    const [a, b] = [loop[from] ?? start, loop[to % loop.length] ?? start];
    let [most, at] = [tolerance, -1];
    for (let index = from + 1; index < to; index += 1) {
      const off = distance(loop[index] ?? start, a, b);
      if (off > most) [most, at] = [off, index];
    }
    if (at < 0) continue;
    kept.add(at);
    open.push([from, at], [at, to]);
  }
  const shape = loop.filter((_, index) => kept.has(index));
  return shape.length >= 3 ? shape : loop; // a line a cell wide keeps its sides
}

const text = (value: number): string => String(Math.round(value * 1e3) / 1e3);

/** Return an outline as a path whose corners are rounded within so much of them. */
function rounded(outline: Outline, within: number): string {
  const count = outline.length;
  let path = "";
  outline.forEach((corner, index) => {
    const before = outline[(index + count - 1) % count] ?? corner;
    const after = outline[(index + 1) % count] ?? corner;
    const towards = ([x, y]: Corner): string => {
      const [dx, dy] = [x - corner[0], y - corner[1]];
      const share = Math.min(within / Math.max(Math.hypot(dx, dy), 1e-9), 0.5);
      return `${text(corner[0] + share * dx)} ${text(corner[1] + share * dy)}`;
    };
    const cut = `${text(corner[0])} ${text(corner[1])} ${towards(after)}`;
    path += `${index === 0 ? "M" : "L"}${towards(before)}Q${cut}`;
  });
  return `${path}Z`;
}
