/** Show the map, and make a click on it a goal: at once when idle, after a choice when busy. */
import { computed, effect, signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { things } from "../eyes/sight";
import { orderTo } from "../eyes/words";
import { say, t } from "../i18n";
import { seconds } from "../panels/format";
import { toTeaching } from "../panels/Tabs";
import { followGhost } from "../rehearse/ghost";
import { give, tell } from "../state/acts";
import { fresh } from "../state/moment";
import { picked, picking, pointAsked } from "../state/picking";
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
import { type Point, resolve, thingAt } from "./resolve";
import { samePose, sameScan } from "./unmoved";
import { MapView } from "./view";

/** What a click means: its name, and the order to go there. */
type Target = { readonly name: string; readonly order: string };
type Choice = Target & { readonly left: number; readonly top: number };

const choice = signal<Choice | null>(null);

export function MapPanel() {
  const place = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (place.current === null) return;
    const view: MapView = new MapView(place.current, (point) => clicked(point, view));
    const ends = [...follow(view), () => view.close()];
    return () => {
      for (const end of ends) end();
    };
  }, []);
  return (
    <section class="map-panel" aria-label={t("map.label")}>
      <div ref={place} class="map" id="map" />
      <div class="map-notes">
        <Ages />
        <ByItsWheels />
        <WhyItBends />
      </div>
      <LayerSwitches />
      <Growing />
      {choice.value && <Ask choice={choice.value} />}
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

function clicked(point: Point, view: MapView): void {
  choice.value = null;
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
  const target = targetAt(point);
  if (target === null) {
    tell(t("map.nothing"));
  } else if (isBusy.value) {
    choice.value = { ...target, ...view.pixel(point) };
  } else {
    void go(target.order, false);
  }
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
  choice.value = null;
  if (await give(text, replace)) tell(t("goal.sent", { text }));
}

function Ask({ choice: { name, order, left, top } }: { choice: Choice }) {
  const box = useRef<HTMLFieldSetElement>(null);
  useEffect(() => {
    const element = box.current;
    const within = element?.parentElement;
    if (!element || !within) return;
    const most = within.clientWidth - element.offsetWidth - 8;
    element.style.left = `${Math.max(8, Math.min(left, most))}px`;
    element.style.top = `${Math.max(8, Math.min(top, within.clientHeight - element.offsetHeight - 8))}px`;
    element.querySelector("button")?.focus();
  }, [left, top]);
  return (
    <fieldset ref={box} class="map-choice" aria-label={name}>
      <strong class="clip">{t("map.busy", { name })}</strong>
      <button type="button" class="main" onClick={() => void go(order, true)}>
        {t("goal.replace")}
      </button>
      <button type="button" onClick={() => void go(order, false)}>
        {t("goal.queue")}
      </button>
      <button type="button" class="quiet" onClick={() => (choice.value = null)}>
        {t("op.no")}
      </button>
    </fieldset>
  );
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
