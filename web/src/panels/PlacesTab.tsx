/** Teach places where the robot stands or at a point of the map, list what was taught, forget. */
import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { byWhom, say, t } from "../i18n";
import { forget, give, teach } from "../state/acts";
import { forgetPick, picked, picking } from "../state/picking";
import { steady } from "../state/steady";
import {
  isGrowing,
  mostTaught,
  pageFresh,
  proposedRooms,
  shownStatus,
  taught,
} from "../state/store";
import type { Pose, Taught } from "../wire/types";
import { fixed } from "./format";

const english = signal("");
const chinese = signal("");
const sending = signal(false);
const doubted = signal<string | null>(null); // whose forgetting is being asked about

export function PlacesTab() {
  useEffect(() => forgetPick, []); // another view wants clicks to be goals again
  return (
    <>
      <ProposedRooms />
      <Teach />
      <List />
    </>
  );
}

async function send(): Promise<void> {
  const [en, zh] = [english.value.trim(), chinese.value.trim()];
  if ((en === "" && zh === "") || sending.value) return;
  sending.value = true;
  const point = picked.value && { x_m: picked.value.x, y_m: picked.value.y };
  const names = { ...(en ? { en } : {}), ...(zh ? { zh } : {}) };
  if (await teach(names, point)) {
    [english.value, chinese.value] = ["", ""];
    forgetPick();
  }
  sending.value = false;
}

const asked = signal<string | null>(null); // the proposed room that is being named
const roomEnglish = signal("");
const roomChinese = signal("");

async function nameRoom(id: string): Promise<void> {
  const [en, zh] = [roomEnglish.value.trim(), roomChinese.value.trim()];
  if ((en === "" && zh === "") || sending.value) return;
  sending.value = true;
  if (await teach({ ...(en ? { en } : {}), ...(zh ? { zh } : {}) }, null, id)) {
    [roomEnglish.value, roomChinese.value] = ["", ""];
    asked.value = null;
  }
  sending.value = false;
}

/** Ask which rooms these are, which were cut out of the map and have no name yet. */
function ProposedRooms() {
  const nameless = proposedRooms.value.filter((room) => room.known_as === null);
  if (nameless.length === 0) return null;
  return (
    <section class="card" aria-labelledby="rooms-title" id="proposed-rooms">
      <h2 id="rooms-title">{t("rooms.which")}</h2>
      <p class="fine">{t("rooms.how")}</p>
      <ul class="taught">
        {nameless.map((room) => (
          <li key={room.id} data-room={room.id}>
            <span class="said">
              <strong>{t("rooms.number", { n: room.id.replace("room_", "") })}</strong>
              <span class="fine">{t("rooms.size", { m2: fixed(room.area_m2, 0) })}</span>
            </span>
            {asked.value === room.id ? (
              <form
                class="names-row"
                onSubmit={(event) => {
                  event.preventDefault();
                  void nameRoom(room.id);
                }}
              >
                <Name id="room-en" words={roomEnglish} label={t("places.en")} lang="en" />
                <Name id="room-zh" words={roomChinese} label={t("places.zh")} lang="zh-CN" />
                <span class="buttons">
                  <button type="submit" class="main" disabled={sending.value}>
                    {t("rooms.keep")}
                  </button>
                  <button type="button" class="quiet" onClick={() => (asked.value = null)}>
                    {t("op.no")}
                  </button>
                </span>
              </form>
            ) : (
              <button type="button" onClick={() => (asked.value = room.id)}>
                {t("rooms.name")}
              </button>
            )}
          </li>
        ))}
      </ul>
    </section>
  );
}

function Teach() {
  const named = english.value.trim() !== "" || chinese.value.trim() !== "";
  return (
    <section class="card" aria-labelledby="teach-title" id="teach">
      <h2 id="teach-title">{t(isGrowing.value ? "rooms.this" : "places.teach")}</h2>
      {isGrowing.value && <p class="fine">{t("rooms.this_how")}</p>}
      <form
        onSubmit={(event) => {
          event.preventDefault();
          void send();
        }}
      >
        <div class="names-row">
          <Name id="teach-en" words={english} label={t("places.en")} lang="en" />
          <Name id="teach-zh" words={chinese} label={t("places.zh")} lang="zh-CN" />
        </div>
        <Where />
        <button type="submit" class="main" disabled={!named || sending.value}>
          {t(picked.value ? "places.keep_point" : "places.keep_here")}
        </button>
      </form>
      <p class="fine">{t("places.how")}</p>
    </section>
  );
}

