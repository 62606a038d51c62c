/** Say what keeps the robot from driving, in sentences, with the button that a person may press. */
import { computed } from "@preact/signals";
import { t } from "../i18n";
import type { Act } from "../net/api";
import { age, bridgeFresh, log, shownStatus } from "../state/store";
import { steady } from "../state/steady";
import type { Status } from "../wire/types";
import { Deliberate } from "./Deliberate";
import { seconds } from "./format";
import { reasons } from "./reasons";

const reasonsNow = steady(() => (shownStatus.value ? reasons(shownStatus.value, log.value) : []));
const remedyNow = computed(() => (shownStatus.value ? remedyOf(shownStatus.value) : null));

export function Notice() {
  const items = reasonsNow.value;
  if (items.length === 0) return null;
  const stale = bridgeFresh.value ? "" : "stale";
  const remedy = remedyNow.value;
  return (
    <section
      class={`card notice ${remedy ? "asks" : "tells"} ${stale}`}
      aria-labelledby="notice-title"
      id="notice"
    >
      <h2 id="notice-title">
        {t(remedy ? "notice.title" : "notice.watch")}
        {stale && <span class="old"> {t("link.age", { age: seconds(age("status")) })}</span>}
      </h2>
      <ul>
        {items.map((item) => (
          <li key={item}>{item}</li>
        ))}
      </ul>
      {remedy && <Deliberate kind={remedy} where="notice" />}
    </section>
  );
}

/** Return the order by which a person may let the robot go on; null where none is needed. */
function remedyOf(said: Status): Act | null {
  if (["ESTOPPED", "FAULT"].includes(said.mode)) return "reset";
  if (said.mode === "DISARMED") return "arm";
  return said.held ? "resume" : null;
}
