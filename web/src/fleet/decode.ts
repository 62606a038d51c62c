/** Read what the fleet tells. What robots said stands in it and may be anything: it becomes text or goes. */
import type { Option } from "../panels/QuestionForm";
import type { Bilingual, Grid, Place, Pose } from "../wire/types";

/** A robot as GET /v1/page tells it; the service has judged each field. */
export type Robot = {
  readonly name: string;
  readonly url: string;
  readonly state: string;
  readonly is_silent: boolean;
  readonly heard_unix_s: number | null;
  readonly message: Bilingual | null;
  readonly mission: string | null;
  readonly unstopped: boolean;
  readonly mode: string | null;
  readonly room: string | null;
  readonly battery: number | null;
  readonly base_in_map: Pose | null;
  readonly radius_m: number;
  readonly site: string | null;
  readonly release: string | null;
  readonly map: string | null;
  readonly map_trouble: string | null;
};

export type Asking = {
  readonly words: Bilingual | null;
  readonly confirms: boolean;
  readonly options: readonly Option[];
};

export type Mission = {
  readonly id: string;
  readonly text: string;
  readonly state: string;
  readonly robot: string | null;
  readonly reason: string | null;
  readonly goalState: string | null;
  readonly atUnixS: number;
  readonly message: Bilingual | null;
  readonly question: Asking | null;
};

/** Who has confirmed a stop; id is empty where the fleet could not write it down. */
export type Told = {
  readonly id: string;
  readonly confirmed: readonly string[];
  readonly not_reached: readonly string[];
  readonly message: Bilingual;
};

export type Feed = {
  readonly you: string;
  readonly robots: readonly Robot[];
  readonly missions: readonly Mission[];
  readonly next: number;
  readonly stop: Told | null;
};

/** A map with the places on it. */
export type FleetGrid = Grid & { readonly places: readonly Place[] };

const MOST_CHARACTERS = 2000;
const MOST_OPTIONS = 12;

type Fields = Readonly<Record<string, unknown>>;

const fields = (told: unknown): Fields =>
  typeof told === "object" && told !== null && !Array.isArray(told) ? (told as Fields) : {};
const list = (told: unknown): readonly unknown[] => (Array.isArray(told) ? told : []);
const text = (told: unknown): string | null =>
  typeof told === "string" ? told.slice(0, MOST_CHARACTERS) : null;

/** Return words in both languages, the one for the other where one is missing; null: there are none. */
export function bilingual(told: unknown): Bilingual | null {
  const { en, zh } = typeof told === "string" ? { en: told, zh: told } : fields(told);
  const [english, chinese] = [text(en), text(zh)];
  const any = english ?? chinese;
  return any === null ? null : { en: english ?? any, zh: chinese ?? any };
}

function asking(told: unknown): Asking | null {
  if (told === null || told === undefined) return null;
  const { text: words, kind, options } = fields(told);
  const offered = list(options)
    .slice(0, MOST_OPTIONS)
    .flatMap((one): Option[] => {
      const answer = text(fields(one).text);
      const label = bilingual(fields(one).label);
      return answer === null ? [] : [{ text: answer, label: label ?? { en: answer, zh: answer } }];
    });
  return { words: bilingual(words), confirms: kind === "awaiting_confirmation", options: offered };
}

export function mission(told: unknown): Mission | null {
  const one = fields(told);
  const [id, state] = [text(one.id), text(one.state)];
  if (id === null || state === null) return null;
  return {
    id,
    state,
    text: text(one.text) ?? "",
    robot: text(one.robot),
    reason: text(one.reason),
    goalState: text(one.goal_state),
    atUnixS: typeof one.created_unix_s === "number" ? one.created_unix_s : 0,
    message: bilingual(one.message),
    question: asking(one.question),
  };
}

export const missions = (told: unknown): readonly Mission[] =>
  list(told)
    .map(mission)
    .filter((one) => one !== null);

export function feed(told: unknown): Feed {
  const { you, robots, missions: changed, next, stop } = fields(told);
  return {
    you: text(you) ?? "viewer",
    robots: list(robots) as readonly Robot[],
    missions: missions(changed),
    next: typeof next === "number" ? next : 0,
    stop: (stop as Told | null | undefined) ?? null,
  };
}
