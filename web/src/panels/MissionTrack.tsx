/** Draw a mission's way on the map, and what the recording holds at the time that is chosen. */
import { computed, useSignal } from "@preact/signals";
import { rowWords, t, word } from "../i18n";
import { Cells } from "../map/cells";
import { contourPath } from "../map/contours";
import { colour, picture, tinted } from "../map/raster";
import { grid } from "../state/store";
import type { Track, TrackSample } from "../wire/missions";
import type { Grid } from "../wire/types";
import { fixed } from "./format";

const MARGIN_M = 1;
const ROBOT_M = 0.25;

type Known = TrackSample & {
  readonly x_m: number;
  readonly y_m: number;
  readonly yaw_rad: number;
};

const isKnown = (one: TrackSample): one is Known => one.x_m !== null;

const floor = computed(() => {
  const cells = grid.value === null ? null : new Cells(grid.value);
  return cells && picture(cells, tinted([], colour("--floor"), []));
});

/** Return the box of the drawing: around the way, y down as a screen has it. */
export function frame(way: readonly Known[]): readonly [number, number, number, number] {
  const xs = way.map((one) => one.x_m);
  const ys = way.map((one) => -one.y_m);
  const [left, top] = [Math.min(...xs) - MARGIN_M, Math.min(...ys) - MARGIN_M];
  return [left, top, Math.max(...xs) + MARGIN_M - left, Math.max(...ys) + MARGIN_M - top];
}

export function MissionTrack({ track }: { track: Track }) {
  const at = useSignal(0);
  const last = track.samples.length - 1;
  const now = track.samples[Math.min(at.value, last)];
  if (now === undefined) return <p class="fine">{t("missions.no_recording")}</p>;
  const way = track.samples.filter(isKnown);
  return (
    <>
      {way.length > 0 && <Way way={way} now={now} />}
      <label class="scrub">
        {t("missions.time")}
        <input
          type="range"
          min={0}
          max={last}
          value={at.value}
          aria-valuetext={sentence(now)}
          onInput={(event) => (at.value = Number(event.currentTarget.value))}
        />
      </label>
      <p class="fine now">{sentence(now)}</p>
      {track.gaps.length > 0 && <p class="fine">{t("missions.gaps")}</p>}
    </>
  );
}

function sentence(now: TrackSample): string {
  const facts = { s: fixed(now.s, 1, "s"), asked: fixed(now.asked_mps, 2, "m/s") };
  const measured = fixed(now.measured_mps, 2, "m/s");
  const mode = word("mode", now.mode);
  return [t("missions.at", { ...facts, measured, mode }), ...now.rows.map(rowWords)].join(" · ");
}

function Way({ way, now }: { way: readonly Known[]; now: TrackSample }) {
  const line = way.map((one) => `${one.x_m},${-one.y_m}`).join(" ");
  return (
    <svg
      class="mission-way"
      viewBox={frame(way).join(" ")}
      role="img"
      aria-label={t("missions.way")}
    >
      {grid.value !== null && floor.value !== null && <Floor of={grid.value} href={floor.value} />}
      <polyline points={line} />
      {isKnown(now) && (
        <g
          transform={`translate(${now.x_m} ${-now.y_m}) rotate(${(-now.yaw_rad * 180) / Math.PI})`}
        >
          <circle r={ROBOT_M} />
          <line x2={2 * ROBOT_M} />
        </g>
      )}
    </svg>
  );
}

function Floor({ of, href }: { of: Grid; href: string }) {
  const [width, height] = [of.width * of.resolution_m, of.height * of.resolution_m];
  const y = -of.origin.y_m - height;
  return (
    <>
      <image href={href} x={of.origin.x_m} y={y} width={width} height={height} />
      <path class="standing" transform="scale(1,-1)" d={contourPath(of)} />
    </>
  );
}