type NameProps = {
  readonly id: string;
  readonly words: typeof english;
  readonly label: string;
  readonly lang: string;
};

function Name({ id, words, label, lang }: NameProps) {
  return (
    <label class="field" for={id}>
      <span>{label}</span>
      <input
        id={id}
        type="text"
        lang={lang}
        autocomplete="off"
        value={words.value}
        onInput={(event) => (words.value = event.currentTarget.value)}
      />
    </label>
  );
}

const hereNow = steady(() => {
  const pose = shownStatus.value?.base_in_map ?? null;
  return pose && pair(pose); // as it reads
});

/** Choose between where the robot stands and a point that is clicked. */
function Where() {
  const point = picked.value;
  const at = point ? pair({ x_m: point.x, y_m: point.y }) : hereNow.value;
  return (
    <fieldset class="where">
      <legend>{t("places.where")}</legend>
      <div class="buttons">
        <button type="button" aria-pressed={!picking.value && !point} onClick={forgetPick}>
          {t("places.here")}
        </button>
        <button
          type="button"
          aria-pressed={picking.value || point !== null}
          onClick={() => (picking.value = true)}
        >
          {t("places.point")}
        </button>
      </div>
      <p class="fine" role="status">
        {picking.value ? t("places.click") : at ? t("places.at", at) : t("places.nowhere")}
      </p>
    </fieldset>
  );
}

const pair = ({ x_m, y_m }: Pick<Pose, "x_m" | "y_m">): { x: string; y: string } => ({
  x: fixed(x_m, 2),
  y: fixed(y_m, 2),
});

function List() {
  const stale = pageFresh.value ? "" : "stale";
  return (
    <section class={`card ${stale}`} aria-labelledby="taught-title" id="taught">
      <h2 id="taught-title">
        {t("places.taught")}{" "}
        <span class="fine">
          {taught.value.filter((place) => place.why_not !== "other_map").length} /{" "}
          {mostTaught.value}
        </span>
      </h2>
      {taught.value.length === 0 && <p class="fine">{t("places.none")}</p>}
      <ul class="taught">
        {taught.value.map((place) => (
          <Line key={`${place.map_id}/${place.id}`} place={place} />
        ))}
      </ul>
    </section>
  );
}

function Line({ place }: { place: Taught }) {
  const name = say(place.name);
  const asks = doubted.value === place.id;
  const when = new Date(place.taught).toLocaleDateString();
  return (
    <li data-place={place.id} class={place.why_not ? "quiet" : ""}>
      <span class="said">
        <strong dir="auto">{bothNames(place)}</strong>
        <span class="fine">
          {t("places.by", { who: byWhom(place.by), when })} · {t("places.at", pair(place.pose))}
        </span>
        {place.message && <span class="reason">{say(place.message)}</span>}
      </span>
      <span class="buttons">
        {asks ? (
          <>
            <button
              type="button"
              class="main"
              onClick={() => {
                doubted.value = null;
                void forget(place);
              }}
            >
              {t("places.forget_yes")}
            </button>
            <button type="button" class="quiet" onClick={() => (doubted.value = null)}>
              {t("op.no")}
            </button>
          </>
        ) : (
          <>
            {!place.why_not && (
              <button type="button" onClick={() => void give(t("goal.to", { name }))}>
                {t("goal.send")}
              </button>
            )}
            <button
              type="button"
              aria-label={`${t("places.forget")}: ${name}`}
              onClick={() => (doubted.value = place.id)}
            >
              {t("places.forget")}
            </button>
          </>
        )}
      </span>
    </li>
  );
}

const bothNames = ({ name }: Taught): string =>
  name.en === name.zh ? name.en : `${name.en} · ${name.zh}`;
