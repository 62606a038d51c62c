/**
 * Show for a while what has no place on the page: failures of requests, words of standing orders. What
 * goals came to stays in the conversation, so it is told here to screen readers alone.
 */
import { effect, signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { say, t, word } from "../i18n";
import { note, tell } from "../state/note";
import { asks } from "../state/facts";
import { goals, orderTold } from "../state/store";
import type { Goal } from "../wire/types";

const SHOWN_MS = 6000;

const heard = signal("");

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
      <p class="unseen">{heard.value}</p>
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
  if (goal.outcome) heard.value = say(goal.outcome.message);
  else if (asks(goal)) heard.value = t("said.shall_i");
  else if (goal.state === "paused") heard.value = `${word("state", goal.state)}: ${goal.text}`;
}
