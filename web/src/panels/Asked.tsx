/**
 * Put first what waits for a person, on every view: the newest question as a card with its buttons, and
 * below it what keeps the robot from driving, with the one button that ends it.
 */
import { useSignal } from "@preact/signals";
import { say, t } from "../i18n";
import { act, answer } from "../state/acts";
import { asking } from "../state/facts";
import { age, pageFresh } from "../state/store";
import type { Goal } from "../wire/types";
import { seconds } from "./format";
import { Notice } from "./Notice";
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
            {stale && <span class="old"> {t("link.age", { age: seconds(age("page")) })}</span>}
          </h2>
          <Turn key={goal.id} goal={goal} />
          {more.length > 0 && <p class="fine">{t("now.more", { n: `${more.length}` })}</p>}
        </section>
      )}
      <Notice urgent />
    </div>
  );
}

/** Offer the answers to a goal's question: its options, a yes or no to a plan, and a person's own words. */
export function Question({ goal }: { goal: Goal }) {
  const reply = useSignal("");
  const confirms = goal.state === "awaiting_confirmation";
  const asked = goal.outcome?.message ?? goal.plan?.text ?? null; // as it was spoken
  const send = async (text: string): Promise<void> => {
    if (await answer(goal, text)) reply.value = "";
  };
  return (
    <div class="clarify">
      <p class="question-words" dir="auto">
        {asked === null ? t("said.shall_i") : say(asked)}
      </p>
      <div class="buttons">
        {confirms && (
          <>
            <button type="button" class="main" onClick={() => void act(goal, "confirm")}>
              {t("goal.confirm")}
            </button>
            <button type="button" onClick={() => void send(goal.language === "zh" ? "不" : "no")}>
              {t("said.no")}
            </button>
          </>
        )}
        {(goal.plan?.options ?? []).map((option) => (
          <button
            key={option.text}
            type="button"
            class="clip"
            onClick={() => void send(option.text)}
          >
            {say(option.label)}
          </button>
        ))}
      </div>
      <form
        class="goal-row"
        onSubmit={(event) => {
          event.preventDefault();
          const text = reply.value.trim();
          if (text) void send(text);
        }}
      >
        <input
          type="text"
          autocomplete="off"
          enterkeyhint="send"
          aria-label={t("goal.reply")}
          placeholder={t("goal.reply")}
          value={reply.value}
          onInput={(event) => (reply.value = event.currentTarget.value)}
        />
        <button type="submit" disabled={reply.value.trim() === ""}>
          {t("goal.reply.send")}
        </button>
      </form>
    </div>
  );
}
