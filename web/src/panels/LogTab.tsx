/** Show what the bridge and the planner said since the page was opened, newest first. */
import { t } from "../i18n";
import { log } from "../state/store";
import { clock } from "./format";

export function LogTab() {
  return (
    <section class="card" aria-labelledby="log-title">
      <h2 id="log-title">{t("log.title")}</h2>
      {log.value.length === 0 && <p class="fine">{t("log.none")}</p>}
      <ol class="log">
        {log.value.map((entry) => (
          <li key={entry.id}>
            <time>{clock(entry.at)}</time>
            <span>
              <strong>{entry.kind === "say" ? t("log.say") : entry.code}</strong> {entry.text}
            </span>
          </li>
        ))}
      </ol>
    </section>
  );
}
