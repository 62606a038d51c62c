/** Show the Stop button, on every view, and what the bridge has said to it. */
import { t } from "../i18n";
import { seconds, steadySpeed } from "../panels/format";
import { isGate, limitWords } from "../panels/steps";
import { age, bridgeFresh, shownStatus } from "../state/store";
import { headlineNow, linkNow } from "../state/facts";
import { motion, type Tone } from "../state/headline";
import { steady } from "../state/steady";
import { isTrying } from "../state/trial";
import type { StopState } from "./machine";
import { StopButton } from "./StopButton";
import { stop, stopState } from "./stopper";

export function StopBar() {
  const state = stopState.value;
  return (
    <footer class="stopbar">
      <StopButton word={t("stop.button")} keys={t("stop.keys")} stop={stop} />
      <div class="stop-says">
        <p class={`stop-state ${tone(state)}`} role="alert" id="stop-state">
          {says(state)}
        </p>
        <Motion />
      </div>
    </footer>
  );
}

function tone(state: StopState): string {
  if (state.phase === "confirmed") return "good";
  if (state.phase === "unconfirmed") return "bad";
  return state.phase === "asking" && state.doubtful ? "bad" : "";
}

function says(state: StopState): string {
  switch (state.phase) {
    case "idle":
      return "";
    case "asking":
      return state.doubtful ? t("stop.doubt") : t("stop.asking");
    case "confirmed":
      return t("stop.confirmed", { ms: String(Math.round(state.tookMs)) });
    case "unconfirmed":
      return t("stop.unconfirmed");
  }
}

const PLAIN: ReadonlySet<Tone> = new Set(["good", "busy"]);

/** What is said of the robot's motion, and what bounds it; null before the bridge has been heard. */
const motionNow = steady(() => {
  const said = shownStatus.value;
  if (said === null) return null;
  const how = motion(said.measured.v_mps, said.measured.w_radps);
  const moves = t(`motion.${how}`, { speed: steadySpeed(said.measured.v_mps) });
  const { word, tone } = headlineNow.value;
  const stands = how === "standing";
  const told = linkNow.value === "live" && (stands ? tone !== "good" : !PLAIN.has(tone));
  const { v_mps, by } = said.limits;
  return {
    tone: told ? tone : "",
    words: [...(told ? [t(word)] : []), ...(told && stands ? [] : [moves])].join(" · "),
    limit: said.drive.enabled
      ? t(isGate(by) ? "motion.gated" : "motion.limit", {
          speed: v_mps.toFixed(2),
          what: limitWords(by),
        })
      : null,
  };
});

/** Say whether the robot moves, as measured; grey with its age when that is old. */
function Motion() {
  const found = motionNow.value;
  if (found === null) return <p class="motion stale">{t("motion.unknown")}</p>;
  const { words, limit, tone } = found;
  if (isTrying.value && bridgeFresh.value) return <p class="motion">{t("motion.trial")}</p>;
  return bridgeFresh.value ? (
    <p class={`motion ${tone}`}>
      {words}
      {limit && <span class="fine limit">{limit}</span>}
    </p>
  ) : (
    <p class="motion stale">{t("motion.stale", { words, age: seconds(age("status")) })}</p>
  );
}
