/** Know the plane geometry of points and outlines that a person gives on the map. Pure. */
import type { Point } from "./resolve";

export type Corner = readonly [number, number];
export type Outline = readonly Corner[];

export const MIN_AREA_M2 = 0.01;
export const MAX_CORNERS = 100;

/** Return the heading from one point to another [rad]; null where they are one. */
export function headingTo(from: Point, to: Point): number | null {
  const [dx, dy] = [to.x - from.x, to.y - from.y];
  return Math.hypot(dx, dy) < 0.05 ? null : Math.atan2(dy, dx);
}

/** Return an outline's area by the shoelace formula [m²]. */
export function area(outline: Outline): number {
  let doubled = 0;
  outline.forEach(([x, y], index) => {
    const [nextX, nextY] = outline[(index + 1) % outline.length] ?? [0, 0];
    doubled += x * nextY - nextX * y;
  });
  return Math.abs(doubled) / 2;
}

const side = (a: Corner, b: Corner, p: Corner): number =>
  (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);

function cross(a: Corner, b: Corner, c: Corner, d: Corner): boolean {
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

/** Say whether two sides of an outline cross; a bridge that is asked says the same, more exactly. */
export function crossesItself(outline: Outline): boolean {
  const count = outline.length;
  const sides = outline.map((corner, index): [Corner, Corner] => [
    corner,
    outline[(index + 1) % count] ?? corner,
  ]);
  return sides.some(([a, b], one) =>
    sides.some(([c, d], other) => other > one + 1 && cross(a, b, c, d)),
  );
}

export type Flaw = "few" | "many" | "crosses" | "small";

/** Return what is wrong with an outline; null where nothing is. */
export function flawOf(outline: Outline): Flaw | null {
  if (!(outline.length >= 3)) return "few";
  if (!(outline.length <= MAX_CORNERS)) return "many";
  if (crossesItself(outline)) return "crosses";
  return area(outline) >= MIN_AREA_M2 ? null : "small";
}

export const rounded = ([x, y]: Corner): Corner => [
  Math.round(x * 1e3) / 1e3,
  Math.round(y * 1e3) / 1e3,
];

/** Return the number of the corner that is nearest to a point, within so much of it [m]; null for none. */
export function cornerAt(outline: Outline, { x, y }: Point, withinM: number): number | null {
  const away = outline.map((corner) => Math.hypot(corner[0] - x, corner[1] - y));
  const least = Math.min(...away);
  return least <= withinM ? away.indexOf(least) : null;
}

export const withCorner = (outline: Outline, index: number, { x, y }: Point): Outline =>
  outline.map((corner, at) => (at === index ? rounded([x, y]) : corner));

/** Return an outline with one corner more, in the side that is nearest to it. */
export function withCornerBetween(outline: Outline, { x, y }: Point): Outline {
  const longer = outline.map((from, index) => {
    const to = outline[(index + 1) % outline.length] ?? from;
    const by = Math.hypot(from[0] - x, from[1] - y) + Math.hypot(to[0] - x, to[1] - y);
    return by - Math.hypot(to[0] - from[0], to[1] - from[1]);
  });
  const side = longer.indexOf(Math.min(...longer));
  return [...outline.slice(0, side + 1), rounded([x, y]), ...outline.slice(side + 1)];
}

const STEPS: Readonly<Record<string, Corner>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};
export const STEP_M = 0.1;
export const STRIDE_M = 0.5;

/**
 * Return where an arrow key moves a point to, as the arrow points on a map that is turned so far
 * clockwise [rad]; null for any other key.
 */
export function stepped(from: Point, key: string, far: boolean, turn = 0): Point | null {
  const step = STEPS[key];
  if (!step) return null;
  const by = far ? STRIDE_M : STEP_M;
  const [cos, sin] = [Math.cos(turn), Math.sin(turn)];
  return {
    x: from.x + by * (step[0] * cos - step[1] * sin),
    y: from.y + by * (step[0] * sin + step[1] * cos),
  };
}

export const TRAIL_M = 0.1;
export const TRAIL_MOST = 600;

/** Return the trail with where the robot is now, where it has moved on; the oldest is let go. */
export function withTrail(trail: Outline, { x, y }: Point): Outline {
  const last = trail.at(-1);
  if (last && Math.hypot(x - last[0], y - last[1]) < TRAIL_M) return trail;
  return [...trail.slice(1 - TRAIL_MOST), [x, y]];
}

/** Return how long the rest of a way takes at the speed of late [s]; null where it stands. */
export function timeToGo(leftM: number, speedMps: number): number | null {
  return leftM >= 0 && speedMps > 0.02 ? leftM / speedMps : null;
}
