/** Hold what a person points at on the map, and do what they choose to do with it. */
import { computed, effect, signal } from "@preact/signals";
import { language, say, t } from "../i18n";
import type { Grip } from "../map/gestures";
import {
  cornerAt,
  flawOf,
  type Outline,
  rounded,
  withCorner,
  withCornerBetween,
  withTrail,
} from "../map/outline";
import { contains, type Point } from "../map/resolve";
import {
  checkMarks,
  fetchExit,
  fetchMarks,
  type GoalPoint,
  givePoints,
  type MarkExit,
  type Marking,
  type Marks,
  putMarks,
} from "../net/marks";
import { ApiError, movePlace } from "../net/api";
import { proveGoal, proveText } from "../net/proof";
import type { Place } from "../wire/types";
import { attempt } from "./acts";
import { tell } from "./note";
import { grid, isBusy, status } from "./store";

/** The point whose menu is open. */
export const menu = signal<Point | null>(null);
/** The point to which a heading is being given. */
export const facing = signal<Point | null>(null);
/** Where the arrow keys have brought the crosshair; null: nobody uses them. */
export const crosshair = signal<Point | null>(null);
/** Points to be driven to in a row. */
export const row = signal<readonly GoalPoint[]>([]);
export type Drawn = {
  readonly kind: "keep_out" | "slow";
  readonly corners: Outline;
  /** The outline in force that this one is to take the place of; it stays in force until then. */
  readonly insteadOf?: Outline;
  /** Where the robot leaves the outline, which holds it. */
  readonly exit?: MarkExit | null;
  /** The robot was sent out; the outline is saved once it stands outside. */
  readonly leaves?: boolean;
};
/** The outline that is being drawn. */
export const drawn = signal<Drawn | null>(null);
export const slowMps = signal(0.2);
/** A place that is being moved, and where to. */
export type Moving = { readonly place: Place; readonly to: Point };
export const moving = signal<Moving | null>(null);
export const marking = signal<Marking | null>(null);
export const saving = signal(false);
/** Where the robot was since this page was opened. */
export const trail = signal<Outline>([]);

/** How fast it drives of late [m/s]. */
export const pace = signal(0);
const PACE_SHARE = 0.05; // of each status: a few seconds count

export const marksShown = computed(() => marking.value?.marks ?? null);

/** Let no choice on the map stay open. */
export function closeAll(): void {
  menu.value = facing.value = moving.value = null;
}

/** Keep the marks as the planner has them, and the trail; return what ends it. */
export function startPointing(): () => void {
  let seen: string | null | undefined;
  const ends = [
    effect(() => {
      const now = status.value?.marks_hash ?? null;
      if (status.value === null || now === seen) return;
      seen = now;
      void loadMarks();
    }),
    effect(() => {
      const now = status.value;
      if (now?.mode === "ACTIVE") {
        const before = pace.peek();
        pace.value = before + PACE_SHARE * (Math.abs(now.measured.v_mps) - before);
      }
    }),
    effect(() => {
      const now = status.value;
      const pose = now?.base_in_map;
      if (!drawn.value?.leaves || !pose || now.mode === "ACTIVE") return;
      if (contains(drawn.value.corners, { x: pose.x_m, y: pose.y_m })) return;
      drawn.value = { ...drawn.value, leaves: false };
      void saveOutline();
    }),
    effect(() => {
      const pose = status.value?.base_in_map;
      if (pose) trail.value = withTrail(trail.peek(), { x: pose.x_m, y: pose.y_m });
    }),
  ];
  return () => {
    for (const end of ends) end();
  };
}

export async function loadMarks(): Promise<void> {
  try {
    marking.value = await fetchMarks();
  } catch {
    // the next status that names other marks asks again
  }
}

export async function goTo(points: readonly GoalPoint[], replace: boolean): Promise<boolean> {
  const map = grid.value?.map_id;
  closeAll();
  if (!map) return false;
  const went = await attempt(() =>
    givePoints(points, map, language.value, replace, proveGoal(status.value)),
  );
  if (went) tell(t("point.sent"));
  return went;
}

export function addToRow(point: GoalPoint): void {
  row.value = [...row.value, point];
  closeAll();
}

export function beginOutline(kind: Drawn["kind"], { x, y }: Point): void {
  drawn.value = { kind, corners: [rounded([x, y])] };
  closeAll();
}

export function addCorner(point: Point): void {
  const now = drawn.value;
  if (!now) return;
  const corners = now.insteadOf
    ? withCornerBetween(now.corners, point)
    : [...now.corners, rounded([point.x, point.y])];
  drawn.value = { ...now, corners };
}

/** Return what drags the corner near a point, if an outline is being drawn and has one there. */
export function gripCorner(point: Point, withinM: number): Grip | null {
  const before = drawn.value;
  const index = before && cornerAt(before.corners, point, withinM);
  if (before === null || index === null) return null;
  const move = (to: Point): void => {
    drawn.value = { ...before, corners: withCorner(before.corners, index, to) };
  };
  return { move, drop: () => undefined, cancel: () => (drawn.value = before) };
}

