/** Hold the conversation: where a person speaks, and all that was said, newest at hand. */
import { useEffect } from "preact/hooks";
import { t } from "../i18n";
import { asking } from "../state/facts";
import { pastWithRuns, startRuns } from "../state/runs";
import { age, currentGoals, pageFresh, pageHeard, queuedGoals } from "../state/store";
import { GoalBox } from "./GoalBox";
import { seconds } from "./format";
import { Meter } from "./Meter";
import { MindLine } from "./MindLine";
import { RunOfOrder } from "./RunOfOrder";
import { Turn } from "./Turn";

const SHOWN_PAST = 20;

export function DriveTab() {
  return (
    <>
      <GoalBox />
      <MindLine />
      <Transcript />
      <Meter />
    </>
  );
}

/** Show what is done now, what comes next, and what was; the question that stands first is not told twice. */
function Transcript() {
  useEffect(() => startRuns(), []);
  const stale = pageFresh.value || !pageHeard.value ? "" : "stale";
  const [first] = asking.value;
  const open = [...currentGoals.value, ...queuedGoals.value];
  return (
    <section class={`card ${stale}`} aria-labelledby="said-title" id="said">
      <h2 id="said-title">
        {t("said.title")}
        {stale !== "" && <span class="old"> {t("link.age", { age: seconds(age("page")) })}</span>}
      </h2>
      {open.length === 0 && <p class="fine">{t("goal.none")}</p>}
      {open
        .filter((goal) => goal !== first)
        .map((goal) => (
          <Turn key={goal.id} goal={goal} />
        ))}
      {pastWithRuns.value
        .slice(0, SHOWN_PAST)
        .map((one) =>
          "goal" in one ? (
            <Turn key={one.goal.id} goal={one.goal} />
          ) : (
            <RunOfOrder key={`${one.run.order}/${one.run.serial}`} run={one.run} />
          ),
        )}
    </section>
  );
}
