/** Show the Stop button, on every view, and what the bridge has said to it. */
import { t } from "../i18n";
import { seconds } from "../panels/format";
import { limitWords } from "../panels/steps";
import { age, bridgeFresh, status } from "../state/store";
import type { StopState } from "./machine";
import { stop, stopState } from "./stopper";

export function StopBar() {
  const state = stopState.value;
  return (
    <footer class="stopbar">
      <button
        type="button"
        class="stop"
        id="stop"
        aria-keyshortcuts="Space Escape"
        onPointerDown={(event) => {
          if (event.button === 0) stop(); // on touch, not on release: a slipping finger still stops
        }}
        onClick={(event) => {
          if (event.detail === 0) stop(); // by Enter or by a screen reader: no pointer came before
        }}
      >
        <span class="stop-word">{t("stop.button")}</span>
        <span class="stop-keys">{t("stop.keys")}</span>
      </button>
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

/** Say whether the robot moves, as measured; grey with its age when that is old. */
function Motion() {
  const said = status.value;
  if (said === null) return <p class="motion stale">{t("motion.unknown")}</p>;
  const speed = Math.abs(said.measured.v_mps);
  const moving = speed > 0.02 || Math.abs(said.measured.w_radps) > 0.05;
  const words = moving ? t("motion.moving", { speed: speed.toFixed(2) }) : t("motion.standing");
  const { limits } = said;
  return bridgeFresh.value ? (
    <p class="motion">
      {words}
      {said.drive.enabled && (
        <span class="fine limit">
          {t("motion.limit", { speed: limits.v_mps.toFixed(2), what: limitWords(limits.by) })}
        </span>
      )}
    </p>
  ) : (
    <p class="motion stale">{t("motion.stale", { words, age: seconds(age("status")) })}</p>
  );
}
