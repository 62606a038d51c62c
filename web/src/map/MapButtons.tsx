/** Zoom and turn the map by buttons; the compass shows how far it is turned, and turns it back. */
import { t } from "../i18n";
import type { MapView } from "./view";

export const STEP_RAD = Math.PI / 8;
export const STEP_ZOOM = Math.SQRT2;

export function MapButtons({ view, turn }: { view: MapView; turn: number }) {
  const isUp = Math.abs(turn) < 0.01;
  return (
    <div class="map-buttons" role="group" aria-label={t("map.buttons")}>
      <button type="button" aria-label={t("map.zoom_in")} onClick={() => view.zoom(STEP_ZOOM)}>
        +
      </button>
      <button type="button" aria-label={t("map.zoom_out")} onClick={() => view.zoom(1 / STEP_ZOOM)}>
        −
      </button>
      <button type="button" aria-label={t("map.turn")} onClick={() => view.turn(STEP_RAD)}>
        ↻
      </button>
      {!isUp && (
        <button type="button" id="compass" aria-label={t("map.up")} onClick={() => view.turn(null)}>
          <svg viewBox="-10 -10 20 20" aria-hidden="true" style={{ rotate: `${turn}rad` }}>
            <path d="M0 -9L5 0H-5Z" class="north" />
            <path d="M0 9L5 0H-5Z" class="south" />
          </svg>
        </button>
      )}
    </div>
  );
}
