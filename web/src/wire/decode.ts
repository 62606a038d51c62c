/**
 * Turn what came over the socket into a frame, or nothing. Half frames, unknown kinds and numbers
 * that are not finite are no frames; whoever calls counts them.
 */
import type {
  Bilingual,
  BridgeEvent,
  Draft,
  Frame,
  Goal,
  Layers,
  Path,
  Progress,
  Robot,
  Scan,
  Sight,
  Status,
  Usage,
} from "./types";

type Bag = { readonly [key: string]: unknown };

const bag = (value: unknown): value is Bag =>
  typeof value === "object" && value !== null && !Array.isArray(value);
const finite = (value: unknown): value is number => Number.isFinite(value);
const text = (value: unknown): value is string => typeof value === "string";
const textOrNull = (value: unknown): boolean => value === null || text(value);
const finiteOrNull = (value: unknown): boolean => value === null || finite(value);
const all = (value: unknown, ok: (item: unknown) => boolean): boolean =>
  Array.isArray(value) && value.every(ok);

const pose = (value: unknown): boolean =>
  bag(value) && finite(value.x_m) && finite(value.y_m) && finite(value.yaw_rad);
const twist = (value: unknown): boolean =>
  bag(value) && finite(value.v_mps) && finite(value.w_radps);
const point = (value: unknown): boolean =>
  Array.isArray(value) && value.length === 2 && value.every(finite);
const words = (value: unknown): boolean => bag(value) && text(value.en) && text(value.zh);

const row = (value: unknown): boolean =>
  bag(value) &&
  text(value.row) &&
  text(value.action) &&
  text(value.evidence) &&
  finite(value.for_s);

const verdict = (value: unknown): boolean =>
  bag(value) &&
  [value.id, value.kind, value.code].every(text) &&
  typeof value.accepted === "boolean";

function isStatus(value: unknown): value is Status {
  if (!bag(value)) return false;
  const { limits, ticks, drive, held, owner } = value;
  return (
    [value.robot, value.boot, value.mode, value.epoch, value.nonce].every(text) &&
    [value.seq, value.operator_metres, value.operator_seconds].every(finite) &&
    (owner === null || (bag(owner) && text(owner.planner_id))) &&
    (held === null || (bag(held) && text(held.reason) && text(held.id))) &&
    (value.base_in_map === null || pose(value.base_in_map)) &&
    [value.asked, value.sent, value.measured].every(twist) &&
    bag(limits) &&
    twist(limits) &&
    text(limits.by) &&
    finiteOrNull(limits.free_m) &&
    all(value.rows, row) &&
    all(value.answers, verdict) &&
    all(value.waiting_for, text) &&
    bag(drive) &&
    text(drive.kind) &&
    typeof drive.virtual === "boolean" &&
    bag(ticks) &&
    [ticks.ticks, ticks.missed, ticks.late_p50_us, ticks.late_max_us].every(finite)
  );
}

const BREAKERS = new Set<unknown>(["closed", "open", "on_trial", null]);

const isMind = (value: unknown): boolean =>
  bag(value) &&
  text(value.name) &&
  BREAKERS.has(value.breaker) &&
  finite(value.rests_s) &&
  (value.last_error === null ||
    (bag(value.last_error) && text(value.last_error.code) && words(value.last_error.message)));

const isTag = (value: unknown): boolean =>
  bag(value) &&
  text(value.name) &&
  textOrNull(value.fallback_from) &&
  (value.fallback_message === null || words(value.fallback_message));

const isCandidate = (value: unknown): boolean =>
  bag(value) && pose(value.pose) && finite(value.score);
const isMatch = (value: unknown): boolean =>
  bag(value) && finite(value.score) && all(value.candidates, isCandidate);

const trialStep = (value: unknown): boolean => bag(value) && text(value.step) && text(value.seen);
const port = (value: unknown): boolean =>
  bag(value) &&
  [value.path, value.adapter, value.code, value.device].every(text) &&
  (value.cure === null || words(value.cure));

function isTrial(value: unknown): boolean {
  if (!bag(value)) return false;
  return (
    [value.robot, value.drive, value.port, value.phase, value.detail].every(text) &&
    [value.tried, value.by, value.code].every(textOrNull) &&
    [value.plan, value.wrote, value.part].every((list) => all(list, text)) &&
    all(value.steps, trialStep) &&
    finite(value.ask) &&
    [value.question, value.cure].every((said) => said === null || words(said)) &&
    (value.ports === null || all(value.ports, port))
  );
}

