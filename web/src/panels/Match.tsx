/** Show how well lidar and map agree, beside what is needed. */
import { t } from "../i18n";
import { candidates, matchShare, poseLost } from "../state/store";
import { percent } from "./format";

/** A pose that is tracked is kept while so much of a scan agrees (KEPT_SCORE of localization.quality). */
export const KEPT = 0.5;
/** A scan that fits less places no robot anew; below it the gauge changes its colour. */
const ENOUGH = 0.6;

export function Match() {
  const share = matchShare.value;
  if (share === null || poseLost.value !== null) return null;
  return (
    <div class="match" id="match">
      <meter min={0} max={1} low={ENOUGH} optimum={1} value={share} aria-label={t("match.label")} />
      <span>{t("match.share", { share: percent(share), least: percent(KEPT) })}</span>
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
