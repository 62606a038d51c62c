/** Show what a plan would do beside the yes: each way's metres, seconds and narrowest place. */
import { say, t } from "../i18n";
import { fixed } from "../panels/format";
import { act, give } from "../state/acts";
import { DrivenPart } from "./DrivenPart";
import { nameOf, put, rehearse, type RehearsedStep, shown, waiting } from "./rehearsal";

export function RehearsalPanel() {
  const now = shown.value;
  if (now === null) return null;
  const { of, plan } = now;
  return (
    <section class="card rehearsal" aria-labelledby="rehearsal-title" id="rehearsal">
      <h2 id="rehearsal-title">{t("rehearsal.title")}</h2>
      {"text" in of && <p dir="auto">“{of.text}”</p>}
      <ol class="rehearsed">
        {plan.steps.map((step) => (
          <li key={step.index} data-does={step.does}>
            <span dir="auto">{nameOf(step)}</span>
            <span class={step.does === "shut" ? "reason" : "fine"}>{figuresOf(step)}</span>
          </li>
        ))}
      </ol>
      <p class="fine" id="rehearsal-sum">
        {t("rehearsal.sum", figures(plan))} {!plan.is_whole && t("rehearsal.not_whole")}
      </p>
      <DrivenPart of={of} />
      <div class="buttons">
        <DoIt of={of} />
        <button type="button" class="quiet" onClick={() => put(null)}>
          {t("rehearsal.hide")}
        </button>
      </div>
    </section>
  );
}

function DoIt({ of }: { of: { goal: string } | { text: string } }) {
  const goal = waiting.value;
  if ("goal" in of && (goal?.id !== of.goal || goal.state !== "awaiting_confirmation")) return null;
  const doIt = async (): Promise<void> => {
    const done = "text" in of ? await give(of.text) : goal !== null && (await act(goal, "confirm"));
    if (done) put(null);
  };
  return (
    <button type="button" class="main" onClick={() => void doIt()}>
      {t("rehearsal.do")}
    </button>
  );
}

/** Offer to show a sentence first; it is not given yet. */
export function ShowFirst({ text }: { text: string }) {
  if (text === "") return null;
  return (
    <button type="button" class="quiet" onClick={() => void rehearse({ text })}>
      {t("rehearsal.show")}
    </button>
  );
}

const figures = (of: { length_m: number; seconds: number }): Record<string, string> => ({
  metres: fixed(of.length_m, 1, "m"),
  seconds: fixed(of.seconds, 0, "s"),
});

/** Say a step's figures: metres, seconds, narrowest place, and what is not known. */
export function figuresOf(step: RehearsedStep): string {
  if (step.does === "open") return t("rehearsal.open");
  if (step.does === "shut") return step.message ? say(step.message) : t("rehearsal.shut");
  const known = figures(step);
  return [
    step.length_m > 0 ? t("rehearsal.way", known) : t("rehearsal.time", known),
    step.narrowest_m === null ? "" : t("rehearsal.narrow", { m: fixed(step.narrowest_m, 2, "m") }),
    step.suspect_m > 0 ? t("rehearsal.suspect", { m: fixed(step.suspect_m, 1, "m") }) : "",
    step.hoped ? t("rehearsal.hoped") : "",
  ]
    .filter((part) => part !== "")
    .join(t("notice.comma"));
}