const isSetup = (value: unknown): boolean =>
  bag(value) &&
  typeof value.is_there === "boolean" &&
  (value.trial === null || isTrial(value.trial));

const isTrouble = (value: unknown): boolean =>
  bag(value) && text(value.code) && words(value.message);

const isDriver = (value: unknown): boolean => bag(value) && text(value.id) && text(value.name);

function isRobot(value: unknown): value is Robot {
  return (
    bag(value) &&
    (value.status === null || isStatus(value.status)) &&
    textOrNull(value.room) &&
    text(value.site) &&
    text(value.map_id) &&
    isMind(value.brain) &&
    textOrNull(value.localizer) &&
    (value.localizer_trouble === null || isTrouble(value.localizer_trouble)) &&
    (value.match === null || isMatch(value.match)) &&
    (value.driver === null || isDriver(value.driver)) &&
    isSetup(value.setup) &&
    bag(value.ages_s) &&
    Object.values(value.ages_s).every(finiteOrNull)
  );
}

const stop = (value: unknown): boolean => bag(value) && text(value.place) && words(value.said);
const step = (value: unknown): boolean =>
  bag(value) &&
  text(value.kind) &&
  text(value.state) &&
  [value.said, value.read].every((said) => said === undefined || said === null || words(said)) &&
  (value.stops === undefined || all(value.stops, stop));
const option = (value: unknown): boolean => bag(value) && text(value.text) && words(value.label);

const answer = (value: unknown): boolean =>
  bag(value) &&
  text(value.by) &&
  textOrNull(value.said) &&
  finite(value.unix_s) &&
  (value.asked === null || words(value.asked));

export function isGoal(value: unknown): value is Goal {
  if (!bag(value)) return false;
  const { plan, outcome, brain } = value;
  return (
    [value.id, value.text, value.by, value.state, value.created, value.updated].every(text) &&
    [value.reason, value.stopped_by].every(textOrNull) &&
    all(value.answers, answer) &&
    finiteOrNull(value.position) &&
    (brain === null || isTag(brain)) &&
    (plan === null ||
      (bag(plan) &&
        text(plan.kind) &&
        all(plan.steps, step) &&
        all(plan.options, option) &&
        (plan.text === null || words(plan.text)))) &&
    (outcome === null || (bag(outcome) && text(outcome.code) && words(outcome.message)))
  );
}

function progressOf(value: Bag): Progress | null {
  const { goal, step: index, left_m, left_rad, left_s } = value;
  if (!text(goal) || !finite(index)) return null;
  return {
    goal,
    step: index,
    ...(finite(left_m) ? { left_m } : {}),
    ...(finite(left_rad) ? { left_rad } : {}),
    ...(finite(left_s) ? { left_s } : {}),
  };
}

const isDraft = (value: Bag): boolean =>
  text(value.goal) &&
  text(value.text) &&
  all(value.steps, (one) => bag(one) && text(one.kind) && textOrNull(one.place ?? null));

const AMOUNTS = ["calls", "prompt_tokens", "reply_tokens", "seconds", "money"] as const;

function isUsage(value: unknown): value is Usage {
  if (!bag(value)) return false;
  const { today, day_limits: most, refused } = value;
  return (
    textOrNull(value.model) &&
    textOrNull(value.currency) &&
    finite(value.resets_in_s) &&
    finite(value.under_way) &&
    bag(today) &&
    bag(most) &&
    AMOUNTS.every((what) => finite(today[what]) && finiteOrNull(most[what])) &&
    (refused === null || (bag(refused) && text(refused.code) && words(refused.message)))
  );
}

const isDoubt = (value: unknown): boolean =>
  bag(value) && text(value.code) && words(value.message) && finite(value.x_m) && finite(value.y_m);

const isPath = (value: unknown): value is Path | null =>
  value === null ||
  (bag(value) &&
    text(value.goal) &&
    finite(value.leg) &&
    all(value.points, point) &&
    (value.doubt === null || isDoubt(value.doubt)));

const isScan = (value: unknown): value is Scan => all(value, finite);
const isMover = (value: unknown): boolean =>
  bag(value) &&
  [value.number, value.x_m, value.y_m, value.vx_mps, value.vy_mps, value.radius_m].every(finite);
const isLayers = (value: unknown): value is Layers =>
  bag(value) &&
  all(value.cells, finite) &&
  all(value.suspicions, finite) &&
  all(value.movers, isMover);

const isBox = (value: unknown): boolean =>
  bag(value) &&
  text(value.label) &&
  words(value.name) &&
  finite(value.score) &&
  Array.isArray(value.box) &&
  value.box.length === 4 &&
  value.box.every(finite) &&
  textOrNull(value.id);

