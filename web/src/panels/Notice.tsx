/** Say what keeps the robot from driving, in sentences, with the button that a person may press. */
import { computed } from "@preact/signals";
import { rowWords, t, word } from "../i18n";
import type { Act } from "../net/api";
import { age, bridgeFresh, shownStatus } from "../state/store";
import { steady } from "../state/steady";
import type { Status } from "../wire/types";
import { Deliberate } from "./Deliberate";
import { seconds } from "./format";

/** Why the black box takes nothing: said while driving too, for it keeps nobody from driving on. */
const UNRECORDED = new Set(["recorder_down", "disk_full"]);

const reasonsNow = steady(() => (shownStatus.value ? reasons(shownStatus.value) : []));
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

function reasons(said: Status): string[] {
  const rows = said.rows.filter((row) => row.binding).map((row) => rowWords(row.row));
  const up = new Set(said.rows.map((row) => row.row.toLowerCase()));
  const unrecorded = said.waiting_for.filter((code) => UNRECORDED.has(code));
  const waiting = said.waiting_for
    .filter((code) => !up.has(code) && !UNRECORDED.has(code))
    .map((code) => wanted(code));
  const untold = unrecorded.map((code) => word("notice", code));
  const held = said.held ? [word("held", said.held.reason)] : [];
  const latched = ["ESTOPPED", "FAULT"].includes(said.mode) ? [t("notice.latched")] : [];
  const disarmed = said.mode === "DISARMED" ? [t("notice.disarmed")] : [];
  const blocked = said.blocked ? [t("notice.blocked")] : [];
  const lacks = waiting.length > 0 ? [t("notice.waiting", { what: waiting.join(", ") })] : [];
  return [...new Set([...rows, ...blocked, ...held, ...latched, ...untold, ...disarmed, ...lacks])];
}

/** Name what is waited for; some wants bear a row's name in lower case. */
function wanted(code: string): string {
  const known = word("want", code);
  if (known !== code) return known;
  const words = rowWords(code.toUpperCase());
  return words === code.toUpperCase() ? code.replaceAll("_", " ") : words;
}

/** Return the order by which a person may let the robot go on; null where none is needed. */
function remedyOf(said: Status): Act | null {
  if (["ESTOPPED", "FAULT"].includes(said.mode)) return "reset";
  if (said.mode === "DISARMED") return "arm";
  return said.held ? "resume" : null;
}