/** Move the corner that is nearest to a point there. */
export function bringCorner(point: Point): void {
  gripCorner(point, Number.POSITIVE_INFINITY)?.move(point);
}

export function undoCorner(): void {
  const now = drawn.value;
  if (!now) return;
  const corners = now.corners.slice(0, -1);
  drawn.value = corners.length > 0 ? { ...now, corners } : null;
}

const nothing = (): Marks | null => {
  const map = grid.value?.map_id;
  return map ? { version: 1, map_id: map, keep_outs: [], speed_zones: [] } : null;
};

/** Return the marks with an outline that was drawn, in place of the one that it changes. */
export function withDrawn(before: Marks, now: Drawn, speedMps: number): Marks {
  const others = (outline: Outline): boolean =>
    JSON.stringify(outline) !== JSON.stringify(now.insteadOf);
  if (now.kind === "keep_out")
    return { ...before, keep_outs: [...before.keep_outs.filter(others), now.corners] };
  const zone = { polygon: now.corners, max_speed_mps: speedMps };
  const zones = before.speed_zones.filter(({ polygon }) => others(polygon));
  return { ...before, speed_zones: [...zones, zone] };
}

/** Put the outline that was drawn in force. */
export async function saveOutline(): Promise<void> {
  const now = drawn.value;
  const before = marksShown.value ?? nothing();
  if (!now || !before || flawOf(now.corners) !== null) return;
  if (await save(withDrawn(before, now, slowMps.value))) {
    drawn.value = null;
    tell(t("marks.saved"));
  }
}

/** Send the robot out of the outline that holds it; the outline counts once it stands outside. */
export async function sendOut(): Promise<void> {
  const to = drawn.value?.exit;
  if (!to || !(await goTo([{ x_m: to.x_m, y_m: to.y_m }], isBusy.value)) || !drawn.value) return;
  drawn.value = { ...drawn.value, exit: null, leaves: true };
}

/** Find the way out for a robot that marks hold and return null; throws what else refused them. */
async function seeExit(refused: unknown, marks: Marks): Promise<null> {
  if (!(refused instanceof ApiError) || refused.code !== "mark_holds_robot") throw refused;
  const exit = await fetchExit(marks);
  if (drawn.value) drawn.value = { ...drawn.value, exit, leaves: false };
  return null;
}

/** Take a mark's outline up to be changed; it stays in force until the other is saved. */
export function changeMark(kind: Drawn["kind"], index: number): void {
  const now = marksShown.value;
  const zone = now?.speed_zones[index];
  const corners = kind === "keep_out" ? now?.keep_outs[index] : zone?.polygon;
  if (!corners) return;
  closeAll();
  if (kind === "slow" && zone) slowMps.value = zone.max_speed_mps;
  drawn.value = { kind, corners, insteadOf: corners };
}

export async function deleteMark(kind: Drawn["kind"], index: number): Promise<void> {
  const now = marksShown.value;
  if (!now) return;
  const others = <T>(list: readonly T[]): readonly T[] => list.filter((_, at) => at !== index);
  const marks: Marks =
    kind === "keep_out"
      ? { ...now, keep_outs: others(now.keep_outs) }
      : { ...now, speed_zones: others(now.speed_zones) };
  if (await save(marks)) tell(t("marks.deleted"));
}

/** Return what drags a place; let go, it is taught there, and refused it stays where it was. */
export function gripPlace(place: Place): Grip {
  const drag = (to: Point): void => {
    moving.value = { place, to };
  };
  return {
    move: drag,
    drop: (to) => {
      drag(to);
      void dropPlace();
    },
    cancel: closeAll,
  };
}

/** Teach the place that is being moved where it was brought; what refuses it says why. */
export async function dropPlace(): Promise<void> {
  const now = moving.value;
  if (!now) return;
  const [x, y] = rounded([now.to.x, now.to.y]);
  const pose = { ...now.place.pose, x_m: x, y_m: y };
  const went = await attempt(async () => {
    await movePlace(now.place, pose);
    return undefined;
  });
  if (went) tell(t("places.moved", { name: say(now.place.name) }));
  if (moving.value?.place === now.place) moving.value = null;
}

async function save(marks: Marks): Promise<boolean> {
  if (saving.value) return false;
  saving.value = true;
  let saved = false;
  const went = await attempt(async () => {
    const text = await checkMarks(marks).catch((error: unknown) => seeExit(error, marks));
    if (text === null) return undefined; // the map's tools offer the way out
    const proof = proveText("marks", text, status.value);
    marking.value = await putMarks(marks, marking.value?.marks_hash ?? null, proof);
    saved = true;
    return undefined;
  });
  if (!went) await loadMarks();
  saving.value = false;
  return saved;
}
