/** Find what a click on the map means: a place near it, else the room around it. Pure. */
import type { Place, Pose, Thing } from "../wire/types";

export const NEAR_M = 0.45;

export type Point = { readonly x: number; readonly y: number };

/** Return the place, not the room, that is nearest to a point within so much of it [m]. */
export function placeAt(places: readonly Place[], point: Point, withinM: number): Place | null {
  const near = places
    .filter((place) => place.kind === "place")
    .map((place) => ({
      place,
      away: Math.hypot(place.pose.x_m - point.x, place.pose.y_m - point.y),
    }))
    .filter(({ away }) => away <= withinM)
    .sort((a, b) => a.away - b.away)[0];
  return near?.place ?? null;
}

export function resolve(places: readonly Place[], point: Point): Place | null {
  const near = placeAt(places, point, NEAR_M);
  if (near) return near;
  const room = places.find(
    (place) => place.kind === "room" && place.polygon && contains(place.polygon, point),
  );
  return room ?? null;
}

export const ON_M = 0.25;

/** Return the thing that lies at a point, if one does: the nearest. */
export function thingAt(things: readonly Thing[], point: Point): Thing | null {
  const near = things
    .map((thing) => ({ thing, away: Math.hypot(thing.x_m - point.x, thing.y_m - point.y) }))
    .filter(({ away }) => away <= ON_M)
    .sort((a, b) => a.away - b.away)[0];
  return near?.thing ?? null;
}

type Standing = { readonly pose: Pose; readonly radius: number };

/** Group robots of which one stands over another's middle: their discs can't be told apart. */
export function atOneSpot<T extends Standing>(bodies: readonly T[]): [T, ...T[]][] {
  const groups: [T, ...T[]][] = [];
  for (const body of bodies) {
    const { x_m: x, y_m: y } = body.pose;
    const there = groups.find(
      ([{ pose, radius }]) => Math.hypot(pose.x_m - x, pose.y_m - y) < radius,
    );
    if (there) there.push(body);
    else groups.push([body]);
  }
  return groups;
}

/** Say whether a polygon holds a point: crossings of a ray to the right. */
export function contains(
  polygon: readonly (readonly [number, number])[],
  { x, y }: Point,
): boolean {
  let inside = false;
  for (let i = 0, j = polygon.length - 1; i < polygon.length; j = i, i += 1) {
    const [xi = 0, yi = 0] = polygon[i] ?? [];
    const [xj = 0, yj = 0] = polygon[j] ?? [];
    if (yi > y !== yj > y && x < ((xj - xi) * (y - yi)) / (yj - yi) + xi) inside = !inside;
  }
  return inside;
}

/** Return the middle of a polygon's bounding box, where its name is written. */
export function middle(polygon: readonly (readonly [number, number])[]): Point {
  const xs = polygon.map(([x]) => x);
  const ys = polygon.map(([, y]) => y);
  return {
    x: (Math.min(...xs) + Math.max(...xs)) / 2,
    y: (Math.min(...ys) + Math.max(...ys)) / 2,
  };
}

/** Return the angle nearest to `before` that points the same way, so that a turn takes no detour. */
export function unwound(before: number, degrees: number): number {
  return before + ((((degrees - before) % 360) + 540) % 360) - 180;
}
