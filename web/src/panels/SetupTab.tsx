/** Set a robot of metal up: what is plugged in, and the trial with its wheels off the ground. */
import { signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { say, stepWords, t } from "../i18n";
import { hasKey } from "../net/proof";
import { answer, begin, busy, find, isMine, isTrying, leave, trial } from "../state/trial";
import type { Port, Trial } from "../wire/types";
import { KeyBox } from "./Deliberate";
import { Wizard } from "./Wizard";

const lifted = signal(false);

export function SetupTab() {
  const now = trial.value;
  if (now === null) return null;
  return (
    <>
      <section class="card notice tells" aria-labelledby="setup-title" id="setup">
        <h2 id="setup-title">{t("setup.title")}</h2>
        <p>{now.tried ? t("setup.tried", { date: now.tried }) : t("setup.untried")}</p>
        <p class="fine">
          {now.robot} · {now.drive} · {now.port}
        </p>
        {now.tried !== null && !isTrying.value && (
          <div class="buttons">
            <button type="button" class="main" disabled={busy.value} onClick={() => void leave()}>
              {t("setup.drive")}
            </button>
          </div>
        )}
      </section>
      {isTrying.value ? null : <Wizard />}
      {untouched(now) && <Plugged now={now} />}
      <Trying now={now} />
      {!untouched(now) && <Plugged now={now} />}
    </>
  );
}

/** Nothing was tried yet: then looking comes first. What a trial has begun stays where it stands. */
const untouched = (now: Trial): boolean =>
  now.tried === null && (now.phase === "idle" || now.phase === "finding");

function Trying({ now }: { now: Trial }) {
  return (
    <section class="card" aria-labelledby="trial-title" id="trial" data-phase={now.phase}>
      <h2 id="trial-title">{t("trial.title")}</h2>
      {now.phase === "refused" && <Refused now={now} />}
      {now.phase === "proved" && <Proved now={now} />}
      {!isTrying.value && <Begin now={now} />}
      {isTrying.value && <Question now={now} />}
      {now.steps.length > 0 && <Steps now={now} />}
    </section>
  );
}

/** Bring what a trial ended with into view: a telephone shows the steps, and not what is above. */
function useSeen<T extends HTMLElement>(by: string | null) {
  const shown = useRef<T>(null);
  useEffect(() => shown.current?.scrollIntoView({ block: "nearest" }), [by]);
  return shown;
}

function Refused({ now }: { now: Trial }) {
  const shown = useSeen<HTMLDivElement>(now.by);
  if (!now.cure) return null;
  return (
    <div ref={shown} class="clarify bad" role="alert" id="trial-refused" data-code={now.code}>
      <strong>{say(now.cure)}</strong>
      <p class="fine">
        {now.code}
        {now.detail && `: ${now.detail}`}
      </p>
      <p class="fine">{t("trial.unwritten")}</p>
    </div>
  );
}

function Proved({ now }: { now: Trial }) {
  const shown = useSeen<HTMLDivElement>(now.by);
  return (
    <div ref={shown} class="clarify good" role="status" id="trial-proved">
      <strong>{t("trial.proved")}</strong>
      <pre>{now.wrote.join("\n")}</pre>
    </div>
  );
}

/** Say what will happen, take the key and the word that the wheels are up. */
function Begin({ now }: { now: Trial }) {
  const asksKey = useRef(!hasKey.value); // while it is open: what goes away moves what is pressed next
  return (
    <>
      <p>{t("trial.what")}</p>
      <ul class="plain">
        <li>{t("trial.minute")}</li>
        <li>{t("trial.stops")}</li>
        <li>{t("trial.front")}</li>
      </ul>
      {asksKey.current && <KeyBox stays />}
      <label class="check">
        <input
          type="checkbox"
          id="lifted"
          checked={lifted.value}
          onChange={(event) => (lifted.value = event.currentTarget.checked)}
        />
        <span>{t("trial.lifted")}</span>
      </label>
      <div class="buttons">
        <button
          type="button"
          class="main"
          id="trial-begin"
          disabled={!lifted.value || !hasKey.value || busy.value || now.phase === "finding"}
          onClick={() => {
            lifted.value = false; // the next one is asked anew
            void begin();
          }}
        >
          {t(now.phase === "idle" || now.phase === "finding" ? "trial.begin" : "trial.again")}
        </button>
      </div>
    </>
  );
}

function Steps({ now }: { now: Trial }) {
  const newest = now.steps.length - 1;
  return (
    <ol class="steps" aria-label={t("trial.steps")}>
      {now.plan.map((name, index) => {
        const state = stateOf(now, index, newest);
        return (
          <li key={name} class={`step step-${state}`} data-step={name} data-state={state}>
            <span class="mark" aria-hidden="true">
              {MARKS[state]}
            </span>
            <span class="what">
              {stepWords(name)}
              {now.steps[index]?.seen && <small class="fine"> {now.steps[index]?.seen}</small>}
            </span>
          </li>
        );
      })}
    </ol>
  );
}

const MARKS = { pending: "·", running: "…", succeeded: "✓", failed: "✗" } as const;

function stateOf(now: Trial, index: number, newest: number): keyof typeof MARKS {
  if (index < newest || now.phase === "proved") return "succeeded";
  if (index > newest) return "pending";
  return now.phase === "refused" ? "failed" : "running";
}

function Question({ now }: { now: Trial }) {
  const done = useRef<HTMLButtonElement>(null);
  useEffect(() => done.current?.focus(), [now.ask]);
  if (!isMine.value) return <p class="clarify">{t("trial.others")}</p>;
  if (now.question === null) return <p class="clarify">{t("trial.watch")}</p>;
  return (
    <div class="clarify" role="alert" id="trial-question" data-ask={now.ask}>
      <strong>{say(now.question)}</strong>
      <div class="buttons">
        <button ref={done} type="button" class="main" onClick={() => answer(now.ask)}>
          {t("trial.done")}
        </button>
      </div>
    </div>
  );
}

function Plugged({ now }: { now: Trial }) {
  const finding = now.phase === "finding";
  return (
    <section class="card" aria-labelledby="ports-title" id="ports">
      <h2 id="ports-title">{t("ports.title")}</h2>
      <p class="fine">{t("ports.what")}</p>
      <div class="buttons">
        <button
          type="button"
          disabled={busy.value || finding || isTrying.value}
          onClick={() => void find()}
        >
          {t(finding ? "ports.looking" : "ports.look")}
        </button>
      </div>
      {now.ports !== null && now.ports.length === 0 && <p>{t("ports.none")}</p>}
      <ul class="rows">
        {now.ports?.map((port) => (
          <PortLine key={port.path} port={port} />
        ))}
      </ul>
      {now.part.length > 0 && (
        <details>
          <summary>{t("ports.part")}</summary>
          <pre>{now.part.join("\n").trim()}</pre>
        </details>
      )}
    </section>
  );
}

function PortLine({ port }: { port: Port }) {
  return (
    <li data-code={port.code}>
      <strong>{port.path}</strong>
      {port.adapter && <span class="fine">{port.adapter}</span>}
      {port.device && <span>{port.device}</span>}
      {port.cure && <span class="reason">{say(port.cure)}</span>}
    </li>
  );
}
