/** Show a plan as it is written: the steps that are whole, and what is being written now. */
import { t } from "../i18n";
import { drafts } from "../state/store";
import type { DraftStep, Goal, Step } from "../wire/types";
import { stepWords } from "./steps";

const TAIL = 160; // characters of what is being written

export function DraftOf({ goal }: { goal: Goal }) {
  const draft = drafts.value.find((one) => one.goal === goal.id);
  if (!draft) return null;
  return (
    <div class="draft" data-steps={draft.steps.length}>
      <p class="fine">{t("draft.title")}</p>
      {draft.steps.length > 0 && (
        <ol class="steps">
          {draft.steps.map((step, index) => (
            <li key={index} class="step step-pending">
              <span class="mark" aria-hidden="true">
                …
              </span>
              <span class="what">{stepWords(whole(step))}</span>
            </li>
          ))}
        </ol>
      )}
      {draft.text !== "" && (
        <p class="written" dir="auto" aria-hidden="true">
          {draft.text.slice(-TAIL)}
        </p>
      )}
    </div>
  );
}

const EMPTY: Step = {
  kind: "",
  place: null,
  places: [],
  object: null,
  text: null,
  seconds: null,
  angle_rad: null,
  distance_m: null,
  state: "pending",
  reached: null,
  residual_m: null,
  residual_rad: null,
  moved_m: null,
  turned_rad: null,
  visited: null,
  bill: null,
  answer: null,
  left_m: null,
  left_rad: null,
  left_s: null,
  reason: null,
  said: null,
  read: null,
  depth: 0,
  role: null,
  times: null,
  round: 0,
  holds: null,
  word: null,
  time: null,
  after: null,
  before: null,
};

/** Return a written step with every field, so that it reads as a step of a plan does. */
export const whole = (step: DraftStep): Step => ({ ...EMPTY, ...step });
