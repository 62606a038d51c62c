/** Hold a status, a robot and goals as the planner sends them. */
import type { Goal, Robot, Sight, Status, Thing, Usage } from "../src/wire/types";

const still = { v_mps: 0, w_radps: 0 };

export const status: Status = {
  robot: "r1",
  boot: "b1",
  seq: 7,
  mode: "HOLD",
  epoch: "b1-3",
  nonce: "b1.2",
  owner: { planner_id: "planner-1", kind: "planner" },
  held: null,
  base_in_map: { x_m: 1, y_m: 2, yaw_rad: 0.5 },
  asked: still,
  sent: still,
  measured: still,
  limits: { v_mps: 0.5, w_radps: 1, by: "robot", free_m: null, margin_m: null },
  rows: [],
  answers: [],
  waiting_for: [],
  blocked: false,
  operator_metres: 500,
  operator_seconds: 3600,
  drive: { kind: "sim", virtual: true, enabled: true, battery: null, real_time: false },
  ticks: { ticks: 10, missed: 0, late_p50_us: 40, late_max_us: 90, dropped: 0 },
};

export const robot: Robot = {
  status,
  room: "kitchen",
  ages_s: { status: 0.02, localization: 0.05, odometry: 0.01, scan: null },
  site: "two_room",
  map_id: "0123456789abcdef",
  localizer: "tracking",
  localizer_trouble: null,
  match: { score: 0.93, candidates: [] },
  driver: null,
  setup: { is_there: false, trial: null },
  brain: { name: "offline", breaker: null, rests_s: 0, last_error: null },
};

export function goal(id: string, state = "running", more: Partial<Goal> = {}): Goal {
  return {
    id,
    text: `go ${id}`,
    by: "page",
    stopped_by: null,
    answers: [],
    language: "en",
    state,
    reason: null,
    plan: null,
    outcome: null,
    brain: null,
    position: null,
    created: `2026-01-01T00:00:0${id.length}Z`,
    updated: "2026-01-01T00:00:00Z",
    ...more,
  };
}

export const about = {
  version: "0.1.0",
  base: { wheel_radius_m: 0.1, wheel_separation_m: 0.5, radius_m: 0.3 },
  limits: { max_speed_mps: 0.5, max_turn_radps: 1 },
};

const amounts = { calls: 3, prompt_tokens: 900, reply_tokens: 100, seconds: 4.2, money: 0.02 };

export const usage: Usage = {
  model: "m",
  resets_in_s: 60,
  currency: "USD",
  today: amounts,
  day_limits: { calls: 20, prompt_tokens: 9000, reply_tokens: 1000, seconds: 60, money: null },
  under_way: 0,
  refused: null,
};

export const cup: Thing = {
  id: "cup_1",
  label: "cup",
  name: { en: "red cup", zh: "红色的杯子" },
  color: "red",
  x_m: 1,
  y_m: 2,
  sigma_m: 0.08,
  confidence: 0.9,
  age_s: 0.2,
  room: "kitchen",
  sightings: 4,
};

export const sight: Sight = {
  version: 3,
  blind: null,
  message: null,
  look: {
    seq: 12,
    age_s: 0.1,
    width: 320,
    height: 240,
    boxes: [{ label: "cup", name: cup.name, score: 0.81, box: [10, 20, 40, 60], id: "cup_1" }],
  },
  things: [cup],
};

export const snapshot = (seq = 1): object => ({
  seq,
  kind: "snapshot",
  robot,
  goals: [goal("a"), goal("bb")],
  about,
  path: null,
  scan: [100, 200],
  obstacles: { cells: [], suspicions: [], movers: [] },
  usage,
  places_version: 0,
  sight,
});
