/** List missions: who did what and how it went; ask what a robot asks; end what a person ends. */
import { say, t } from "../i18n";
import { when } from "../panels/format";
import { QuestionForm } from "../panels/QuestionForm";
import type { Mission } from "./decode";
import { answer, asking, end, isOver, isViewer, link, robots, shown } from "./fleet";
import { ft, stateWords } from "./words";

const MOST_PAST = 30;

/** Put first what waits for a person: each question as a card. */
export function Questions() {
  return (
    <>
      {asking.value.map((one) => (
        <section key={one.id} class="card asked" data-asks={one.id} aria-labelledby={`q-${one.id}`}>
          <h2 id={`q-${one.id}`}>{ft("asks.title", { name: one.robot ?? "?" })}</h2>
          <p class="said clip-3" dir="auto">
            {one.text}
          </p>
          <Question one={one} />
        </section>
      ))}
    </>
  );
}

function Question({ one }: { one: Mission }) {
  const { question } = one;
  if (question === null) return null;
  const words = question.words === null ? t("said.shall_i") : say(question.words);
  if (isViewer.value)
    return (
      <p class="question-words" dir="auto">
        {words}
      </p>
    );
  const isChinese = /[\u4e00-\u9fff]/.test(one.text);
  const reply = (text: string) => () => void answer(one, text);
  return (
    <QuestionForm
      words={words}
      options={question.options}
      confirm={
        question.confirms
          ? { yes: reply(isChinese ? "好" : "yes"), no: reply(isChinese ? "不" : "no") }
          : null
      }
      send={(text) => answer(one, text)}
    />
  );
}

export function Missions() {
  const { open, past } = shown.value;
  return (
    <section class="card" aria-labelledby="missions-title" id="missions">
      <h2 id="missions-title">{ft("missions.title")}</h2>
      {open.length + past.length === 0 && <p class="fine">{ft("missions.none")}</p>}
      <ul class={`fleet-list ${link.value === "good" ? "" : "stale"}`}>
        {open.map((one) => (
          <One key={one.id} one={one} />
        ))}
      </ul>
      {past.length > 0 && (
        <>
          <h3>{ft("missions.past")}</h3>
          <ul class="fleet-list">
            {past.slice(0, MOST_PAST).map((one) => (
              <One key={one.id} one={one} />
            ))}
          </ul>
        </>
      )}
    </section>
  );
}

const TONES: Readonly<Record<string, string>> = {
  succeeded: "good",
  failed: "bad",
  unknown: "bad",
  at_robot: "busy",
  asking: "warn",
  refused: "warn",
  given_up: "warn",
};

function One({ one }: { one: Mission }) {
  const who = one.robot ?? ft("mission.nobody");
  const isUnknown = one.state === "unknown";
  return (
    <li data-mission={one.id} data-state={one.state}>
      <header class="fleet-row">
        <strong class="said" dir="auto">
          {one.text}
        </strong>
        <span class={`chip ${TONES[one.state] ?? ""}`}>{stateWords(one.state)}</span>
      </header>
      <p class="fine">{ft("mission.by", { who, time: when(1000 * one.atUnixS, Date.now()) })}</p>
      {one.message && (
        <p class="reason" dir="auto">
          {say(one.message)}
        </p>
      )}
      {one.state === "given_up" && one.goalState !== null && (
        <p class="fine">{ft("mission.told_later", { state: one.goalState })}</p>
      )}
      {!isOver(one) && !isViewer.value && (
        <div class="buttons">
          {isUnknown && mayGiveUp(one) && (
            <button type="button" data-act="give-up" onClick={() => void end(one, true)}>
              {ft("mission.give_up")}
            </button>
          )}
          <button type="button" data-act="cancel" onClick={() => void end(one, false)}>
            {ft("mission.cancel")}
          </button>
        </div>
      )}
    </li>
  );
}

/** Say whether the fleet lets a person end it unheard: its robot is silent, or has lost it. */
const mayGiveUp = (one: Mission): boolean =>
  one.reason === "goal_lost" ||
  (robots.value ?? []).some((robot) => robot.name === one.robot && robot.state !== "ready");
