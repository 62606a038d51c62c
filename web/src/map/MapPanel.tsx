/** Show the map; a click on it, or Enter at the crosshair, opens what can be done there. */
import { computed, effect, signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { things } from "../eyes/sight";
import { orderTo } from "../eyes/words";
import { say, t } from "../i18n";
import { seconds, wayLeft, when } from "../panels/format";
import { toTeaching } from "../panels/Tabs";
import { followGhost } from "../rehearse/ghost";
import { give } from "../state/acts";
import { tell } from "../state/note";
import { startArrivals, toGo } from "../state/arrival";
import { fresh } from "../state/moment";
import { picked, picking, pointAsked } from "../state/picking";
import {
  addCorner,
  addToRow,
  closeAll,
  crosshair,
  drawn,
  dropPlace,
  facing,
  goTo,
  gripCorner,
  gripPlace,
  marksShown,
  menu,
  moving,
  row,
  startPointing,
  trail,
} from "../state/pointing";
import { steady } from "../state/steady";
import {
  about,
  age,
  candidates,
  grid,
  isBusy,
  layers,
  now,
  pageFresh,
  pageHeard,
  path,
  places,
  poseDoubtful,
  poseLost,
  proposedRooms,
  scan,
  scanFresh,
  status,
} from "../state/store";
import { visible } from "../state/visible";
import type { Pose } from "../wire/types";
import type { Camera } from "./camera";
import { Cells } from "./cells";
import { isShown, LAYERS, toggleLayer } from "./layers";
import { seenOtherwise } from "./keys";
import { MapButtons } from "./MapButtons";
import { MarkList, MapTools } from "./MapTools";
import { headingTo, stepped } from "./outline";
import { PointMenu, type Target } from "./PointMenu";
import { type Point, placeAt, resolve, thingAt } from "./resolve";
import { samePose, sameScan } from "./unmoved";
import { MapView } from "./view";

const follows = signal(false);
/** How the map is seen; changes in the frame that shows it so. */
const camera = signal<Camera | null>(null);
const spot = computed(() => {
  const [point, view] = [menu.value, shownView.value];
  return point && camera.value && view ? view.pixel(point) : null;
});

export function MapPanel() {
  const place = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (place.current === null) return;
    const view = new MapView(place.current, {
      tap: clicked,
      hover: (point) => (hovered.value = point),
      aims: () => facing.value !== null,
      grab: gripCorner,
      hold: (point, withinM) => {
        const target = drawn.value ? null : placeAt(places.value, point, withinM);
        return target && gripPlace(target);
      },
      looked: (next) => (camera.value = next),
    });
    shownView.value = view;
    const ends = [startPointing(), startArrivals(), closingByEscape(), ...follow(view)];
    ends.push(() => view.close());
    return () => {
      for (const end of ends) end();
    };
  }, []);
  return (
    <section class="map-panel" aria-label={t("map.label")}>
      <div
        ref={place}
        class="map"
        id="map"
        role="application"
        aria-label={t("point.keys")}
        tabIndex={0}
        onKeyDown={pressed}
      />
      <div class="map-notes">
        <Ages />
        <ByItsWheels />
        <WhyItBends />
        <ToGo />
      </div>
      {shownView.value && <MapButtons view={shownView.value} turn={camera.value?.turn ?? 0} />}
      <LayerSwitches />
      <Growing />
      <MapTools />
      {menu.value && spot.value && (
        <PointMenu
          point={menu.value}
          targets={targetsAt(menu.value)}
          place={placeAt(places.value, menu.value, MOVED_M)}
          at={spot.value}
          onGo={(order, replace) => void go(order, replace)}
        />
      )}
    </section>
  );
}

/** Say how much of the home is known while it is mapped. */
function Growing() {
  const shown = grid.value;
  if (!shown?.growing) return null;
  const known = new Cells(shown).floor;
  return (
    <div class="growing">
      <span>{t("map.growing", { area: known.toFixed(0) })}</span>
      <button type="button" id="which-room" onClick={toTeaching}>
        {t("rooms.this")}
      </button>
    </div>
  );
}

