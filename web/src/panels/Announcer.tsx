/** Read aloud and show for a while what just happened: outcomes, questions, failures of requests. */
import { effect } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { say, word } from "../i18n";
import { note, tell } from "../state/acts";
import { goals, orderTold } from "../state/store";
import type { Goal } from "../wire/types";

const SHOWN_MS = 6000;

export function Announcer() {
  const shown = note.value;
  useEffect(() => watchOutcomes(), []);
  useEffect(() => watchOrders(), []);
  useEffect(() => {
    if (!shown) return;
    const timer = setTimeout(() => {
      if (note.peek()?.id === shown.id) note.value = null;
    }, SHOWN_MS);
    return () => clearTimeout(timer);
  }, [shown]);
  return (
    <div class="announcer" aria-live="polite" role="status" id="announcer">
      {shown && <p class={`note clip-3 ${shown.bad ? "bad" : ""}`}>{shown.text}</p>}
    </div>
  );
}

/** Tell a goal's change of state once; what was so when the page came is no news. */
function watchOutcomes(): () => void {
  let known: ReadonlyMap<string, string> | null = null;
  return effect(() => {
    const states = new Map(goals.value.map((goal) => [goal.id, goal.state]));
    for (const goal of goals.value) {
      if (known !== null && known.get(goal.id) !== goal.state) announce(goal);
    }
    if (states.size > 0 || known !== null) known = states;
  });
}

/** Tell what becomes of standing orders: a reminder's words, a run that was missed. */
function watchOrders(): () => void {
  return effect(() => {
    if (orderTold.value) tell(say(orderTold.value.words), orderTold.value.bad);
  });
}

function announce(goal: Goal): void {
  if (goal.outcome) tell(say(goal.outcome.message), goal.state === "failed");
  else if (goal.state === "needs_clarification" && goal.plan?.text) tell(say(goal.plan.text));
  else if (goal.state === "paused") tell(`${word("state", goal.state)}: ${goal.text}`);
}
