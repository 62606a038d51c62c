/** Offer what can be done with a point of the map: go there, face somewhere, look, draw. */
import { useEffect, useRef } from "preact/hooks";
import { t } from "../i18n";
import { addToRow, beginOutline, closeAll, facing, goTo, menu, moving } from "../state/pointing";
import { isBusy } from "../state/store";
import type { Place } from "../wire/types";
import type { Point } from "./resolve";

export type Target = { readonly id: string; readonly name: string; readonly order: string };

export function PointMenu({
  point,
  targets,
  place,
  at,
  onGo,
}: {
  point: Point;
  targets: readonly Target[];
  place: Place | null;
  at: Point;
  onGo: (order: string, replace: boolean) => void;
}) {
  const box = useRef<HTMLFieldSetElement>(null);
  const [target, ...others] = targets;
  const { x: left, y: top } = at;
  useEffect(() => {
    const element = box.current;
    const within = element?.parentElement;
    if (!element || !within) return;
    const inside = (value: number, most: number): string =>
      `${Math.max(8, Math.min(value, most))}px`;
    element.style.left = inside(left + 12, within.clientWidth - element.offsetWidth - 8);
    element.style.top = inside(top + 12, within.clientHeight - element.offsetHeight - 8);
  }, [left, top]);
  useEffect(() => box.current?.querySelector("button")?.focus({ preventScroll: true }), [point]);
  const here = { x_m: round(point.x), y_m: round(point.y) };
  const busy = isBusy.value;
  const spot = t("point.at", { x: point.x.toFixed(2), y: point.y.toFixed(2) });
  return (
    <fieldset ref={box} class="map-choice point-menu" aria-label={target?.name ?? spot}>
      {target && (
        <>
          <strong class="clip">{busy ? t("map.busy", { name: target.name }) : target.name}</strong>
          <button type="button" class="main" onClick={() => onGo(target.order, busy)}>
            {busy ? t("goal.replace") : t("point.go_place", { name: target.name })}
          </button>
          {busy && (
            <button type="button" onClick={() => onGo(target.order, false)}>
              {t("goal.queue")}
            </button>
          )}
        </>
      )}
      {others.map((other) => (
        <button key={other.id} type="button" onClick={() => onGo(other.order, busy)}>
          {t("point.go_place", { name: other.name })}
        </button>
      ))}
      <strong class="clip">{spot}</strong>
      <span class="point-acts">
        <button type="button" id="point-go" onClick={() => void goTo([here], busy)}>
          {t(busy ? "point.go_instead" : "point.go")}
        </button>
        <button type="button" id="point-face" onClick={() => face(point)}>
          {t("point.face")}
        </button>
        <button type="button" id="point-row" onClick={() => addToRow(here)}>
          {t("point.add")}
        </button>
        <button
          type="button"
          id="point-look"
          onClick={() => void goTo([{ ...here, look: true }], busy)}
        >
          {t("point.look")}
        </button>
        <button type="button" id="mark-out" onClick={() => beginOutline("keep_out", point)}>
          {t("marks.out")}
        </button>
        <button type="button" id="mark-slow" onClick={() => beginOutline("slow", point)}>
          {t("marks.slow")}
        </button>
        {place && (
          <button type="button" id="place-move" onClick={() => move(place, point)}>
            {t("places.move")}
          </button>
        )}
      </span>
      <button type="button" class="quiet" onClick={closeAll}>
        {t("point.close")}
      </button>
    </fieldset>
  );
}

const round = (value: number): number => Math.round(value * 1e3) / 1e3;

function face(point: Point): void {
  menu.value = null;
  facing.value = point;
}

function move(place: Place, point: Point): void {
  closeAll();
  moving.value = { place, to: point };
}
