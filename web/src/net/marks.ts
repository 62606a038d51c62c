/** Ask the planner for what people drew on the map, and bring it what they draw. */
import type { Outline } from "../map/outline";
import type { Goal, Language } from "../wire/types";
import { call, newId } from "./api";
import type { OperatorProof } from "./proof";

export type SlowArea = { readonly polygon: Outline; readonly max_speed_mps: number };
export type Marks = {
  readonly version: 1;
  readonly map_id: string;
  readonly keep_outs: readonly Outline[];
  readonly speed_zones: readonly SlowArea[];
};
export type Marking = {
  readonly marks: Marks;
  readonly marks_hash: string | null;
  readonly agreed: boolean; // the bridge holds the same
};
export type GoalPoint = {
  readonly x_m: number;
  readonly y_m: number;
  readonly yaw_rad?: number;
  readonly look?: boolean;
};

export async function fetchMarks(): Promise<Marking> {
  return (await call("GET", "v1/marks")) as Marking;
}

/** Return the text by which the marks would be kept, which an operator signs. */
export async function checkMarks(marks: Marks): Promise<string> {
  return ((await call("POST", "v1/marks/check", { marks })) as { readonly text: string }).text;
}

/** Where the robot would leave marks that hold it, in map, and how long the way there is. */
export type MarkExit = { readonly x_m: number; readonly y_m: number; readonly metres: number };

export async function fetchExit(marks: Marks): Promise<MarkExit> {
  return (await call("POST", "v1/marks/exit", { marks })) as MarkExit;
}

export async function putMarks(
  marks: Marks,
  before: string | null,
  operator: OperatorProof | null,
): Promise<Marking> {
  const proof = operator ? { operator } : {};
  return (await call("PUT", "v1/marks", { marks, before, source: "page", ...proof })) as Marking;
}

export async function givePoints(
  points: readonly GoalPoint[],
  mapId: string,
  language: Language,
  replace: boolean,
  operator: OperatorProof | null,
): Promise<Goal> {
  const key = { "idempotency-key": newId("page") };
  const proof = operator ? { operator } : {};
  const body = { points, map_id: mapId, language, replace, source: "page", ...proof };
  return (await call("POST", "v1/goals", body, key)) as Goal;
}
