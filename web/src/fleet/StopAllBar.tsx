/** Show Stop for all robots, on every view, and who has confirmed it. */
import { say, t } from "../i18n";
import { StopButton } from "../stop/StopButton";
import { phase, stopAll, stopTold } from "./stopAll";
import { ft } from "./words";

export function StopAllBar() {
  const told = stopTold.value;
  const asks = phase.value;
  const missing = (told?.not_reached.length ?? 0) > 0;
  const tone = asks === "idle" ? (missing ? "bad" : "good") : asks === "asking" ? "" : "bad";
  return (
    <footer class="stopbar">
      <StopButton word={ft("stop.all")} keys={t("stop.keys")} stop={stopAll} />
      <div class="stop-says">
        <p class={`stop-state clip-3 ${tone}`} role="alert" id="stop-state" data-phase={asks}>
          {asks === "idle" ? told && say(told.message) : ft(`stop.${WORDS[asks]}`)}
        </p>
        {asks === "idle" && missing && <p class="fine">{ft("stop.repeats")}</p>}
      </div>
    </footer>
  );
}

const WORDS = { asking: "asking", doubtful: "doubt", failed: "failed" } as const;
