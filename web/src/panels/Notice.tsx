/** Say what keeps the robot from driving, in sentences, with the button that a person may press. */
import { computed } from "@preact/signals";
import { t } from "../i18n";
import type { Act } from "../net/api";
import { hasKey, needsKey } from "../net/proof";
import { act } from "../state/acts";
import { heldGoal } from "../state/facts";
import { age, bridgeFresh, log, shownStatus } from "../state/store";
import { steady } from "../state/steady";
import type { Status } from "../wire/types";
import { Deliberate, KeyBox } from "./Deliberate";
import { seconds } from "./format";
import { reasons } from "./reasons";

const reasonsNow = steady(() => (shownStatus.value ? reasons(shownStatus.value, log.value) : []));
const remedyNow = computed(() => (shownStatus.value ? remedyOf(shownStatus.value) : null));

/** Show them: urgent ones, which a person's act ends, stand above all; the others in their place. */
export function Notice({ urgent = false }: { urgent?: boolean }) {
  const items = reasonsNow.value;
  const remedy = remedyNow.value;
  if (items.length === 0 || urgent !== (remedy !== null)) return null;
  const stale = bridgeFresh.value ? "" : "stale";
  return (
    <section
      class={`card notice ${remedy ? "asks" : "tells"} ${stale}`}
      aria-labelledby="notice-title"
      id="notice"
    >
      <h2 id="notice-title">
        {t(remedy ? "notice.title" : "notice.watch")}
        {stale !== "" && <span class="old"> {t("link.age", { age: seconds(age("status")) })}</span>}
      </h2>
      <ul>
        {items.map((item) => (
          <li key={item}>{item}</li>
        ))}
      </ul>
      {remedy && <Remedy kind={remedy} />}
    </section>
  );
}

/** Offer the one act that ends it; where it takes up a goal, that goal says which. */
function Remedy({ kind }: { kind: Act }) {
  const goal = kind === "resume" ? heldGoal.value : null;
  if (goal === null) return <Deliberate kind={kind} where="notice" />;
  const locked = needsKey(shownStatus.value) && !hasKey.value;
  return (
    <div class="buttons">
      {locked && <KeyBox />}
      <button
        type="button"
        class="main"
        id="notice-resume"
        disabled={locked}
        onClick={() => void act(goal, "resume")}
      >
        {t("goal.resume")}
      </button>
      <span class="clip fine" dir="auto">
        {goal.text}
      </span>
    </div>
  );
}

/** Return the order by which a person may let the robot go on; null where none is needed. */
function remedyOf(said: Status): Act | null {
  if (["ESTOPPED", "FAULT"].includes(said.mode)) return "reset";
  if (said.mode === "DISARMED") return "arm";
  return said.held ? "resume" : null;
}
