/** Keep the things that the robot remembers, each with the moment of the newest word of it. Pure. */
import type { Thing } from "../wire/types";
import type { Moment } from "./moment";

export type KnownThing = { readonly thing: Thing; readonly at: Moment };

/** Take a whole list: what is not in it is known no more. */
export const listed = (things: readonly Thing[], at: Moment): readonly KnownThing[] =>
  things.map((thing) => ({ thing, at }));

/** Take word of some things; the others stay and grow old. */
export function retold(
  known: readonly KnownThing[],
  things: readonly Thing[],
  at: Moment,
): readonly KnownThing[] {
  if (things.length === 0) return known;
  const told = new Set(things.map(({ id }) => id));
  return [...known.filter(({ thing }) => !told.has(thing.id)), ...listed(things, at)];
}
