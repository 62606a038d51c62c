/**
 * Put first what waits for a person, on every view: the newest question as a card with its buttons, and
 * below it what keeps the robot from driving, with the one button that ends it.
 */
import { say, t } from "../i18n";
import { act, answer } from "../state/acts";
import { asking } from "../state/facts";
import { age, pageFresh } from "../state/store";
import type { Goal } from "../wire/types";
import { seconds } from "./format";
import { Notice } from "./Notice";
import { QuestionForm } from "./QuestionForm";
import { Turn } from "./Turn";

export function Asked() {
  const [goal, ...more] = asking.value;
  const stale = pageFresh.value ? "" : "stale";
  return (
    <div class="first">
      {goal && (
        <section class={`card asked ${stale}`} aria-labelledby="asked-title" id="asked">
          <h2 id="asked-title">
            {t("now.asks")}
            {stale !== "" && (
              <span class="old"> {t("link.age", { age: seconds(age("page")) })}</span>
            )}
          </h2>
          <Turn key={goal.id} goal={goal} />
          {more.length > 0 && <p class="fine">{t("now.more", { n: `${more.length}` })}</p>}
        </section>
      )}
      <Notice urgent />
    </div>
  );
}

/** Ask what a goal asks. */
export function Question({ goal }: { goal: Goal }) {
  const asked = goal.outcome?.message ?? goal.plan?.text ?? null; // as it was spoken
  const no = goal.language === "zh" ? "不" : "no";
  return (
    <QuestionForm
      words={asked === null ? t("said.shall_i") : say(asked)}
      options={goal.plan?.options ?? []}
      confirm={
        goal.state === "awaiting_confirmation"
          ? { yes: () => void act(goal, "confirm"), no: () => void answer(goal, no) }
          : null
      }
      send={(text) => answer(goal, text)}
    />
  );
}
