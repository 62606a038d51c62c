/** Hold what a person points at on the map, and do what they choose to do with it. */
import { computed, effect, signal } from "@preact/signals";
import { language, t } from "../i18n";
import { flawOf, type Outline, rounded, timeToGo, withTrail } from "../map/outline";
import type { Point } from "../map/resolve";
import {
  checkMarks,
  fetchMarks,
  type GoalPoint,
  givePoints,
  type Marking,
  type Marks,
  putMarks,
} from "../net/marks";
import { proveGoal, proveText } from "../net/proof";
import { attempt, tell } from "./acts";
import { goals, grid, status } from "./store";

/** The point whose menu is open. */
export const menu = signal<Point | null>(null);
/** The point to which a heading is being given. */
export const facing = signal<Point | null>(null);
/** Where the arrow keys have brought the crosshair; null: nobody uses them. */
export const crosshair = signal<Point | null>(null);
/** Points to be driven to in a row. */
export const row = signal<readonly GoalPoint[]>([]);
export type Drawn = { readonly kind: "keep_out" | "slow"; readonly corners: Outline };
/** The outline that is being drawn. */
export const drawn = signal<Drawn | null>(null);
export const slowMps = signal(0.2);
export const marking = signal<Marking | null>(null);
export const saving = signal(false);
/** Where the robot was since this page was opened. */
export const trail = signal<Outline>([]);

/** How fast it drives of late [m/s]. */
export const pace = signal(0);
const PACE_SHARE = 0.05; // of each status: a few seconds count

/** What is left of the step that drives now: metres, and seconds at the speed of late. */
export const toGo = computed(() => {
  const running = goals.value.find((goal) => goal.state === "running");
  const left = running?.plan?.steps.find((step) => step.state === "running")?.left_m ?? null;
  return left === null ? null : { left, seconds: timeToGo(left, pace.value) };
});

export const marksShown = computed(() => marking.value?.marks ?? null);

/** Let no choice on the map stay open. */
export function closeAll(): void {
  menu.value = facing.value = null;
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

export async function goTo(points: readonly GoalPoint[], replace: boolean): Promise<void> {
  const map = grid.value?.map_id;
  closeAll();
  if (!map) return;
  const went = await attempt(() =>
    givePoints(points, map, language.value, replace, proveGoal(status.value)),
  );
  if (went) tell(t("point.sent"));
}

export function addToRow(point: GoalPoint): void {
  row.value = [...row.value, point];
  closeAll();
}

export function beginOutline(kind: Drawn["kind"], { x, y }: Point): void {
  drawn.value = { kind, corners: [rounded([x, y])] };
  closeAll();
}

export function addCorner({ x, y }: Point): void {
  const now = drawn.value;
  if (now) drawn.value = { ...now, corners: [...now.corners, rounded([x, y])] };
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

/** Put the outline that was drawn in force. */
export async function saveOutline(): Promise<void> {
  const now = drawn.value;
  const before = marksShown.value ?? nothing();
  if (!now || !before || flawOf(now.corners) !== null) return;
  const polygon = now.corners;
  const marks: Marks =
    now.kind === "keep_out"
      ? { ...before, keep_outs: [...before.keep_outs, polygon] }
      : {
          ...before,
          speed_zones: [...before.speed_zones, { polygon, max_speed_mps: slowMps.value }],
        };
  if (await save(marks)) {
    drawn.value = null;
    tell(t("marks.saved"));
  }
}

/** Delete a mark; `again` takes its outline up to be drawn otherwise. */
export async function deleteMark(kind: Drawn["kind"], index: number, again = false): Promise<void> {
  const now = marksShown.value;
  if (!now) return;
  const others = <T>(list: readonly T[]): readonly T[] => list.filter((_, at) => at !== index);
  const corners = kind === "keep_out" ? now.keep_outs[index] : now.speed_zones[index]?.polygon;
  const marks: Marks =
    kind === "keep_out"
      ? { ...now, keep_outs: others(now.keep_outs) }
      : { ...now, speed_zones: others(now.speed_zones) };
  if (!(await save(marks))) return;
  if (again && corners) drawn.value = { kind, corners };
  else tell(t("marks.deleted"));
}

async function save(marks: Marks): Promise<boolean> {
  if (saving.value) return false;
  saving.value = true;
  const went = await attempt(async () => {
    const text = await checkMarks(marks);
    const proof = proveText("marks", text, status.value);
    marking.value = await putMarks(marks, marking.value?.marks_hash ?? null, proof);
    return undefined;
  });
  if (!went) await loadMarks();
  saving.value = false;
  return went;
}
