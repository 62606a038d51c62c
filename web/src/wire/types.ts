/** Name what the planner sends: the part of it that this page reads. Types only. */

export type Language = "en" | "zh";
export type Bilingual = { readonly en: string; readonly zh: string };

export type Pose = { readonly x_m: number; readonly y_m: number; readonly yaw_rad: number };
export type Twist = { readonly v_mps: number; readonly w_radps: number };

export type Row = {
  readonly row: string;
  readonly action: string;
  readonly for_s: number;
  readonly evidence: string;
  readonly binding: boolean;
};

export type Limits = {
  readonly v_mps: number;
  readonly w_radps: number;
  readonly by: string;
  readonly free_m: number | null;
  readonly margin_m: number | null;
};

export type Ticks = {
  readonly ticks: number;
  readonly missed: number;
  readonly late_p50_us: number;
  readonly late_max_us: number;
  readonly dropped: number;
};

/** The bridge's verdict on one request, or on a hello or a grant. */
export type Answer = {
  readonly id: string;
  readonly kind: string;
  readonly accepted: boolean;
  readonly code: string;
};

/** The bridge's word, as wire/status.py has it. */
export type Status = {
  readonly robot: string;
  readonly boot: string;
  readonly seq: number;
  readonly mode: string;
  readonly epoch: string;
  readonly nonce: string;
  readonly marks_hash?: string | null; // of what people drew on the map, as the bridge holds it
  readonly owner: { readonly planner_id: string; readonly kind: string } | null;
  readonly held: { readonly reason: string; readonly id: string } | null;
  readonly base_in_map: Pose | null;
  readonly asked: Twist;
  readonly sent: Twist;
  readonly measured: Twist;
  readonly limits: Limits;
  readonly rows: readonly Row[];
  readonly answers: readonly Answer[];
  readonly waiting_for: readonly string[];
  readonly blocked: boolean;
  readonly operator_metres: number;
  readonly operator_seconds: number;
  readonly drive: {
    readonly kind: string;
    readonly virtual: boolean;
    readonly enabled: boolean;
    readonly battery: number | null;
    readonly real_time: boolean;
  };
  readonly ticks: Ticks;
};

export type Ages = { readonly [source: string]: number | null };

/** Who plans: a model behind its breaker, or the offline brain alone (no breaker). */
export type Mind = {
  readonly name: string;
  readonly breaker: "closed" | "open" | "on_trial" | null;
  readonly rests_s: number;
  readonly last_error: { readonly code: string; readonly message: Bilingual } | null;
};

/** A place where a search found that a scan fits. */
export type Candidate = { readonly pose: Pose; readonly score: number };

/** How well the newest scan fits the map, -1 to 1; candidates, best first, while there is no pose. */
export type Match = { readonly score: number; readonly candidates: readonly Candidate[] };

/** One serial port and what answers there. */
export type Port = {
  readonly path: string;
  readonly adapter: string;
  readonly code: string;
  readonly device: string;
  readonly cure: Bilingual | null;
};

/** All of set-up, as wire/trial_dialogue.py has it. */
export type Trial = {
  readonly robot: string;
  readonly drive: string;
  readonly port: string;
  readonly tried: string | null;
  readonly phase: string;
  readonly by: string | null;
  readonly plan: readonly string[];
  readonly steps: readonly { readonly step: string; readonly seen: string }[];
  readonly ask: number;
  readonly question: Bilingual | null;
  readonly code: string | null;
  readonly detail: string;
  readonly cure: Bilingual | null;
  readonly wrote: readonly string[];
  readonly ports: readonly Port[] | null;
  readonly part: readonly string[];
};

/** Whether set-up can be had here, and how its trial stands: null while a bridge drives. */
export type Setup = { readonly is_there: boolean; readonly trial: Trial | null };

export type Robot = {
  readonly status: Status | null;
  readonly room: string | null;
  readonly ages_s: Ages;
  readonly site: string;
  readonly map_id: string;
  /** What the localizer does; null where none speaks. */
  readonly localizer: "searching" | "tracking" | "coasting" | "lost" | null;
  /** Why it has no pose and what helps, where it knows that. */
  readonly localizer_trouble: { readonly code: string; readonly message: Bilingual } | null;
  readonly match: Match | null;
  /** Whose hand steers now. */
  readonly driver: { readonly id: string; readonly name: string } | null;
  readonly setup: Setup;
  readonly brain: Mind;
};

