/** Show what a drive in the simulator came to, below the plan that is shown: step by step, and what it left out. */
import { rowWords, say, t, word } from "../i18n";
import { fixed } from "../panels/format";
import { cancelDrive, driven, type DrivenRehearsal, type DrivenStep, driveShown } from "./drive";
import { nameOf, type Shown } from "./rehearsal";

export function DrivenPart({ of }: { of: Shown["of"] }) {
  const now = driven.value;
  if (now === null || now.state === "cancelled")
    return (
      <div class="buttons">
        <button type="button" class="quiet" id="drive-it" onClick={() => void driveShown(of)}>
          {t("driven.start")}
        </button>
      </div>
    );
  const runs = now.state === "running";
  return (
    <section class="driven" aria-labelledby="driven-title" aria-busy={runs}>
      <h3 id="driven-title">{t("driven.title")}</h3>
      <ol class="rehearsed">
        {now.driven.steps.map((step) => (
          <li key={step.index} data-outcome={step.outcome}>
            <span dir="auto">{nameOf(step)}</span>
            <span class={wentWrong(step) ? "reason" : "fine"}>{outcomeOf(step)}</span>
          </li>
        ))}
      </ol>
      <p class="fine" id="driven-sum" role="status">
        {sumOf(now)}
      </p>
      {now.message !== null && <p class="reason">{say(now.message)}</p>}
      {!runs && (
        <p class="fine">
          {t("driven.left_out", {
            what: now.left_out.map((what) => word("left_out", what)).join(t("notice.comma")),
          })}
        </p>
      )}
      {runs && (
        <div class="buttons">
          <button type="button" class="quiet" onClick={() => void cancelDrive()}>
            {t("driven.cancel")}
          </button>
        </div>
      )}
    </section>
  );
}

const wentWrong = (step: DrivenStep): boolean =>
  step.outcome === "failed" || step.outcome === "stuck" || step.contacts > 0;

/** Say what came of a step: how it ended, its figures, what it met. */
export function outcomeOf(step: DrivenStep): string {
  const ended = word("driven_outcome", step.outcome);
  if (step.outcome === "pending" || step.outcome === "left_out") return ended;
  return [
    step.message ? say(step.message) : ended,
    t("rehearsal.way", {
      metres: fixed(step.length_m, 1, "m"),
      seconds: fixed(step.seconds, 0, "s"),
    }),
    step.nearest_m === null ? "" : t("driven.nearest", { m: fixed(step.nearest_m, 2, "m") }),
    step.contacts > 0 ? t("driven.contacts", { n: String(step.contacts) }) : "",
    step.rows.length > 0
      ? t("driven.rows", { rows: step.rows.map(rowWords).join(t("notice.comma")) })
      : "",
  ]
    .filter((part) => part !== "")
    .join(t("notice.comma"));
}

/** Say what it came to in all, beside what was foretold, and how fast it was driven. */
export function sumOf(now: DrivenRehearsal): string {
  const { driven: got, shown: foretold } = now;
  const figures = { metres: fixed(got.length_m, 1, "m"), seconds: fixed(got.seconds, 0, "s") };
  if (now.state === "running")
    return got.seconds > 0 ? t("driven.under_way", figures) : t("driven.starts");
  const ways = t("rehearsal.way", {
    metres: fixed(foretold.length_m, 1, "m"),
    seconds: fixed(foretold.seconds, 0, "s"),
  });
  const times = now.times_faster ?? 0;
  const faster = times >= 2 ? ` ${t("driven.faster", { times: fixed(times, 0) })}` : "";
  return t("driven.sum", { ...figures, foretold: ways }) + faster;
}
