/** Show how well lidar and map agree, beside what is needed. */
import { t } from "../i18n";
import { candidates, matchShare, poseLost } from "../state/store";
import { percent } from "./format";

/** A scan that fits less is no proof of a place (localization's own measure, as its refusals say). */
export const ENOUGH = 0.6;

export function Match() {
  const share = matchShare.value;
  if (share === null || poseLost.value !== null) return null;
  return (
    <div class="match" id="match">
      <meter min={0} max={1} low={ENOUGH} optimum={1} value={share} aria-label={t("match.label")} />
      <span>{t("match.share", { share: percent(share), least: percent(ENOUGH) })}</span>
    </div>
  );
}

/** Say how far the search has come; the places stand on the map. */
export function Guesses() {
  const best = candidates.value[0];
  if (!best) return null;
  return (
    <span class="guesses" id="guesses">
      {t("match.guesses", {
        n: String(candidates.value.length),
        share: percent(best.score),
      })}
    </span>
  );
}
