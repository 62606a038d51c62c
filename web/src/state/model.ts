/**
 * Hold what the page knows, and how each frame changes it. Pure: told the time, knows no socket and
 * no screen. What an unknown or broken frame may change is a counter.
 */
import type {
  About,
  Bilingual,
  Draft,
  Frame,
  Goal,
  Language,
  Layers,
  Path,
  Robot,
  Scan,
  Sight,
  Usage,
} from "../wire/types";
import { ended, withProgress } from "./goals";
import { type Moment, since } from "./moment";
import { type KnownThing, retold } from "./things";

export const MAX_GOALS = 60;
export const MAX_LOG = 200;

export type LogEntry = {
  readonly id: number;
  readonly at: number; // Date.now(), to show
  readonly kind: "bridge" | "say" | "act" | "planner" | "told";
  readonly code: string;
  readonly text: string;
  readonly words?: Bilingual; // of what the planner told in both languages
};

/** Words that the robot speaks; a new object each time. */
export type Spoken = { readonly text: string; readonly language: Language };

/** What was told of a standing order; `id` rises with each. */
export type Told = { readonly id: number; readonly words: Bilingual; readonly bad: boolean };

/** The planner's answer to a stop over the socket; a new object each time. */
export type StopAnswer = { readonly confirmed: boolean };

export type Model = {
  readonly robot: Robot | null;
  readonly robotAt: Moment | null;
  readonly goals: readonly Goal[]; // open ones first, each newest first
  readonly drafts: readonly Draft[]; // of goals that are thought about now
  readonly usage: Usage | null;
  readonly placesVersion: number; // changes when a place is taught or forgotten
  readonly ordersVersion: number; // changes with the standing orders, and with a new connection
  readonly told: Told | null; // of a standing order, the newest
  readonly sight: Sight | null;
  readonly sightAt: Moment | null;
  readonly blindAt: Moment | null; // when this page first heard that it is blind so
  readonly things: readonly KnownThing[];
  readonly about: About | null;
  readonly path: Path | null;
  readonly scan: Scan;
  readonly scanAt: Moment | null;
  readonly layers: Layers;
  readonly log: readonly LogEntry[]; // newest first
  readonly stopAnswer: StopAnswer | null;
  readonly spoken: Spoken | null;
  readonly seq: number; // of the newest frame of this connection; 0 before the first
  readonly ignored: number; // frames that were none
  readonly gaps: number; // times that frames were missed
  readonly wantsSnapshot: boolean;
};

export const EMPTY: Model = {
  robot: null,
  robotAt: null,
  goals: [],
  drafts: [],
  usage: null,
  placesVersion: 0,
  ordersVersion: 0,
  told: null,
  sight: null,
  sightAt: null,
  blindAt: null,
  things: [],
  about: null,
  path: null,
  scan: [],
  layers: { cells: [], suspicions: [], movers: [] },
  scanAt: null,
  log: [],
  stopAnswer: null,
  spoken: null,
  seq: 0,
  ignored: 0,
  gaps: 0,
  wantsSnapshot: false,
};

/** Return since when it is blind for the same reason, as far as this page has heard. */
function blindSince(model: Model, sight: Sight, now: Moment): Moment | null {
  if (sight.blind === null) return null;
  return sight.blind === model.sight?.blind ? model.blindAt : now;
}

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
        goals: openFirst(frame.goals),
        drafts: thoughtAbout(model.drafts, frame.goals),
        usage: frame.usage,
        placesVersion: frame.places_version,
        ordersVersion: model.ordersVersion + 1,
        sight: frame.sight,
        sightAt: now,
        blindAt: blindSince(model, frame.sight, now),
        things: retold(model.things, frame.sight.things, now),
        about: frame.about,
        path: frame.path,
        scan: frame.scan,
        scanAt: now,
        layers: frame.obstacles,
        wantsSnapshot: false,
      };
    case "robot":
      return { ...model, robot: frame.robot, robotAt: now };
    case "path":
      return { ...model, path: frame.path };
    case "scan":
      return { ...model, scan: frame.scan, scanAt: now };
    case "obstacles":
      return { ...model, layers: frame.obstacles };
    case "goal":
      return {
        ...model,
        goals: withGoal(model.goals, frame.goal),
        drafts: thoughtAbout(model.drafts, [frame.goal]),
      };
    case "progress":
      return { ...model, goals: withProgress(model.goals, frame.progress) };
    case "thinking":
      return { ...model, drafts: withDraft(model.drafts, frame.draft) };
    case "usage":
      return { ...model, usage: frame.usage };
    case "sight": {
      const things = retold(model.things, frame.sight.things, now);
      const blindAt = blindSince(model, frame.sight, now);
      return { ...model, sight: frame.sight, sightAt: now, blindAt, things };
    }
    case "places":
      return { ...model, placesVersion: frame.version };
    case "orders":
      return { ...model, ordersVersion: model.ordersVersion + 1 };
    case "told": {
      const bad = frame.about === "missed" || frame.about === "failed";
      const told = { id: (model.told?.id ?? 0) + 1, words: frame.words, bad };
      return { ...logged(model, "told", frame.code, "", now, frame.words), told };
    }
    case "gap":
      return { ...model, gaps: model.gaps + 1, wantsSnapshot: true };
    case "stopped":
      return { ...model, stopAnswer: { confirmed: frame.confirmed } };
    case "say":
      return {
        ...logged(model, "say", "say", frame.text, now),
        spoken: { text: frame.text, language: frame.language },
      };
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
  words?: Bilingual,
): Model {
  const id = (model.log[0]?.id ?? 0) + 1;
  const said = words === undefined ? {} : { words };
  const entry: LogEntry = { id, at: now.wallMs, kind, code, text, ...said };
  return { ...model, log: [entry, ...model.log].slice(0, MAX_LOG) };
}

const MAX_DRAFTS = 8;
const MAX_SHOWN = 4000;

function withDraft(drafts: readonly Draft[], draft: Draft): readonly Draft[] {
  const short = { ...draft, text: draft.text.slice(-MAX_SHOWN) };
  return [short, ...drafts.filter((one) => one.goal !== draft.goal)].slice(0, MAX_DRAFTS);
}

/** Drop the drafts of goals that went on; one that is thought about again is told anew. */
function thoughtAbout(drafts: readonly Draft[], goals: readonly Goal[]): readonly Draft[] {
  const done = new Set(goals.filter((goal) => goal.state !== "planning").map((goal) => goal.id));
  return drafts.some((draft) => done.has(draft.goal))
    ? drafts.filter((draft) => !done.has(draft.goal))
    : drafts;
}

export function withGoal(goals: readonly Goal[], goal: Goal): readonly Goal[] {
  return openFirst([goal, ...goals.filter((known) => known.id !== goal.id)]);
}

/** Put open goals before those that ended, each newest first: no open one ever drops out. */
function openFirst(goals: readonly Goal[]): readonly Goal[] {
  // ISO times in UTC sort as text; equal ones keep their order.
  const later = (a: Goal, b: Goal) => (a.created < b.created ? 1 : a.created > b.created ? -1 : 0);
  return [...goals]
    .sort((a, b) => Number(ended(a)) - Number(ended(b)) || later(a, b))
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