export type PictureBill = {
  readonly pictures: number;
  readonly pictures_most: number;
  readonly tokens: number;
  readonly tokens_most: number;
  readonly money: number | null;
  readonly money_most: number | null;
  readonly currency: string | null;
};

export type Step = {
  readonly kind: string;
  readonly place: string | null;
  readonly places: readonly string[];
  readonly object: string | null;
  readonly text: string | null;
  readonly seconds: number | null;
  readonly angle_rad: number | null;
  readonly distance_m: number | null;
  readonly state: string;
  readonly code?: string | null;
  readonly reached: Spot | null;
  readonly residual_m: number | null;
  readonly residual_rad: number | null;
  readonly moved_m: number | null;
  readonly turned_rad: number | null;
  readonly visited: number | null;
  readonly bill: PictureBill | null; // what a search by the vision model costs
  readonly answer: string | null;
  readonly left_m: number | null;
  readonly left_rad: number | null;
  readonly left_s: number | null;
  readonly reason: string | null;
  readonly said: Bilingual | null; // what a step that looks came to
  readonly read: Bilingual | null; // what a model said of the picture: for people alone
  readonly depth: number; // in how many other steps it stands
  readonly role: string | null; // what it is to the step that holds it
  readonly times: number | null; // rounds of a repeat, at most
  readonly round: number; // which of them runs, or was the last
  readonly holds: boolean | null; // of a condition: what it came to
  readonly look?: boolean; // a point is faced from near by
  readonly x_m?: number | null; // a point of the map that a person gave [m]
  readonly y_m?: number | null;
  readonly side?: string | null; // of a place or thing, at which to stand
  readonly tool?: string | null; // of a server of the owner's
  readonly arguments?: readonly string[];
  readonly word: string | null;
  readonly time: string | null;
  readonly after: string | null;
  readonly before: string | null;
  readonly stops?: readonly Stop[]; // of a patrol that looks: what came of each that is over
};

/** What a patrol saw at one of its stops. */
export type Stop = { readonly place: string; readonly said: Bilingual; readonly shut: boolean };

export type Option = { readonly label: Bilingual; readonly text: string };

export type Plan = {
  readonly kind: string;
  readonly steps: readonly Step[];
  readonly code: string | null;
  readonly text: Bilingual | null;
  readonly options: readonly Option[];
};

export type Spot = {
  readonly place: string | null;
  readonly room: string | null;
  readonly x_m: number | null;
  readonly y_m: number | null;
};

export type Outcome = {
  readonly code: string;
  readonly message: Bilingual;
  readonly asked: Spot | null;
  readonly reached: Spot | null;
  readonly metres: number | null;
  readonly seconds: number | null;
  readonly limited_by: readonly string[];
};

/** Which brain planned a goal, and which one it stood in for, if it did. */
export type Tag = {
  readonly name: string;
  readonly version: string;
  readonly fallback_from: string | null;
  readonly fallback_reason: string | null;
  readonly fallback_message: Bilingual | null;
};

/** A question of a goal, and what a person answered; null: a yes by a button. */
export type GoalAnswer = {
  readonly asked: Bilingual | null;
  readonly said: string | null;
  readonly by: string;
  readonly unix_s: number;
};

export type Goal = {
  readonly id: string;
  readonly text: string;
  readonly by: string; // the door that it came through
  readonly stopped_by: string | null;
  readonly answers: readonly GoalAnswer[];
  readonly language: string;
  readonly state: string;
  readonly reason: string | null;
  readonly plan: Plan | null;
  readonly outcome: Outcome | null;
  readonly brain: Tag | null;
  readonly position: number | null;
  readonly created: string;
  readonly updated: string;
};

/** What is left of a goal's running step. */
export type Progress = {
  readonly goal: string;
  readonly step: number;
  readonly left_m?: number;
  readonly left_rad?: number;
  readonly left_s?: number;
};

/** What a model has cost; null limits are none. */
export type Usage = {
  readonly model: string | null;
  readonly resets_in_s: number;
  readonly currency: string | null;
  readonly today: Amounts;
  readonly day_limits: { readonly [what in keyof Amounts]: number | null };
  readonly under_way: number;
  readonly refused: { readonly code: string; readonly message: Bilingual } | null;
};

export type Amounts = {
  readonly calls: number;
  readonly prompt_tokens: number;
  readonly reply_tokens: number;
  readonly seconds: number;
  readonly money: number;
};

