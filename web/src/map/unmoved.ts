/** Say whether what is drawn still shows what is so, as far as eyes on a map can tell. Pure. */
import type { Pose, Scan } from "../wire/types";

/** About a pixel of a home that fills the map. */
export const SEEN_M = 0.015;
export const SEEN_RAD = 0.02;
/** A dot is as wide; a lidar's own noise is less. */
export const SEEN_CM = 7;
/** Of the points, so many may flicker at the edge of what the lidar reaches. */
const STRAYS = 0.02;
/** Points come in the order of their angles; so many may be missing in a row. */
const SEARCHED = 12;

export function samePose(kept: Pose | null, next: Pose | null): boolean {
  if (kept === null || next === null) return kept === next;
  const turn = next.yaw_rad - kept.yaw_rad;
  return (
    Math.hypot(next.x_m - kept.x_m, next.y_m - kept.y_m) <= SEEN_M &&
    Math.abs(Math.atan2(Math.sin(turn), Math.cos(turn))) <= SEEN_RAD
  );
}

/** Hold two scans for the same where each point of either has one of the other beside it. */
export const sameScan = (kept: Scan, next: Scan): boolean =>
  kept === next || (strays(next, kept) && strays(kept, next));

/** Say whether few enough points of a scan lie away from all of another's. */
function strays(points: Scan, others: Scan): boolean {
  const most = STRAYS * (points.length / 2);
  let [from, count] = [0, 0];
  for (let index = 0; index + 1 < points.length; index += 2) {
    const found = beside(points[index] ?? 0, points[index + 1] ?? 0, others, from);
    if (found >= 0) from = Math.max(0, found - 4);
    else if ((count += 1) > most) return false;
  }
  return true;
}

function beside(x: number, y: number, others: Scan, from: number): number {
  const to = Math.min(others.length - 1, from + 2 * SEARCHED);
  for (let index = from; index < to; index += 2) {
    const [dx, dy] = [(others[index] ?? 0) - x, (others[index + 1] ?? 0) - y];
    if (dx * dx + dy * dy <= SEEN_CM * SEEN_CM) return index;
  }
  return -1;
}
