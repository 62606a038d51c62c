/** Hold the conversation: where a person speaks, and all that was said, newest at hand. */
import { t } from "../i18n";
import { asking } from "../state/facts";
import { age, currentGoals, pageFresh, pageHeard, pastGoals, queuedGoals } from "../state/store";
import { GoalBox } from "./GoalBox";
import { seconds } from "./format";
import { Meter } from "./Meter";
import { MindLine } from "./MindLine";
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
  const stale = pageFresh.value || !pageHeard.value ? "" : "stale";
  const [first] = asking.value;
  const open = [...currentGoals.value, ...queuedGoals.value];
  const turns = [...open, ...pastGoals.value.slice(0, SHOWN_PAST)].filter((goal) => goal !== first);
  return (
    <section class={`card ${stale}`} aria-labelledby="said-title" id="said">
      <h2 id="said-title">
        {t("said.title")}
        {stale && <span class="old"> {t("link.age", { age: seconds(age("page")) })}</span>}
      </h2>
      {open.length === 0 && <p class="fine">{t("goal.none")}</p>}
      {turns.map((goal) => (
        <Turn key={goal.id} goal={goal} />
      ))}
    </section>
  );
}
