/** Say who plans where that is not as the owner has set it: the model rests, is on trial or fails. */
import { say, t } from "../i18n";
import { mind } from "../state/store";
import type { Mind } from "../wire/types";
import { seconds } from "./format";

export function MindLine() {
  const who = mind.value;
  if (who === null || (who.breaker !== "open" && who.last_error === null)) return null;
  return (
    <p class="mind-line" id="mind" data-breaker={who.breaker} role="status">
      {mindWords(who)}
      {who.last_error && <span class="why"> {say(who.last_error.message)}</span>}
    </p>
  );
}

/** Say in a sentence whether the model is asked. */
export function mindWords(who: Mind): string {
  switch (who.breaker) {
    case null:
      return t("mind.alone");
    case "closed":
      return t(who.last_error ? "mind.failed" : "mind.asked", { name: who.name });
    case "on_trial":
      return t("mind.trial", { name: who.name });
    case "open":
      return t("mind.rests", { name: who.name, wait: seconds(Math.ceil(who.rests_s)) });
  }
}
