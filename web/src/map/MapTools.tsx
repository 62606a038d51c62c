/** Show what is being given on the map: a heading, a row of points, an outline; and list the marks. */
import { say, t } from "../i18n";
import {
  addCorner,
  bringCorner,
  changeMark,
  crosshair,
  deleteMark,
  drawn,
  facing,
  goTo,
  marking,
  marksShown,
  moving,
  row,
  saveOutline,
  saving,
  sendOut,
  slowMps,
  undoCorner,
} from "../state/pointing";
import { isBusy } from "../state/store";
import { flawOf } from "./outline";

const SPEEDS = [0.1, 0.15, 0.2, 0.3];

export function MapTools() {
  if (facing.value) return <Facing />;
  if (moving.value) return <Moving name={say(moving.value.place.name)} />;
  if (drawn.value) return <Drawing />;
  return row.value.length > 0 ? <Row /> : null;
}

function Facing() {
  return (
    <div class="map-tools" role="status">
      <span>{t("point.facing")}</span>
      <button type="button" class="quiet" onClick={() => (facing.value = null)}>
        {t("point.close")}
      </button>
    </div>
  );
}

function Moving({ name }: { name: string }) {
  return (
    <div class="map-tools" role="status" id="moving">
      <span>{t("places.moving", { name })}</span>
      <button type="button" class="quiet" onClick={() => (moving.value = null)}>
        {t("point.close")}
      </button>
    </div>
  );
}

function Row() {
  return (
    <div class="map-tools" id="row">
      <span role="status">{t("point.row", { n: String(row.value.length) })}</span>
      <button
        type="button"
        class="main"
        onClick={() => {
          void goTo(row.value, isBusy.value);
          row.value = [];
        }}
      >
        {t("point.go_row")}
      </button>
      <button type="button" onClick={() => (row.value = row.value.slice(0, -1))}>
        {t("marks.undo")}
      </button>
      <button type="button" class="quiet" onClick={() => (row.value = [])}>
        {t("point.close")}
      </button>
    </div>
  );
}

function Drawing() {
  const now = drawn.value;
  if (!now) return null;
  const flaw = flawOf(now.corners);
  const speeds = SPEEDS.includes(slowMps.value) ? SPEEDS : [...SPEEDS, slowMps.value];
  return (
    <div class="map-tools" id="outline">
      <span role="status">
        {t(now.kind === "slow" ? "marks.drawing_slow" : "marks.drawing_out", {
          n: String(now.corners.length),
        })}
        {flaw && now.corners.length >= 3 ? ` ${t(`marks.flaw_${flaw}`)}` : ""}
        {now.corners.length >= 3 && <small class="fine"> {t("marks.drag")}</small>}
        {now.exit && ` ${t("marks.holds", { metres: now.exit.metres.toFixed(1) })}`}
        {now.leaves && ` ${t("marks.leaving")}`}
      </span>
      {now.exit && (
        <button type="button" class="main" id="mark-leave" onClick={() => void sendOut()}>
          {t("marks.leave")}
        </button>
      )}
      {now.kind === "slow" && (
        <select
          aria-label={t("marks.speed")}
          value={String(slowMps.value)}
          onChange={(event) => (slowMps.value = Number(event.currentTarget.value))}
        >
          {speeds.map((speed) => (
            <option key={speed} value={String(speed)}>
              {t("marks.at_most", { speed: String(speed) })}
            </option>
          ))}
        </select>
      )}
      <button
        type="button"
        class="main"
        id="mark-save"
        disabled={flaw !== null || saving.value}
        onClick={() => void saveOutline()}
      >
        {t("marks.save")}
      </button>
      {crosshair.value && (
        <>
          <button type="button" onClick={() => crosshair.value && addCorner(crosshair.value)}>
            {t("marks.corner")}
          </button>
          <button type="button" onClick={() => crosshair.value && bringCorner(crosshair.value)}>
            {t("marks.bring")}
          </button>
        </>
      )}
      <button type="button" onClick={undoCorner}>
        {t("marks.undo")}
      </button>
      <button type="button" class="quiet" onClick={() => (drawn.value = null)}>
        {t("point.close")}
      </button>
    </div>
  );
}

/** List the marks beside the legend; each can be changed or deleted. */
export function MarkList() {
  const marks = marksShown.value;
  if (!marks || marks.keep_outs.length + marks.speed_zones.length === 0) return null;
  return (
    <ul class="mark-list" aria-label={t("marks.list")}>
      {marks.keep_outs.map((_, at) => (
        <Mark key={`o${at}`} kind="keep_out" at={at} name={t("marks.out_n", { n: `${at + 1}` })} />
      ))}
      {marks.speed_zones.map((zone, at) => (
        <Mark
          key={`s${at}`}
          kind="slow"
          at={at}
          name={t("marks.slow_n", { n: `${at + 1}`, speed: String(zone.max_speed_mps) })}
        />
      ))}
      {marking.value && !marking.value.agreed && <li class="bad">{t("marks.disagree")}</li>}
    </ul>
  );
}

function Mark({ kind, at, name }: { kind: "keep_out" | "slow"; at: number; name: string }) {
  return (
    <li>
      <span>{name}</span>
      <button
        type="button"
        aria-label={`${t("marks.again")}: ${name}`}
        disabled={saving.value}
        onClick={() => changeMark(kind, at)}
      >
        {t("marks.again")}
      </button>
      <button
        type="button"
        aria-label={`${t("marks.delete")}: ${name}`}
        disabled={saving.value}
        onClick={() => void deleteMark(kind, at)}
      >
        {t("marks.delete")}
      </button>
    </li>
  );
}