/** Keep the drawing to the signals; return what ends it. */
function follow(view: MapView): (() => void)[] {
  const { drawing } = view;
  return [
    effect(() => {
      if (grid.value) view.showGrid(grid.value);
    }),
    effect(() => {
      view.showNames(places.value, (shown) => say(shown.name)); // and again in another language
    }),
    effect(() => view.showThings(things.value, (shown) => say(shown.name))),
    effect(() => {
      if (about.value) view.showBody(about.value.base.radius_m);
    }),
    effect(() => drawing.showPicked(picked.value)),
    effect(() => view.showPicking(picking.value || pointAsked.value !== null)),
    effect(() => drawing.showPath(path.value)),
    followGhost(drawing),
    effect(() => view.showGuesses(candidates.value)),
    effect(() => drawing.greyPath(!pageFresh.value)),
    effect(() => seen(() => drawing.showScan(isShown("scan") ? scanNow.value : []))),
    effect(() => seen(() => drawing.showLayers(layersNow.value))),
    effect(() => view.showRooms(isShown("rooms") ? nameless.value : [])),
    effect(() => drawing.greyScan(!scanFresh.value)),
    effect(() => drawing.showFence(isShown("fence"))),
    effect(() => seen(() => view.showRobot(poseNow.value))),
    effect(() => drawing.doubtRobot(poseDoubtful.value)),
    effect(() => drawing.points.showMarks(marksShown.value)),
    effect(() => drawing.points.showDrawn(drawn.value)),
    effect(() => {
      drawing.points.showRow(row.value);
      view.showRow(row.value);
    }),
    effect(() => {
      const move = moving.value;
      drawing.points.showMove(move && pointOf(move.place), move?.to ?? null);
    }),
    effect(() => seen(() => drawing.points.showTrail(isShown("trail") ? trail.value : []))),
    effect(() => {
      const from = facing.value;
      const to = hovered.value;
      drawing.points.showAim(
        from ?? menu.value ?? crosshair.value,
        from && to ? headingTo(from, to) : null,
      );
    }),
    effect(() => {
      const pose = poseNow.value;
      if (follows.value && pose) view.reveal({ x: pose.x_m, y: pose.y_m });
    }),
    effect(() => drawing.greyRobot(!poseFresh.value)),
  ];
}

/** Draw only while somebody can see it; whoever comes back sees what is so then. */
function seen(draw: () => void): void {
  if (visible.value) draw();
}

const scanNow = steady(() => scan.value, sameScan);
const layersNow = steady(() => {
  const { cells, suspicions, movers } = layers.value;
  const remembered = isShown("obstacles");
  return {
    cells: remembered ? cells : [],
    suspicions: remembered ? suspicions : [],
    movers: isShown("movers") ? movers : [],
  };
});
const nameless = computed(() => proposedRooms.value.filter((room) => room.known_as === null));
const poseNow = steady(() => status.value?.base_in_map ?? null, samePose);
const poseFresh = computed(() => fresh(poseAge()));

/** The pose is the bridge's, made of localization: it is as old as the older of the two. */
function poseAge(): number | null {
  const [bridge, localization] = [age("status"), age("localization")];
  return bridge === null || localization === null ? null : Math.max(bridge, localization);
}

const MOVED_M = 0.45; // a click so near to a place may move it
const LISTED_PX = 40;
const MOST_LISTED = 6;
const hovered = signal<Point | null>(null);
const shownView = signal<MapView | null>(null);

/** Close what is open on the map by Esc; it stops the robot as well, always and first (stop/keys.ts). */
function closingByEscape(): () => void {
  const close = (event: KeyboardEvent): void => {
    if (event.key !== "Escape") return;
    const had = document.activeElement?.closest(".point-menu") !== null;
    closeAll();
    if (had) document.getElementById("map")?.focus({ preventScroll: true });
  };
  addEventListener("keydown", close);
  return () => removeEventListener("keydown", close);
}

/** Move the crosshair by the arrow keys; Enter does there what a click would. */
function pressed(event: KeyboardEvent): void {
  const view = shownView.value;
  if (!view || event.target !== event.currentTarget) return;
  if (event.ctrlKey || event.metaKey || event.altKey) return; // the browser's own
  if (seenOtherwise(view, event.key)) {
    event.preventDefault();
    return;
  }
  const pose = poseNow.value;
  const from = crosshair.value ?? (pose ? pointOf({ pose }) : view.centre());
  if (event.key === "Enter") {
    event.preventDefault();
    clicked(from);
    return;
  }
  const to = stepped(from, event.key, event.shiftKey, camera.value?.turn ?? 0);
  if (!to) return;
  event.preventDefault();
  crosshair.value = hovered.value = to;
  view.reveal(to);
}

const pointOf = ({ pose }: { readonly pose: Pose }): Point => ({ x: pose.x_m, y: pose.y_m });

function faceTo(point: Point): void {
  const from = facing.value;
  const yaw = from && headingTo(from, point);
  if (!from || yaw === null) return;
  const goal = { x_m: from.x, y_m: from.y, yaw_rad: yaw };
  if (row.value.length > 0) addToRow(goal);
  else void goTo([goal], isBusy.value);
}

