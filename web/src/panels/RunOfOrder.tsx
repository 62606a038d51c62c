/** Tell in the conversation what became of a standing order's run that is no goal of its own here. */
import { say, t } from "../i18n";
import { now } from "../state/store";
import type { OrderRun } from "../wire/types";
import { when } from "./format";
import { runWords } from "./standing";

export function RunOfOrder({ run }: { run: OrderRun }) {
  const times = run.count > 1 ? ` × ${run.count}` : "";
  return (
    <article class="turn turn-run" data-state={run.state} data-order={run.order}>
      <header>
        <p class="said" dir="auto">
          {run.text}
        </p>
        <span class={`chip ${run.state === "missed" ? "state-failed" : ""}`}>
          {runWords(run)}
          {times}
        </span>
      </header>
      <p class="fine by">
        {t("places.by", {
          who: t("orders.one"),
          when: when(Date.parse(run.due), now.peek().wallMs),
        })}
      </p>
      {run.told && <p dir="auto">{say(run.told)}</p>}
    </article>
  );
}
