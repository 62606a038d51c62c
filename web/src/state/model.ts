/**
 * Hold what the page knows, and how each frame changes it. Pure: told the time, knows no socket and
 * no screen. What an unknown or broken frame may change is a counter.
 */
import type { About, Frame, Goal, Path, Robot, Scan } from "../wire/types";
import { type Moment, since } from "./moment";

export const MAX_GOALS = 60;
export const MAX_LOG = 200;

export type LogEntry = {
  readonly id: number;
  readonly at: number; // Date.now(), to show
  readonly kind: "bridge" | "say" | "act" | "planner";
  readonly code: string;
  readonly text: string;
};

/** The planner's answer to a stop over the socket; a new object each time. */
export type StopAnswer = { readonly confirmed: boolean };

export type Model = {
  readonly robot: Robot | null;
  readonly robotAt: Moment | null;
  readonly goals: readonly Goal[]; // newest first
  readonly about: About | null;
  readonly path: Path | null;
  readonly scan: Scan;
  readonly scanAt: Moment | null;
  readonly log: readonly LogEntry[]; // newest first
  readonly stopAnswer: StopAnswer | null;
  readonly seq: number; // of the newest frame of this connection; 0 before the first
  readonly ignored: number; // frames that were none
  readonly gaps: number; // times that frames were missed
  readonly wantsSnapshot: boolean;
};

export const EMPTY: Model = {
  robot: null,
  robotAt: null,
  goals: [],
  about: null,
  path: null,
  scan: [],
  scanAt: null,
  log: [],
  stopAnswer: null,
  seq: 0,
  ignored: 0,
  gaps: 0,
  wantsSnapshot: false,
};

/** Begin a new connection: seq counts anew, what was known stays and grows old. */
export function connected(model: Model): Model {
  return { ...model, seq: 0, wantsSnapshot: false };
}

/** Take one frame; null is something that was no frame. */
export function advance(model: Model, frame: Frame | null, now: Moment): Model {
  if (frame === null) return { ...model, ignored: model.ignored + 1 };
  const missed = model.seq > 0 && frame.seq !== model.seq + 1;
  const counted: Model = {
    ...model,
    seq: frame.seq,
    gaps: model.gaps + (missed ? 1 : 0),
    wantsSnapshot: model.wantsSnapshot || missed,
  };
  return take(counted, frame, now);
}

function take(model: Model, frame: Frame, now: Moment): Model {
  switch (frame.kind) {
    case "snapshot":
      return {
        ...model,
        robot: frame.robot,
        robotAt: now,
        goals: newestFirst(frame.goals),
        about: frame.about,
        path: frame.path,
        scan: frame.scan,
        scanAt: now,
        wantsSnapshot: false,
      };
    case "robot":
      return { ...model, robot: frame.robot, robotAt: now };
    case "path":
      return { ...model, path: frame.path };
    case "scan":
      return { ...model, scan: frame.scan, scanAt: now };
    case "goal":
      return { ...model, goals: withGoal(model.goals, frame.goal) };
    case "gap":
      return { ...model, gaps: model.gaps + 1, wantsSnapshot: true };
    case "stopped":
      return { ...model, stopAnswer: { confirmed: frame.confirmed } };
    case "say":
      return logged(model, "say", "say", frame.text, now);
    case "act":
      return frame.accepted ? model : logged(model, "act", frame.code, "", now);
    case "bridge":
      return logged(model, "bridge", frame.event.code, frame.event.detail, now);
    case "problem":
      return logged(model, "planner", frame.code, frame.detail, now);
    case "first_waypoint":
      return model;
  }
}

function logged(
  model: Model,
  kind: LogEntry["kind"],
  code: string,
  text: string,
  now: Moment,
): Model {
  const id = (model.log[0]?.id ?? 0) + 1;
  const entry: LogEntry = { id, at: now.wallMs, kind, code, text };
  return { ...model, log: [entry, ...model.log].slice(0, MAX_LOG) };
}

export function withGoal(goals: readonly Goal[], goal: Goal): readonly Goal[] {
  return newestFirst([goal, ...goals.filter((known) => known.id !== goal.id)]);
}

function newestFirst(goals: readonly Goal[]): readonly Goal[] {
  // ISO times in UTC sort as text; equal ones keep their order.
  return [...goals]
    .sort((a, b) => (a.created < b.created ? 1 : a.created > b.created ? -1 : 0))
    .slice(0, MAX_GOALS);
}

/** Return a source's age now [s]: what the planner said, and the time since. Null: never heard. */
export function ageOf(model: Model, source: string, now: Moment): number | null {
  if (model.robotAt === null) return null;
  const waited = since(model.robotAt, now);
  if (source === "page") return waited;
  const said = model.robot?.ages_s[source];
  return typeof said === "number" ? said + waited : null;
}
