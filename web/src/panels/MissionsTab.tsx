/** List what the robot was told, by day, and show one mission whole, with its recording. */
import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { say, t, word } from "../i18n";
import {
  failed,
  load,
  look,
  missions,
  more,
  share,
  shown,
  STATES,
  track,
  wanted,
} from "../state/missions";
import { goals } from "../state/store";
import type { Mission, MissionRow } from "../wire/missions";
import { clock, fixed, seconds } from "./format";
import { Steps } from "./Turn";
import { MissionTrack } from "./MissionTrack";

const SEARCH_MS = 250;

export function MissionsTab() {
  const changed = goals.value.map((goal) => goal.id + goal.state).join();
  const asked = wanted.value;
  useEffect(() => void load(), [asked, changed]);
  return shown.value === null ? <List /> : <One mission={shown.value} />;
}

function List() {
  const rows = missions.value;
  return (
    <section class="card" aria-labelledby="missions-title" id="missions">
      <h2 id="missions-title">{t("missions.title")}</h2>
      <Filter />
      {failed.value && <p class="reason">{t("missions.failed")}</p>}
      {rows?.length === 0 && <p class="fine">{t("missions.none")}</p>}
      {byDay(rows ?? []).map(([day, found]) => (
        <div key={day}>
          <h3>{day}</h3>
          <ol class="missions">
            {found.map((row) => (
              <li key={row.id}>
                <Row row={row} />
              </li>
            ))}
          </ol>
        </div>
      ))}
      {more.value !== null && (
        <button type="button" onClick={() => void load(more.value)}>
          {t("missions.more")}
        </button>
      )}
    </section>
  );
}

const dayOf = (unixS: number): string =>
  new Date(unixS * 1000).toLocaleDateString(document.documentElement.lang, {
    weekday: "long",
    year: "numeric",
    month: "long",
    day: "numeric",
  });

/** Return rows by their day, in their order. */
export function byDay(rows: readonly MissionRow[]): readonly [string, readonly MissionRow[]][] {
  const days = new Map<string, MissionRow[]>();
  for (const row of rows) {
    const day = dayOf(row.created_unix_s);
    days.set(day, [...(days.get(day) ?? []), row]);
  }
  return [...days];
}

function Filter() {
  const waiting = useRef<ReturnType<typeof setTimeout>>(undefined);
  const set = (change: Partial<typeof wanted.value>): void => {
    wanted.value = { ...wanted.value, ...change };
  };
  return (
    <div class="names-row">
      <label>
        {t("missions.day")}
        <input
          type="date"
          value={wanted.value.day}
          onInput={(event) => set({ day: event.currentTarget.value })}
        />
      </label>
      <label>
        {t("missions.state")}
        <select onInput={(event) => set({ state: event.currentTarget.value })}>
          <option value="">{t("missions.any")}</option>
          {STATES.map((state) => (
            <option key={state} value={state} selected={wanted.value.state === state}>
              {word("state", state)}
            </option>
          ))}
        </select>
      </label>
      <label>
        {t("missions.search")}
        <input
          type="search"
          defaultValue={wanted.value.search}
          onInput={(event) => {
            const search = event.currentTarget.value;
            clearTimeout(waiting.current);
            waiting.current = setTimeout(() => set({ search }), SEARCH_MS);
          }}
        />
      </label>
    </div>
  );
}

function Row({ row }: { row: MissionRow }) {
  const took = row.seconds === null ? "" : seconds(row.seconds);
  const far = row.metres > 0 ? fixed(row.metres, 1, "m") : "";
  const facts = [clock(row.created_unix_s * 1000), took, far, row.source].filter(Boolean);
  return (
    <button type="button" class="mission" onClick={() => void look(row.id)}>
      <span class="said">
        <strong dir="auto">{row.text}</strong>
        <span class="fine">{facts.join(" · ")}</span>
      </span>
      <span class={`chip state-${row.state}`}>{word("state", row.state)}</span>
    </button>
  );
}

function One({ mission }: { mission: Mission }) {
  const { goal, story, usage } = mission;
  const back = useRef<HTMLButtonElement>(null);
  useEffect(() => back.current?.focus(), [goal.id]);
  const price = usage.currency ? ` · ${usage.goal?.money.toFixed(4)} ${usage.currency}` : "";
  return (
    <section class="card" aria-labelledby="mission-title" id="mission">
      <button ref={back} type="button" onClick={() => void look(null)}>
        {t("missions.back")}
      </button>
      <h2 id="mission-title" dir="auto">
        {goal.text}
      </h2>
      <p>
        <span class={`chip state-${goal.state}`}>{word("state", goal.state)}</span>{" "}
        <span class="fine">{t("missions.by", { who: story.source })}</span>
      </p>
      {goal.outcome && <p dir="auto">{say(goal.outcome.message)}</p>}
      {goal.plan && <Steps steps={goal.plan.steps} goal={goal.id} />}
      {story.replies.map((reply, at) => (
        <p key={at} class="fine" dir="auto">
          {story.questions[at]} → {reply}
        </p>
      ))}
      <ol class="log">
        {story.changes.map((change) => (
          <li key={change.at_unix_s}>
            <time>{clock(change.at_unix_s * 1000)}</time>
            <span>{word("state", change.state)}</span>
          </li>
        ))}
      </ol>
      {usage.goal !== null && usage.goal.calls > 0 && (
        <p class="fine">
          {t("missions.calls", { n: `${usage.goal.calls}`, model: usage.model ?? "–" })}
          {price}
        </p>
      )}
      <h3>{t("missions.way")}</h3>
      {track.value === null ? (
        <p class="fine">{t("missions.loading")}</p>
      ) : (
        <MissionTrack key={goal.id} track={track.value} />
      )}
      <Share id={goal.id} />
    </section>
  );
}

function Share({ id }: { id: string }) {
  const saving = useSignal(false);
  return (
    <>
      <button
        type="button"
        disabled={saving.value}
        onClick={() => {
          saving.value = true;
          void share(id).then(() => (saving.value = false));
        }}
      >
        {t("missions.save")}
      </button>
      <p class="fine">{t("missions.share", { id })}</p>
    </>
  );
}
