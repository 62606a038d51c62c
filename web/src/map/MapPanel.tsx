/** Show the map; a click on it, or Enter at the crosshair, opens what can be done there. */
import { computed, effect, signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { things } from "../eyes/sight";
import { orderTo } from "../eyes/words";
import { say, t } from "../i18n";
import { fixed, seconds } from "../panels/format";
import { toTeaching } from "../panels/Tabs";
import { followGhost } from "../rehearse/ghost";
import { give, tell } from "../state/acts";
import { fresh } from "../state/moment";
import { picked, picking, pointAsked } from "../state/picking";
import {
  addCorner,
  addToRow,
  crosshair,
  drawn,
  facing,
  goTo,
  marksShown,
  menu,
  row,
  startPointing,
  toGo,
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
import { Cells } from "./cells";
import { isShown, LAYERS, toggleLayer } from "./layers";
import { MarkList, MapTools } from "./MapTools";
import { headingTo, stepped } from "./outline";
import { PointMenu, type Target } from "./PointMenu";
import { type Point, resolve, thingAt } from "./resolve";
import { samePose, sameScan } from "./unmoved";
import { MapView } from "./view";

const spot = signal({ left: 0, top: 0 });
const follows = signal(false);

export function MapPanel() {
  const place = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (place.current === null) return;
    const view: MapView = new MapView(
      place.current,
      (point) => clicked(point, view),
      (point) => (hovered.value = point),
    );
    shownView.value = view;
    const ends = [startPointing(), ...follow(view), () => view.close()];
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
        onPointerUp={turnedTo}
      />
      <div class="map-notes">
        <Ages />
        <ByItsWheels />
        <WhyItBends />
        <ToGo />
      </div>
      <LayerSwitches />
      <Growing />
      <MapTools />
      {menu.value && (
        <PointMenu
          point={menu.value}
          target={targetAt(menu.value)}
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
    effect(() => view.showZoom(t("map.zoom_in"), t("map.zoom_out"))),
    effect(() => {
      if (about.value) drawing.showBody(about.value.base.radius_m);
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
    effect(() => seen(() => drawing.showRobot(poseNow.value))),
    effect(() => drawing.doubtRobot(poseDoubtful.value)),
    effect(() => drawing.points.showMarks(marksShown.value)),
    effect(() => drawing.points.showDrawn(drawn.value)),
    effect(() => drawing.points.showRow(row.value)),
    effect(() => seen(() => drawing.points.showTrail(isShown("trail") ? trail.value : []))),
    effect(() => {
      const from = facing.value;
      const to = hovered.value;
      drawing.points.showAim(
        from ?? menu.value ?? crosshair.value,
        from && to ? headingTo(from, to) : null,
      );
    }),
    effect(() => view.holdStill(facing.value !== null)),
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

const hovered = signal<Point | null>(null);
const shownView = signal<MapView | null>(null);

/** Move the crosshair by the arrow keys; Enter does there what a click would. */
function pressed(event: KeyboardEvent): void {
  const view = shownView.value;
  if (!view || event.target !== event.currentTarget) return;
  const pose = poseNow.value;
  const from = crosshair.value ?? (pose ? { x: pose.x_m, y: pose.y_m } : view.centre());
  if (event.key === "Enter") {
    event.preventDefault();
    if (facing.value && crosshair.value) faceTo(crosshair.value);
    else clicked(from, view);
    return;
  }
  const to = stepped(from, event.key, event.shiftKey);
  if (!to) return;
  event.preventDefault();
  crosshair.value = hovered.value = to;
  view.reveal(to);
}

/** Take the heading where the mouse or finger lets go. */
function turnedTo(event: PointerEvent): void {
  const view = shownView.value;
  if (facing.value && view) faceTo(view.pointAt(event));
}

function faceTo(point: Point): void {
  const from = facing.value;
  const yaw = from && headingTo(from, point);
  if (!from || yaw === null) return;
  const goal = { x_m: from.x, y_m: from.y, yaw_rad: yaw };
  if (row.value.length > 0) addToRow(goal);
  else void goTo([goal], isBusy.value);
}

function clicked(point: Point, view: MapView): void {
  menu.value = null;
  if (facing.value) return; // where the pointer let go counts
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
  spot.value = view.pixel(point);
  menu.value = point;
}

function targetAt(point: Point): Target | null {
  const thing = thingAt(things.value, point);
  if (thing !== null) return { name: say(thing.name), order: orderTo(thing) };
  const place = resolve(places.value, point);
  if (place === null) return null;
  const name = say(place.name);
  return { name, order: t("goal.to", { name }) };
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
      {(["fence", "out", "slow"] as const).map((name) => (
        <span key={name} class="legend">
          <span class={`layer-swatch swatch-of-${name}`} aria-hidden="true" />
          {t(`legend.${name}`)}
        </span>
      ))}
      <MarkList />
      <span class="map-buttons">
        <button type="button" onClick={() => shownView.value?.showAll()}>
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

/** Say how far it is still, and how long that takes at the speed of late. */
function ToGo() {
  const left = pageFresh.value ? toGo.value : null;
  if (left === null) return null;
  const far = t("step.to_go", { left: fixed(left.left, 1, "m") });
  const long = left.seconds === null ? "" : ` · ${t("map.about", { time: seconds(left.seconds) })}`;
  return (
    <p class="map-ages" id="to-go">
      {far}
      {long}
    </p>
  );
}

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
