/** Hold what the robot sees as people read it: the things it knows, and why it is blind. */
import { computed } from "@preact/signals";
import { say, word } from "../i18n";
import { since, type Moment } from "../state/moment";
import { steady } from "../state/steady";
import { blindAt, known, now, sight } from "../state/store";
import type { Look, Thing } from "../wire/types";
import { blindForWords, knownWords, orderTo, seenOnce } from "./words";

/** Old or doubtful things are told from those that are surely there. */
const FAINT_S = 600;
const FAINT_BELOW = 0.4;
const SEEN_M = 0.03;

const placed = ({ id, color, name, x_m, y_m }: Thing): unknown => [
  id,
  color,
  name,
  Math.round(x_m / SEEN_M),
  Math.round(y_m / SEEN_M),
];

/** The things as a map shows them: the same list while nothing has moved that one could see. */
export const things = steady(
  () => known.value.map(({ thing }) => thing),
  (kept, next) => JSON.stringify(kept.map(placed)) === JSON.stringify(next.map(placed)),
);

/** Why nothing is seen now, by its code; null while all is well or nobody has said. */
export const blind = computed(() => sight.value?.blind ?? null);
export const blindWords = computed(() => {
  if (blind.value === null) return "";
  const message = sight.value?.message;
  return message ? say(message) : word("blind", blind.value);
});

/** For how long it is blind so, in words that change once a second; "" while it sees. */
export const blindFor = computed(() =>
  blindAt.value === null ? "" : blindForWords(since(blindAt.value, now.value)),
);

/** Boxes of an older look would lie beside what has moved on. */
const OLDEST_LOOK_S = 1;

/** A look that is shown, and when it came. */
export type Drawn = { readonly look: Look; readonly at: Moment };

/** Return the look whose boxes may be shown now, if one is young enough. */
export function boxed(drawn: Drawn | null, why: string | null, at: Moment): Look | null {
  if (drawn === null || why !== null) return null;
  return drawn.look.age_s + since(drawn.at, at) <= OLDEST_LOOK_S ? drawn.look : null;
}

/** Say whether there is a camera at all. */
export const hasCamera = computed(() => sight.value !== null && blind.value !== "no_camera");

export type Row = {
  readonly id: string;
  readonly color: string | null;
  readonly what: string;
  readonly order: string;
  readonly known: string;
  readonly faint: boolean;
};

/** The list as it reads, by name; its ages go on by themselves. */
export const rows = steady(() =>
  known.value
    .map(({ thing, at }) => rowOf(thing, thing.age_s + since(at, now.value)))
    .sort((a, b) => a.what.localeCompare(b.what) || a.id.localeCompare(b.id)),
);

const rowOf = (thing: Thing, ageS: number): Row => ({
  id: thing.id,
  color: thing.color,
  what: say(thing.name),
  order: orderTo(thing),
  known: knownWords(thing, ageS),
  faint: ageS > FAINT_S || thing.confidence < FAINT_BELOW || seenOnce(thing),
});
