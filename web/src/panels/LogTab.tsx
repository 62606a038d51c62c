/** Show what the bridge and the planner said since the page was opened, newest first. */
import { t } from "../i18n";
import { log } from "../state/store";
import { told } from "./events";
import { clock } from "./format";

export function LogTab() {
  return (
    <section class="card" aria-labelledby="log-title">
      <h2 id="log-title">{t("log.title")}</h2>
      {log.value.length === 0 && <p class="fine">{t("log.none")}</p>}
      <ol class="log">
        {log.value.map((entry) => {
          const { text, fine } = told(entry);
          return (
            <li key={entry.id} data-code={entry.code}>
              <time>{clock(entry.at)}</time>
              <span dir="auto">
                {text}
                {fine && <small class="fine">{fine}</small>}
              </span>
            </li>
          );
        })}
      </ol>
    </section>
  );
}
