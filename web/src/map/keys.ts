/** Turn and zoom the map by keys of its own, as its buttons do. */
import { STEP_RAD, STEP_ZOOM } from "./MapButtons";
import type { MapView } from "./view";

/** Do what a key does to a view; false: nothing. */
export function seenOtherwise(view: MapView, key: string): boolean {
  const acts: Readonly<Record<string, () => void>> = {
    "[": () => view.turn(-STEP_RAD),
    "]": () => view.turn(STEP_RAD),
    n: () => view.turn(null),
    "+": () => view.zoom(STEP_ZOOM),
    "=": () => view.zoom(STEP_ZOOM),
    "-": () => view.zoom(1 / STEP_ZOOM),
    "0": () => view.fit(),
  };
  acts[key]?.();
  return key in acts;
}