const isLook = (value: unknown): boolean =>
  bag(value) &&
  [value.seq, value.age_s, value.width, value.height].every(finite) &&
  all(value.boxes, isBox);

const isThing = (value: unknown): boolean =>
  bag(value) &&
  text(value.id) &&
  text(value.label) &&
  words(value.name) &&
  textOrNull(value.color) &&
  textOrNull(value.room) &&
  [value.x_m, value.y_m, value.sigma_m, value.confidence, value.age_s].every(finite) &&
  finite(value.sightings);

const isSight = (value: unknown): value is Sight =>
  bag(value) &&
  finite(value.version) &&
  textOrNull(value.blind) &&
  (value.message === null || words(value.message)) &&
  (value.look === null || isLook(value.look)) &&
  all(value.things, isThing);

const isAbout = (value: unknown): boolean =>
  bag(value) &&
  text(value.version) &&
  bag(value.base) &&
  [value.base.wheel_radius_m, value.base.wheel_separation_m, value.base.radius_m].every(finite) &&
  bag(value.limits) &&
  finite(value.limits.max_speed_mps);

const isWords = (value: unknown): value is Bilingual =>
  bag(value) && text(value.en) && text(value.zh);

const isEvent = (value: unknown): value is BridgeEvent =>
  bag(value) && text(value.code) && text(value.mode) && text(value.detail) && finite(value.seq);

/** Return the frame, or null for anything that is none. Never throws. */
export function decode(data: unknown): Frame | null {
  const came = parsed(data);
  if (came === null || !finite(came.seq)) return null;
  const { seq } = came;
  const change = bag(came.change) ? came.change : {};
  switch (came.kind) {
    case "snapshot":
      return isRobot(came.robot) &&
        all(came.goals, isGoal) &&
        isAbout(came.about) &&
        isPath(came.path) &&
        isScan(came.scan) &&
        isLayers(came.obstacles) &&
        isUsage(came.usage) &&
        finite(came.places_version) &&
        isSight(came.sight)
        ? (came as Frame)
        : null;
    case "robot":
      return isRobot(came.robot) ? { seq, kind: "robot", robot: came.robot } : null;
    case "path":
      return isPath(came.path) ? { seq, kind: "path", path: came.path } : null;
    case "scan":
      return isScan(came.scan) ? { seq, kind: "scan", scan: came.scan } : null;
    case "obstacles":
      return isLayers(came.obstacles)
        ? { seq, kind: "obstacles", obstacles: came.obstacles }
        : null;
    case "goal":
      return isGoal(change.goal) ? { seq, kind: "goal", goal: change.goal } : null;
    case "progress": {
      const progress = progressOf(change);
      return progress && { seq, kind: "progress", progress };
    }
    case "thinking":
      return isDraft(change) ? { seq, kind: "thinking", draft: change as unknown as Draft } : null;
    case "usage":
      return isUsage(came.usage) ? { seq, kind: "usage", usage: came.usage } : null;
    case "sight":
      return isSight(came.sight) ? { seq, kind: "sight", sight: came.sight } : null;
    case "places":
      return finite(came.version) ? { seq, kind: "places", version: came.version } : null;
    case "orders":
      return finite(change.version) ? { seq, kind: "orders", version: change.version } : null;
    case "told":
      return isWords(change.message) && text(change.kind) && text(change.code)
        ? { seq, kind: "told", about: change.kind, code: change.code, words: change.message }
        : null;
    case "say":
      return text(change.text)
        ? { seq, kind: "say", text: change.text, language: change.language === "zh" ? "zh" : "en" }
        : null;
    case "act":
      return text(change.code)
        ? { seq, kind: "act", accepted: change.accepted === true, code: change.code }
        : null;
    case "bridge":
      return isEvent(change.event) ? { seq, kind: "bridge", event: change.event } : null;
    case "first_waypoint":
      return finite(change.seconds)
        ? { seq, kind: "first_waypoint", seconds: change.seconds }
        : null;
    case "gap":
      return { seq, kind: "gap" };
    case "stopped":
      return { seq, kind: "stopped", confirmed: came.confirmed === true };
    case "problem":
      return text(came.code) && text(came.detail)
        ? { seq, kind: "problem", code: came.code, detail: came.detail }
        : null;
    default:
      return null;
  }
}

function parsed(data: unknown): Bag | null {
  if (!text(data)) return null;
  try {
    const value: unknown = JSON.parse(data);
    return bag(value) ? value : null;
  } catch {
    return null;
  }
}
