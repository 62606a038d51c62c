/** Show the robots of one map on it; where robots have several maps, one is chosen. */
import { computed, effect, signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { say } from "../i18n";
import type { Camera } from "../map/camera";
import type { Body } from "../map/drawing";
import { MapButtons } from "../map/MapButtons";
import { seenOtherwise } from "../map/keys";
import { MapView } from "../map/view";
import type { Robot } from "./decode";
import { link, maps, robots } from "./fleet";
import { ft } from "./words";

const wanted = signal<string | null>(null);
const camera = signal<Camera | null>(null);
const shownView = signal<MapView | null>(null);

/** The robots by the map that they show, most first. */
export const byMap = computed(() => {
  const found = new Map<string, Robot[]>();
  for (const robot of robots.value ?? []) {
    if (robot.map === null || !maps.value.has(robot.map)) continue;
    found.set(robot.map, [...(found.get(robot.map) ?? []), robot]);
  }
  return [...found].sort(([, one], [, other]) => other.length - one.length);
});

const shownMap = computed(() => {
  const known = byMap.value.map(([digest]) => digest);
  return known.find((digest) => digest === wanted.value) ?? known[0] ?? null;
});
const grid = computed(() => (shownMap.value === null ? null : maps.value.get(shownMap.value)));

/** Bring the map of a robot up. */
export const lookAt = (robot: Robot): void => void (wanted.value = robot.map);

const bodies = computed((): Body[] =>
  (byMap.value.find(([digest]) => digest === shownMap.value)?.[1] ?? []).flatMap((robot) =>
    robot.base_in_map === null
      ? []
      : [
          {
            id: robot.name,
            pose: robot.base_in_map,
            radius: robot.radius_m,
            stale: robot.state !== "ready" || link.value !== "good",
          },
        ],
  ),
);

export function FleetMap() {
  const place = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (place.current === null) return;
    const view = new MapView(place.current, {
      tap: () => undefined,
      hover: () => undefined,
      aims: () => false,
      grab: () => null,
      hold: () => null,
      looked: (next) => (camera.value = next),
    });
    view.drawing.showFence(false);
    view.showRobot(null);
    shownView.value = view;
    const ends = [
      effect(() => {
        if (!grid.value) return;
        view.showGrid(grid.value);
        view.showNames(grid.value.places, (shown) => say(shown.name));
      }),
      effect(() => view.showBodies(bodies.value)),
    ];
    return () => {
      for (const end of ends) end();
      view.close();
    };
  }, []);
  return (
    <section class="map-panel" aria-label={ft("map.label")}>
      <div
        ref={place}
        class="map"
        id="map"
        role="application"
        aria-label={ft("map.keys")}
        tabIndex={0}
        onKeyDown={(event) => {
          if (event.ctrlKey || event.metaKey || event.altKey || !shownView.value) return;
          if (seenOtherwise(shownView.value, event.key)) event.preventDefault();
        }}
      />
      {grid.value && shownView.value && (
        <MapButtons view={shownView.value} turn={camera.value?.turn ?? 0} />
      )}
      {!grid.value && <p class="fleet-no-map fine">{ft("map.none")}</p>}
      {byMap.value.length > 1 && (
        <div class="fleet-maps" role="group" aria-label={ft("map.which")}>
          {byMap.value.map(([digest, those]) => (
            <button
              key={digest}
              type="button"
              class="clip"
              aria-pressed={digest === shownMap.value}
              onClick={() => (wanted.value = digest)}
            >
              {those[0]?.site ?? digest.slice(0, 6)}: {those.map(({ name }) => name).join(", ")}
            </button>
          ))}
        </div>
      )}
    </section>
  );
}
