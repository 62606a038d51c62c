/** Put the drawing, the map's picture and the names into Leaflet. Knows no signal and no goal. */
import * as L from "leaflet";
import type { Candidate, Grid, Place, Pose, ProposedRoom, Thing } from "../wire/types";
import { percent } from "../panels/format";
import { isDark } from "../state/theme";
import { Cells, nameSpot } from "./cells";
import { Drawing } from "./drawing";
import { spreadLabels } from "./labels";
import { colour, picture, tinted } from "./raster";
import type { Point } from "./resolve";
import { Things } from "./things";

const SMALL_PX_PER_M = 38; // below it only rooms have names
const TINTS = ["--tint-0", "--tint-1", "--tint-2", "--tint-3"];

export class MapView {
  readonly drawing = new Drawing();
  private readonly map: L.Map;
  private readonly names = L.layerGroup();
  private readonly roomNumbers = L.layerGroup();
  private readonly guesses = L.layerGroup();
  private readonly things = new Things();
  private image: L.ImageOverlay | null = null;
  private overlays: readonly L.SVGOverlay[] = [];
  private zoom: L.Control.Zoom | null = null;
  private cells: Cells | null = null;
  private shown: L.LatLngBounds | null = null;
  private spreads = false;
  private places: readonly Place[] = [];
  private nameOf: (place: Place) => string = (place) => place.id;

  constructor(
    private readonly place: HTMLElement,
    onClick: (point: Point) => void,
    onHover: (point: Point) => void,
  ) {
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.map = L.map(place, {
      crs: L.CRS.Simple,
      zoomControl: false,
      attributionControl: false,
      zoomSnap: 0,
      zoomDelta: 0.5,
      wheelPxPerZoomLevel: 120,
      minZoom: 2,
      maxZoom: 9,
      zoomAnimation: !still,
      fadeAnimation: false,
      inertia: !still,
      doubleClickZoom: false,
      keyboard: false, // the arrow keys move the crosshair
    });
    this.names.addTo(this.map);
    this.roomNumbers.addTo(this.map);
    this.guesses.addTo(this.map);
    this.things.layer.addTo(this.map);
    this.map.on("click", (event: L.LeafletMouseEvent) =>
      onClick({ x: event.latlng.lng, y: event.latlng.lat }),
    );
    this.map.on("mousemove", (event: L.LeafletMouseEvent) =>
      onHover({ x: event.latlng.lng, y: event.latlng.lat }),
    );
    this.map.on("zoomend", () => this.markSmall());
    new ResizeObserver(() => this.fit()).observe(place);
    isDark.subscribe(() => this.paint());
  }

  showGrid(grid: Grid): void {
    const first = this.cells === null;
    const before = this.shown;
    this.cells = new Cells(grid);
    const { left, bottom, right, top } = this.cells.known();
    this.shown = L.latLngBounds([bottom, left], [top, right]);
    this.drawing.cover(grid);
    const bounds = boundsOf(grid);
    if (first) {
      this.overlays = this.drawing.layers.map((layer) =>
        L.svgOverlay(layer, bounds, { pane: "overlayPane" }).addTo(this.map),
      );
      this.map.fitBounds(this.shown, { animate: false });
    }
    for (const overlay of this.overlays) overlay.setBounds(bounds);
    this.map.setMaxBounds(this.shown.pad(0.5));
    this.paint();
    this.writeNames();
    if (!before?.equals(this.shown)) this.fit(); // a map that grew inside keeps a person's zoom
  }

  showNames(places: readonly Place[], nameOf: (place: Place) => string): void {
    const others = this.places !== places;
    this.places = places;
    this.nameOf = nameOf;
    if (others) this.paint();
    this.writeNames();
  }

  showThings(things: readonly Thing[], nameOf: (thing: Thing) => string): void {
    this.things.show(things, nameOf);
    this.spread();
  }