function clicked(point: Point): void {
  menu.value = null;
  if (facing.value) {
    faceTo(point); // where the pointer let go counts
    return;
  }
  if (moving.value) {
    moving.value = { ...moving.value, to: point };
    void dropPlace();
    return;
  }
  if (drawn.value) {
    addCorner(point);
    return;
  }
  const asked = pointAsked.value;
  if (asked !== null) {
    pointAsked.value = null;
    asked(point);
    return;
  }
  if (picking.value) {
    picked.value = point;
    picking.value = false;
    return;
  }
  menu.value = point;
}

/** Return what is meant by a point, and beside it what had no room for its name there. */
function targetsAt(point: Point): readonly Target[] {
  const near = (at: Point): boolean =>
    Math.hypot(at.x - point.x, at.y - point.y) <= LISTED_PX / (camera.value?.scale ?? 1);
  const hidden = (id: string): boolean => shownView.value?.isLeftOut(id) ?? false;
  const meant = [thingAt(things.value, point), resolve(places.value, point)];
  const first = meant.find((one) => one !== null) ?? null;
  const unnamed = [
    ...places.value.filter((place) => near(pointOf(place)) && hidden(place.id)),
    ...things.value.filter((one) => near({ x: one.x_m, y: one.y_m }) && hidden(one.id)),
  ];
  const all = [...(first ? [first] : []), ...unnamed.filter((one) => one.id !== first?.id)];
  return all.slice(0, MOST_LISTED).map((one): Target => {
    const name = say(one.name);
    return { id: one.id, name, order: "pose" in one ? t("goal.to", { name }) : orderTo(one) };
  });
}

async function go(text: string, replace: boolean): Promise<void> {
  menu.value = null;
  if (await give(text, replace)) tell(t("goal.sent", { text }));
}

/** Switch layers of the map on and off. */
function LayerSwitches() {
  return (
    <details class="map-layers" id="layers">
      <summary>{t("map.layers")}</summary>
      {LAYERS.map((name) => (
        <label key={name}>
          <input
            type="checkbox"
            checked={isShown(name)}
            data-layer={name}
            onChange={() => toggleLayer(name)}
          />
          <span class={`layer-swatch swatch-of-${name}`} aria-hidden="true" />
          {t(`map.layer_${name}`)}
        </label>
      ))}
      {(["out", "slow"] as const).map((name) => (
        <span key={name} class="legend">
          <span class={`layer-swatch swatch-of-${name}`} aria-hidden="true" />
          {t(`legend.${name}`)}
        </span>
      ))}
      <MarkList />
      <span class="map-seen">
        <button type="button" onClick={() => shownView.value?.fit()}>
          {t("map.fit")}
        </button>
        <button
          type="button"
          aria-pressed={follows.value}
          onClick={() => (follows.value = !follows.value)}
        >
          {t("map.follow")}
        </button>
      </span>
    </details>
  );
}

function Ages() {
  const old = [
    poseFresh.value ? null : aged("map.stale", "map.no_pose", poseAge()),
    scanFresh.value ? null : aged("map.scan_stale", "map.no_scan", age("scan")),
  ].filter((text) => text !== null);
  if (!pageHeard.value || old.length === 0) return null;
  return <p class="map-ages">{old.join(" · ")}</p>;
}

/** Say how old something on the map is; what never came is not old but missing. */
function aged(
  old: "map.stale" | "map.scan_stale",
  never: "map.no_pose" | "map.no_scan",
  ageS: number | null,
) {
  return ageS === null ? t(never) : t(old, { age: seconds(ageS) });
}

/** Say how far it is still, how long that takes, and when it will be there. */
function ToGo() {
  const left = pageFresh.value ? toGo.value : null;
  if (left === null) return null;
  const wallMs = now.value.wallMs;
  const facts = [
    t("step.to_go", { left: wayLeft(left.left) }),
    left.stepsAfter > 0 ? t("map.stops_after", { n: String(left.stepsAfter) }) : "",
    left.seconds === null ? "" : t("map.about", { time: seconds(left.seconds) }),
    left.seconds === null || left.seconds < AT_S
      ? ""
      : t("map.there_at", { time: when(wallMs + 1000 * left.seconds, wallMs) }),
  ];
  return (
    <p class="map-ages" id="to-go">
      {facts.filter(Boolean).join(" · ")}
    </p>
  );
}

const AT_S = 60; // sooner, nobody looks at a clock

/** Say why the way bends, or goes on towards something; the spot is marked on the map. */
function WhyItBends() {
  const doubt = path.value?.doubt;
  if (!doubt || !pageFresh.value) return null;
  return (
    <p class="map-why" id="doubt" data-code={doubt.code} role="status">
      {say(doubt.message)}
    </p>
  );
}

/** Say that the newest scans do not confirm what is drawn; the strip above says so of a lost pose. */
function ByItsWheels() {
  if (!pageFresh.value || !poseDoubtful.value || poseLost.value !== null) return null;
  return <p class="map-why">{t("here.now_coasting")}</p>;
}