/** What a brain has written of a plan so far: shown, never obeyed. */
export type Draft = {
  readonly goal: string;
  readonly text: string;
  readonly steps: readonly DraftStep[];
};

/** A step as a brain writes it: what is not set is not there. */
export type DraftStep = Pick<Step, "kind"> & Partial<Step>;

export type About = {
  readonly version: string;
  readonly base: {
    readonly wheel_radius_m: number;
    readonly wheel_separation_m: number;
    readonly radius_m: number;
  };
  readonly limits: { readonly max_speed_mps: number; readonly max_turn_radps: number };
};

/** Why a way bends, or goes on towards something, and where that stands. */
export type Doubt = {
  readonly code: string;
  readonly message: Bilingual;
  readonly x_m: number;
  readonly y_m: number;
};

export type Path = {
  readonly goal: string;
  readonly leg: number;
  readonly points: readonly (readonly [number, number])[];
  readonly doubt: Doubt | null;
};

/** What was found in a picture: left, top, right, bottom in its pixels, y down. */
export type Box = {
  readonly label: string;
  readonly name: Bilingual;
  readonly score: number;
  readonly box: readonly [number, number, number, number];
  readonly id: string | null; // the thing on the map that it is
};

/** One picture that was thought upon. */
export type Look = {
  readonly seq: number;
  readonly age_s: number; // when it was told
  readonly width: number;
  readonly height: number;
  readonly boxes: readonly Box[];
};

/** A thing that the robot remembers; its name says its colour too. */
export type Thing = {
  readonly id: string;
  readonly label: string;
  readonly name: Bilingual;
  readonly color: string | null;
  readonly x_m: number;
  readonly y_m: number;
  readonly sigma_m: number;
  readonly confidence: number;
  readonly age_s: number;
  readonly room: string | null;
  /** Pictures that it was in; one alone may be a mistake. */
  readonly sightings: number;
};

/** What eyes report: `things` are those of which there is news, `version` counts their coming and going. */
export type Sight = {
  readonly version: number;
  readonly blind: string | null;
  readonly message: Bilingual | null;
  readonly look: Look | null;
  readonly things: readonly Thing[];
};

/** All things that are remembered. */
export type Objects = { readonly version: number; readonly objects: readonly Thing[] };

/** x, y, x, y, … in map, centimetres. */
export type Scan = readonly number[];

export type BridgeEvent = {
  readonly seq: number;
  readonly code: string;
  readonly mode: string;
  readonly detail: string;
};

export type Frame = { readonly seq: number } & (
  | {
      readonly kind: "snapshot";
      readonly robot: Robot;
      readonly goals: readonly Goal[];
      readonly about: About;
      readonly path: Path | null;
      readonly scan: Scan;
      readonly obstacles: Layers;
      readonly usage: Usage;
      readonly places_version: number;
      readonly sight: Sight;
    }
  | { readonly kind: "robot"; readonly robot: Robot }
  | { readonly kind: "path"; readonly path: Path | null }
  | { readonly kind: "scan"; readonly scan: Scan }
  | { readonly kind: "obstacles"; readonly obstacles: Layers }
  | { readonly kind: "goal"; readonly goal: Goal }
  | { readonly kind: "progress"; readonly progress: Progress }
  | { readonly kind: "thinking"; readonly draft: Draft }
  | { readonly kind: "usage"; readonly usage: Usage }
  | { readonly kind: "sight"; readonly sight: Sight }
  | { readonly kind: "places"; readonly version: number }
  | { readonly kind: "orders"; readonly version: number }
  | {
      readonly kind: "told"; // what became of a standing order
      readonly about: string;
      readonly code: string;
      readonly words: Bilingual;
    }
  | { readonly kind: "say"; readonly text: string; readonly language: Language }
  | { readonly kind: "act"; readonly accepted: boolean; readonly code: string }
  | { readonly kind: "bridge"; readonly event: BridgeEvent }
  | { readonly kind: "first_waypoint"; readonly seconds: number }
  | { readonly kind: "gap" }
  | { readonly kind: "stopped"; readonly confirmed: boolean }
  | { readonly kind: "problem"; readonly code: string; readonly detail: string }
);

export type Place = {
  readonly id: string;
  readonly kind: "room" | "place";
  readonly name: Bilingual;
  readonly polygon: readonly (readonly [number, number])[] | null;
  readonly pose: Pose;
};

