/** Show one goal: what was said, its steps with reasons, what it asks, how it ended, its buttons. */
import { useSignal } from "@preact/signals";
import { say, t, word } from "../i18n";
import { act, answer } from "../state/acts";
import type { Goal, Outcome, Step, Tag } from "../wire/types";
import { DraftOf } from "./Draft";
import { fixed } from "./format";
import { Replies } from "./Replies";
import { Stops } from "./Stops";
import { brainName, needed, reasonWords, roleWords, stepWords } from "./steps";
import { verdict } from "./verdict";

const MARKS: { readonly [state: string]: string } = {
  pending: "○",
  running: "▶",
  succeeded: "✓",
  failed: "✕",
  skipped: "–",
};

/** Steps that hold others: what is done now is one of these. */
const HOLDS = new Set(["if", "try", "repeat"]);

export function GoalCard({ goal }: { goal: Goal }) {
  const asks = goal.state === "needs_clarification"; // its question says why, in words
  return (
    <article class={`goal goal-${goal.state}`} data-state={goal.state} data-goal={goal.id}>
      <header>
        <p class="said" dir="auto">
          {goal.text}
        </p>
        <span class={`chip state-${goal.state}`}>{word("state", goal.state)}</span>
      </header>
      {goal.reason && !asks && <p class="reason">{reasonWords(goal.reason)}</p>}
      <DraftOf goal={goal} />
      {goal.plan && goal.plan.steps.length > 0 && <Steps steps={goal.plan.steps} goal={goal.id} />}
      {asks && <Question goal={goal} />}
      {goal.outcome && !asks && <Ended outcome={goal.outcome} />}
      {goal.brain && <PlannedBy tag={goal.brain} />}
      <Replies goal={goal} />
      <Buttons goal={goal} />
    </article>
  );
}

/** Show a plan's steps; of a goal's own plan with what its patrols saw. */
export function Steps({ steps, goal }: { steps: readonly Step[]; goal?: string }) {
  return (
    <ol class="steps" aria-label={t("goal.steps")}>
      {steps.map((step, index) => (
        <li
          key={index}
          class={`step step-${step.state}`}
          data-depth={step.depth}
          data-role={step.role}
          aria-current={step.state === "running" && !HOLDS.has(step.kind) ? "step" : undefined}
        >
          <span class="mark" aria-hidden="true">
            {MARKS[step.state] ?? "•"}
          </span>
          <span class="what">
            {roleWords(step) && <span class="role">{roleWords(step)} </span>}
            {stepWords(step)}
            <span class="unseen"> ({word("state", step.state)})</span>
            {step.reason && <span class="reason"> {reasonWords(step.reason)}</span>}
            {verdict(step).length > 0 && <span class="fine"> {verdict(step).join(" · ")}</span>}
            {steps.length > 1 && <Came step={step} />}
            {goal !== undefined && <Stops goal={goal} at={index} step={step} />}
          </span>
        </li>
      ))}
    </ol>
  );
}

/** Say what a step came to, and beside it what a model read; a goal of one step says it as its outcome. */
function Came({ step }: { step: Step }) {
  if ((step.stops ?? []).length > 0 && step.state === "succeeded") return null; // told by stops
  const told = [step.said, step.read].filter((words) => words !== null && words !== undefined);
  return told.length > 0 && <span class="came">{told.map(say).join(" ")}</span>;
}

function Question({ goal }: { goal: Goal }) {
  const reply = useSignal("");
  const plan = goal.plan;
  const question = plan?.text ?? goal.outcome?.message ?? null; // a plan's own, or a step's
  return (
    <div class="clarify">
      {question && <p dir="auto">{say(question)}</p>}
      <div class="buttons">
        {(plan?.options ?? []).map((option) => (
          <button
            key={option.text}
            type="button"
            class="clip"
            onClick={() => void answer(goal, option.text)}
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
          if (text) void answer(goal, text);
        }}
      >
        <input
          type="text"
          aria-label={t("goal.reply")}
          placeholder={t("goal.reply")}
          value={reply.value}
          onInput={(event) => (reply.value = event.currentTarget.value)}
        />
        <button type="submit">{t("goal.reply.send")}</button>
      </form>
    </div>
  );
}

export function Ended({ outcome }: { outcome: Outcome }) {
  const figures =
    typeof outcome.metres === "number" && outcome.metres > 0
      ? t("goal.figures", {
          metres: fixed(outcome.metres, 1, "m"),
          seconds: fixed(outcome.seconds, 1, "s"),
        })
      : "";
  const more = [figures, needed("goal.limited", outcome.limited_by ?? [])].filter((text) => text);
  return (
    <div class="outcome" data-code={outcome.code}>
      <p dir="auto">{say(outcome.message)}</p>
      {more.length > 0 && <p class="fine">{more.join(" · ")}</p>}
    </div>
  );
}

/** Name the brain that planned; where it stood in for a model, say so and why. */
export function PlannedBy({ tag }: { tag: Tag }) {
  if (tag.fallback_from === null) {
    return <p class="fine by">{t("goal.brain", { name: brainName(tag.name) })}</p>;
  }
  return (
    <p class="fine by fell" data-reason={tag.fallback_reason}>
      {t("goal.brain.instead", { name: brainName(tag.name), model: tag.fallback_from })}{" "}
      {tag.fallback_message && say(tag.fallback_message)}
    </p>
  );
}

function Buttons({ goal }: { goal: Goal }) {
  const verbs = {
    confirm: goal.state === "awaiting_confirmation",
    resume: goal.state === "paused" || goal.reason === "held",
    pause: goal.state === "running",
    cancel: true,
  } as const;
  return (
    <div class="buttons">
      {(["confirm", "resume", "pause", "cancel"] as const)
        .filter((verb) => verbs[verb])
        .map((verb) => (
          <button
            key={verb}
            type="button"
            class={verb === "confirm" || verb === "resume" ? "main" : ""}
            onClick={() => void act(goal, verb)}
          >
            {t(`goal.${verb}`)}
          </button>
        ))}
    </div>
  );
}
