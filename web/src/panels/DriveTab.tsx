/** Gather what a person needs to drive: the goal box, what runs, what waits, what was before. */
import { computed, useSignal } from "@preact/signals";
import { say, t, word } from "../i18n";
import { act, doInstead, give, moveBy } from "../state/acts";
import { age, currentGoals, pageFresh, pageHeard, pastGoals, queuedGoals } from "../state/store";
import type { Goal } from "../wire/types";
import { GoalBox } from "./GoalBox";
import { seconds } from "./format";
import { Ended, GoalCard, PlannedBy, Steps } from "./GoalCard";
import { Meter } from "./Meter";
import { MindLine } from "./MindLine";
import { Replies } from "./Replies";
import { reasonWords } from "./steps";

const SHOWN_PAST = 20;
const CAME_TO_NOTHING: ReadonlySet<string> = new Set(["failed", "refused"]);

export function DriveTab() {
  return (
    <>
      <GoalBox />
      <MindLine />
      <Now />
      <Queue />
      <Meter />
      <Past />
    </>
  );
}

function Now() {
  const stale = pageFresh.value || !pageHeard.value ? "" : "stale";
  return (
    <section class={`card ${stale}`} aria-labelledby="now-title" id="now">
      <h2 id="now-title">
        {t("goal.now")}
        {stale && <span class="old"> {t("link.age", { age: seconds(age("page")) })}</span>}
      </h2>
      {currentGoals.value.length === 0 && <Idle />}
      {currentGoals.value.map((goal) => (
        <GoalCard key={goal.id} goal={goal} />
      ))}
    </section>
  );
}

/** Say that there is nothing to do, and first why the newest order came to nothing. */
function Idle() {
  const [newest] = pastGoals.value;
  const failed = newest !== undefined && CAME_TO_NOTHING.has(newest.state);
  return (
    <>
      {failed && newest.outcome && (
        <p class="unfinished" dir="auto" data-goal={newest.id}>
          <span class={`chip state-${newest.state}`}>{word("state", newest.state)}</span>{" "}
          {say(newest.outcome.message)}
        </p>
      )}
      <p class="fine">{t("goal.none")}</p>
    </>
  );
}

const running = computed(() => currentGoals.value.find((goal) => goal.state === "running")?.id);

/** Do a queued goal now, in place of whatever runs by then. */
function instead(goal: Goal): void {
  const runs = currentGoals.value.find(({ id }) => id === running.value);
  if (runs) void doInstead(goal, runs);
}

function Queue() {
  const goals = queuedGoals.value;
  if (goals.length === 0) return null;
  return (
    <section
      class={`card ${pageFresh.value ? "" : "stale"}`}
      aria-labelledby="queue-title"
      id="queue"
    >
      <h2 id="queue-title">
        {t("goal.queue.title")} <span class="fine">{goals.length}</span>
      </h2>
      <ol class="queue">
        {goals.map((goal, index) => (
          <li key={goal.id} data-goal={goal.id}>
            <span class="fine">{index + 1}.</span>
            <span class="said" dir="auto">
              {goal.text}
              {goal.reason && <span class="reason"> {reasonWords(goal.reason)}</span>}
            </span>
            <span class="buttons">
              {index > 0 && (
                <button
                  type="button"
                  aria-label={t("goal.sooner")}
                  onClick={() => void moveBy(goal, -1)}
                >
                  ↑
                </button>
              )}
              {index < goals.length - 1 && (
                <button
                  type="button"
                  aria-label={t("goal.later")}
                  onClick={() => void moveBy(goal, 1)}
                >
                  ↓
                </button>
              )}
              {running.value !== undefined && (
                <button type="button" onClick={() => instead(goal)}>
                  {t("goal.instead")}
                </button>
              )}
              {goal.reason === "held" && (
                <button type="button" class="main" onClick={() => void act(goal, "resume")}>
                  {t("goal.resume")}
                </button>
              )}
              <button type="button" onClick={() => void act(goal, "cancel")}>
                {t("goal.cancel")}
              </button>
            </span>
          </li>
        ))}
      </ol>
    </section>
  );
}

function Past() {
  const goals = pastGoals.value.slice(0, SHOWN_PAST);
  if (goals.length === 0) return null;
  return (
    <section class="card" aria-labelledby="past-title" id="past">
      <h2 id="past-title">{t("goal.past")}</h2>
      <ul class="past">
        {goals.map((goal, index) => (
          <PastGoal
            key={goal.id}
            goal={goal}
            open={index === 0 && goal.outcome?.code === "answered"}
          />
        ))}
      </ul>
    </section>
  );
}

function PastGoal({ goal, open }: { goal: Goal; open: boolean }) {
  const wasOpened = useSignal(open); // what the model wrote is fetched then, not for all of them
  return (
    <li data-goal={goal.id} data-state={goal.state}>
      <details
        open={open}
        onToggle={(event) => (wasOpened.value = wasOpened.value || event.currentTarget.open)}
      >
        <summary>
          <span class={`chip state-${goal.state}`}>{word("state", goal.state)}</span>
          <span class="said clip" dir="auto">
            {goal.text}
          </span>
        </summary>
        {goal.outcome && <Ended outcome={goal.outcome} />}
        {goal.plan && <Steps steps={goal.plan.steps} />}
        {goal.brain && <PlannedBy tag={goal.brain} />}
        {wasOpened.value && <Replies goal={goal} />}
        <button type="button" onClick={() => void give(goal.text)}>
          {t("goal.again")}
        </button>
      </details>
    </li>
  );
}
