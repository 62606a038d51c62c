/** Say what is known of a thing, and what is in a picture, in the person's language. */
import { say, t } from "../i18n";
import { fixed, seconds } from "../panels/format";
import { nameOf } from "../panels/steps";
import type { Box, Look, Thing } from "../wire/types";

/** Younger than this it is looked at now. */
export const IN_VIEW_S = 3;

/** Return the order that a person would give to go there. */
export const orderTo = (thing: Pick<Thing, "name">): string =>
  t("objects.order", { what: say(thing.name) });

/** Write an age without tenths: it is read, not watched. */
export const wholeSeconds = (ageS: number): string =>
  ageS < 10 ? t("unit.s", { n: fixed(ageS, 0) }) : seconds(ageS);

/** Round an age down to what is shown of it: "at least" must hold. */
function floored(ageS: number): number {
  const unit = ageS < 120 ? 1 : ageS < 7200 ? 60 : 3600;
  return Math.floor(ageS / unit) * unit;
}

/** Say for how long it has been blind; "" within the first second, which tells nothing. The page
 * may have come later than the trouble. */
export const blindForWords = (ageS: number): string =>
  ageS < 1 ? "" : t("blind.for", { age: wholeSeconds(floored(ageS)) });

/** Say how old a grey picture is. */
export const pictureAgeWords = (ageS: number): string =>
  t("camera.old", { age: wholeSeconds(floored(ageS)) });

export const agoWords = (ageS: number): string =>
  ageS < IN_VIEW_S ? t("objects.now") : t("objects.ago", { age: wholeSeconds(ageS) });

export const percent = (share: number): string => fixed(share * 100, 0, "%");

/** Say whether one picture alone showed it: it may be a mistake. */
export const seenOnce = (thing: Pick<Thing, "sightings">): boolean => thing.sightings < 2;

/** Say where a thing is and how well that is known. */
export const knownWords = (thing: Thing, ageS: number): string =>
  [
    nameOf(thing.room),
    agoWords(ageS),
    seenOnce(thing) ? t("objects.once") : "",
    t("objects.sure", { share: percent(thing.confidence) }),
    t("objects.within", { metres: fixed(thing.sigma_m, 2, "m") }),
  ]
    .filter((fact) => fact !== "")
    .join(" · ");

export const boxWords = (box: Box): string => `${say(box.name)} ${percent(box.score)}`;

/** List what is in a picture. */
export const lookWords = (look: Look): string =>
  look.boxes.length === 0 ? t("camera.nothing") : look.boxes.map(boxWords).join(" · ");
