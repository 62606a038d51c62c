/**
 * Show one turn of the conversation: what was said, by what door and when; what was understood, asked and
 * answered; how it ended, when and how far it went.
 */
import { byWhom, say, t, word } from "../i18n";
import { act, give } from "../state/acts";
import { asks, heldGoal } from "../state/facts";
import { ended, onlyPartly } from "../state/goals";
import { now } from "../state/store";
import type { Goal, Outcome, Step, Tag } from "../wire/types";
import { Question } from "./Asked";
import { DraftOf } from "./Draft";
import { fixed, when } from "./format";
import { QueueButtons } from "./QueueButtons";
import { Replies } from "./Replies";
import { Stops } from "./Stops";
import { brainName, needed, reasonWords, roleWords, stepWords } from "./steps";
import { verdict } from "./verdict";
import { useSignal } from "@preact/signals";

const MARKS: { readonly [state: string]: string } = {
  pending: "○",
  running: "▶",
  succeeded: "✓",
  failed: "✕",
  skipped: "–",
};

/** Steps that hold others: what is done now is one of these. */
const HOLDS = new Set(["if", "try", "repeat"]);

export function Turn({ goal }: { goal: Goal }) {
  const question = asks(goal); // its question says why, in words
  const partly = onlyPartly(goal);
  return (
    <article class={`turn turn-${goal.state}`} data-state={goal.state} data-goal={goal.id}>
      <header>
        <p class="said" dir="auto">
          {goal.text}
        </p>
        <span class={`chip state-${partly ? "partly" : goal.state}`}>
          {word("state", partly ? "partly" : goal.state)}
        </span>
      </header>
      <p class="fine by">{spokenWords(goal.by, Date.parse(goal.created))}</p>
      <Answers goal={goal} />
      {question && <Question goal={goal} />}
      {goal.reason && !question && <p class="reason">{whyWords(goal)}</p>}
      <DraftOf goal={goal} />
      {ended(goal) ? <Deeds goal={goal} /> : <Plan goal={goal} />}
      {goal.outcome && !question && <Ended outcome={goal.outcome} goal={goal} />}
      <Buttons goal={goal} />
    </article>
  );
}

const spokenWords = (by: string, atMs: number): string =>
  t("places.by", { who: byWhom(by), when: when(atMs, now.peek().wallMs) });

function whyWords(goal: Goal): string {
  const who = goal.stopped_by;
  return who === null ? reasonWords(goal.reason) : t("said.stopped", { who: byWhom(who) });
}

/** Show what was asked before and answered; it stays. */
function Answers({ goal }: { goal: Goal }) {
  if (goal.answers.length === 0) return null;
  return (
    <ul class="answers">
      {goal.answers.map((one, index) => (
        <li key={index} dir="auto">
          <span class="reason">{one.asked === null ? t("said.shall_i") : say(one.asked)}</span>{" "}
          <strong>{one.said ?? t("said.yes")}</strong>{" "}
          <span class="fine">{spokenWords(one.by, 1000 * one.unix_s)}</span>
        </li>
      ))}
    </ul>
  );
}

/** Show what an open goal is about to do, and who planned it. */
function Plan({ goal }: { goal: Goal }) {
  return (
    <>
      {goal.plan && goal.plan.steps.length > 0 && <Steps steps={goal.plan.steps} goal={goal.id} />}
      {goal.brain && <PlannedBy tag={goal.brain} />}
      <Replies goal={goal} />
    </>
  );
}

/** Say in a line what was understood of a goal that is over; unfolded, each step and what it came to. */
function Deeds({ goal }: { goal: Goal }) {
  const open = useSignal(false); // what the model wrote is fetched then, not for all of them
  const steps = goal.plan?.steps ?? [];
  if (steps.length === 0 && goal.brain === null) return null;
  const planned = goal.brain && <PlannedBy tag={goal.brain} />;
  if (steps.length === 0 && goal.brain?.name === "offline") return planned;
  return (
    <details
      class="deeds"
      onToggle={(event) => (open.value = open.value || event.currentTarget.open)}
    >
      <summary>
        {steps.length === 0
          ? planned
          : steps
              .filter((one) => one.depth === 0)
              .map(stepWords)
              .join(" · ")}
      </summary>
      <Steps steps={steps} goal={goal.id} />
      {steps.length > 0 && planned}
      {open.value && <Replies goal={goal} />}
    </details>
  );
}

/** Show a plan's steps, with what its patrols saw. */
export function Steps({ steps, goal }: { steps: readonly Step[]; goal: string }) {
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
            {roleWords(step) !== "" && <span class="role">{roleWords(step)} </span>}
            {stepWords(step)}
            <span class="unseen"> ({word("state", step.state)})</span>
            {step.reason && <span class="reason"> {reasonWords(step.reason)}</span>}
            {verdict(step).length > 0 && <span class="fine"> {verdict(step).join(" · ")}</span>}
            {steps.length > 1 && <Came step={step} />}
            <Stops goal={goal} at={index} step={step} />
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

/** Say how it ended, when, and how far and how long it went. */
function Ended({ outcome, goal }: { outcome: Outcome; goal: Goal }) {
  const figures =
    typeof outcome.metres === "number" && outcome.metres > 0
      ? t("goal.figures", {
          metres: fixed(outcome.metres, 1, "m"),
          seconds: fixed(outcome.seconds, 1, "s"),
        })
      : "";
  const at = ended(goal) ? when(Date.parse(goal.updated), now.peek().wallMs) : "";
  const more = [figures, needed("goal.limited", outcome.limited_by ?? []), at];
  return (
    <div class="outcome" data-code={outcome.code}>
      <p dir="auto">{say(outcome.message)}</p>
      <p class="fine">{more.filter((text) => text).join(" · ")}</p>
    </div>
  );
}

/** Name the brain that planned; where it stood in for a model, say so and why. */
function PlannedBy({ tag }: { tag: Tag }) {
  if (tag.fallback_from === null) {
    if (tag.name === "offline") return null; // the rule, and told under Robot
    return <span class="fine by">{t("goal.brain", { name: brainName(tag.name) })}</span>;
  }
  return (
    <span class="fine by fell" data-reason={tag.fallback_reason}>
      {t("goal.brain.instead", { name: brainName(tag.name), model: tag.fallback_from })}{" "}
      {tag.fallback_message && say(tag.fallback_message)}
    </span>
  );
}

function Buttons({ goal }: { goal: Goal }) {
  if (ended(goal))
    return (
      <button type="button" class="quiet again" onClick={() => void give(goal.text)}>
        {t("goal.again")}
      </button>
    );
  const stopped = goal.state === "paused" || goal.reason === "held";
  const verbs = {
    resume: stopped && heldGoal.value?.id !== goal.id, // that one's button stands first of all
    pause: goal.state === "running",
    cancel: true,
  } as const;
  return (
    <div class="buttons">
      {goal.state === "queued" && <QueueButtons goal={goal} />}
      {(["resume", "pause", "cancel"] as const)
        .filter((verb) => verbs[verb])
        .map((verb) => (
          <button
            key={verb}
            type="button"
            class={verb === "resume" ? "main" : ""}
            onClick={() => void act(goal, verb)}
          >
            {t(`goal.${verb}`)}
          </button>
        ))}
    </div>
  );
}