  /** Draw rooms that wait for a name, each with the number by which it is asked for. */
  showRooms(rooms: readonly ProposedRoom[]): void {
    this.drawing.showRooms(rooms);
    this.roomNumbers.clearLayers();
    for (const { id, pose } of rooms)
      write(`${id.replace("room_", "")}?`, "name name-proposed", pose).addTo(this.roomNumbers);
  }

  /** Draw where the robot might be, each with how well the scan fits there. */
  showGuesses(candidates: readonly Candidate[]): void {
    this.drawing.showGuesses(candidates);
    this.guesses.clearLayers();
    for (const { pose, score } of candidates)
      write(percent(score), "name name-guess", pose).addTo(this.guesses);
  }

  /** Spread labels in the next frame, once for all that changed in this one. */
  private spread(): void {
    if (this.spreads) return;
    this.spreads = true;
    requestAnimationFrame(() => {
      this.spreads = false;
      spreadLabels(this.place);
    });
  }

  private writeNames(): void {
    this.names.clearLayers();
    for (const place of this.places) {
      const { x, y } = nameSpot(place, this.places, this.cells);
      const at = { x_m: x, y_m: y };
      write(this.nameOf(place), `name name-${place.kind}`, at).addTo(this.names);
    }
    this.spread();
  }

  showZoom(zoomInTitle: string, zoomOutTitle: string): void {
    this.zoom?.remove();
    this.zoom = L.control.zoom({ zoomInTitle, zoomOutTitle, position: "topright" }).addTo(this.map);
  }

  /** Show that the next click gives a point and no goal. */
  showPicking(on: boolean): void {
    this.place.classList.toggle("picking", on);
  }

  /** Let a finger or the mouse drag what is aimed at, and not the map. */
  holdStill(still: boolean): void {
    if (still) this.map.dragging.disable();
    else this.map.dragging.enable();
  }

  /** Return the point of the map under a pixel of the window. */
  pointAt(event: MouseEvent): Point {
    const { lat, lng } = this.map.mouseEventToLatLng(event);
    return { x: lng, y: lat };
  }

  /** Show the whole map. */
  showAll(): void {
    this.fit();
  }

  /** Bring a point into view, where it is not well inside. */
  reveal({ x, y }: Point): void {
    this.map.panInside([y, x], { padding: [40, 40], animate: false });
  }

  centre(): Point {
    const { lat, lng } = this.map.getCenter();
    return { x: lng, y: lat };
  }

  /** Return where a point of the map is in the view [px]. */
  pixel({ x, y }: Point): { left: number; top: number } {
    const at = this.map.latLngToContainerPoint([y, x]);
    return { left: at.x, top: at.y };
  }

  close(): void {
    this.map.remove();
  }

  private fit(): void {
    this.map.invalidateSize({ animate: false });
    if (this.shown) this.map.fitBounds(this.shown, { animate: false, padding: [10, 10] });
    this.markSmall();
  }

  private markSmall(): void {
    this.place.classList.toggle("small", 2 ** this.map.getZoom() < SMALL_PX_PER_M);
    this.spread();
  }

  private paint(): void {
    if (this.cells === null) return;
    const floor = tinted(this.places, colour("--floor"), TINTS.map(colour));
    const url = picture(this.cells, floor, colour("--wall"));
    if (url === null) return;
    const bounds = boundsOf(this.cells.grid);
    this.image ??= L.imageOverlay(url, bounds, { className: "cells" }).addTo(this.map);
    this.image.setBounds(bounds);
    this.image.setUrl(url);
    this.image.bringToBack();
  }
}

function write(text: string, className: string, at: Pick<Pose, "x_m" | "y_m">): L.Marker {
  const label = document.createElement("span");
  label.textContent = text; // as text: a name may hold anything
  const icon = L.divIcon({ html: label, className, iconSize: [0, 0] });
  return L.marker([at.y_m, at.x_m], { icon, interactive: false, keyboard: false });
}

function boundsOf(grid: Grid): L.LatLngBounds {
  const { x_m, y_m } = grid.origin;
  return L.latLngBounds(
    [y_m, x_m],
    [y_m + grid.height * grid.resolution_m, x_m + grid.width * grid.resolution_m],
  );
}