/** A place that a person taught; `why_not` where it can't be driven to. */
export type Taught = {
  readonly id: string;
  readonly name: Bilingual;
  readonly pose: Pose;
  readonly map_id: string;
  readonly by: string;
  readonly taught: string;
  readonly why_not: string | null;
  readonly message: Bilingual | null;
};

/** A room that was cut out of the map; `known_as` is the place that has its middle. */
export type ProposedRoom = {
  readonly id: string;
  readonly polygon: Outline;
  readonly pose: Pose;
  readonly area_m2: number;
  readonly known_as: string | null;
};

export type Known = {
  readonly version: number;
  readonly places: readonly Place[];
  readonly taught: readonly Taught[];
  readonly proposed_rooms: readonly ProposedRoom[];
  readonly most: number;
};

export type Mover = {
  readonly number: number;
  readonly x_m: number;
  readonly y_m: number;
  readonly vx_mps: number;
  readonly vy_mps: number;
  readonly radius_m: number;
};

/** What the route search remembers that the map does not know: middles of cells as x, y, … [cm]. */
export type Layers = {
  readonly cells: readonly number[];
  readonly suspicions: readonly number[];
  readonly movers: readonly Mover[];
};

export type Outline = readonly (readonly [number, number])[];

export type Grid = {
  readonly map_id: string;
  readonly width: number;
  readonly height: number;
  readonly resolution_m: number;
  readonly origin: { readonly x_m: number; readonly y_m: number };
  readonly cells: string;
  /** While a home is mapped: what is known so far, counted; else null. */
  readonly growing: {
    readonly revision: number;
    readonly keyframes: number;
    readonly loops: number;
  } | null;
  readonly fence: {
    readonly allowed: readonly Outline[];
    readonly keep_outs: readonly Outline[];
    readonly speed_zones: readonly { readonly polygon: Outline; readonly max_speed_mps: number }[];
  };
};

/** One thing remembered: seen between two times, or told at one. */
export type Memory = {
  readonly id: number;
  readonly kind: "thing" | "person" | "fact";
  readonly words: string | null;
  readonly name: Bilingual | null;
  readonly on: Bilingual | null;
  readonly room: string | null;
  readonly first_unix_s: number;
  readonly last_unix_s: number;
  readonly fits: boolean;
};

/** A picture that a patrol kept of one of its stops. */
export type KeptPicture = {
  readonly id: number;
  readonly goal: string;
  readonly step: number;
  readonly stop: number;
  readonly place: string;
  readonly names: readonly Bilingual[];
};

/** What a model wrote in one turn, its keys cut out. */
export type ModelReply = {
  readonly at: string;
  readonly model: string;
  readonly turn: string;
  readonly text: string;
  readonly cut: boolean;
  readonly used: boolean;
};

/** What a model wrote about a goal; of so many goals at most it is kept. */
export type GoalReplies = { readonly kept: number; readonly replies: readonly ModelReply[] };

export type Memories = { readonly memories: readonly Memory[] };

/** A standing order, as the planner shows it. */
export type StandingOrder = {
  readonly id: string;
  readonly text: string;
  readonly when: Bilingual;
  readonly does: Bilingual;
  readonly rule: { readonly event?: string };
  readonly may: readonly { readonly kind: string }[]; // the plan that was told when it was kept
  readonly state: "active" | "paused" | "ended";
  readonly resumes: string | null; // where it was put off, until when
  readonly next: string | null; // on the robot's own clock
  readonly fired: number;
  readonly missed: number;
};

/** One run of it, or several that were missed together. */
export type Firing = {
  readonly serial: number;
  readonly due: string;
  readonly state: "begun" | "given" | "ended" | "missed" | "quiet";
  readonly reason: string | null;
  readonly code: string | null;
  readonly count: number;
  readonly told: Bilingual | null;
};

/** One run of a standing order, as the conversation tells it. */
export type OrderRun = Firing & {
  readonly order: string;
  readonly text: string;
  readonly goal: string | null;
  readonly at: string;
};

export type StandingOrders = {
  readonly timezone: string;
  readonly quiet: string | null;
  readonly most: number;
  readonly orders: readonly StandingOrder[];
};

export type PersonRole = "operator" | "viewer" | "dispatcher" | "agent";

export type Person = {
  readonly id: string;
  readonly name: string;
  readonly role: PersonRole;
  readonly since: string;
};

export type NewPerson = Person & { readonly token: string };
