/** Put the drawing, the map's picture and the names into Leaflet. Knows no signal and no goal. */
import * as L from "leaflet";
import type { Grid, Place } from "../wire/types";
import { Drawing } from "./drawing";
import { colour, picture } from "./raster";
import { middle, type Point } from "./resolve";

const SMALL_PX_PER_M = 38; // below it only rooms have names

export class MapView {
  readonly drawing = new Drawing();
  private readonly map: L.Map;
  private readonly names = L.layerGroup();
  private image: L.ImageOverlay | null = null;
  private zoom: L.Control.Zoom | null = null;
  private grid: Grid | null = null;

  constructor(
    private readonly place: HTMLElement,
    onClick: (point: Point) => void,
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
    });
    this.names.addTo(this.map);
    this.map.on("click", (event: L.LeafletMouseEvent) =>
      onClick({ x: event.latlng.lng, y: event.latlng.lat }),
    );
    this.map.on("zoomend", () => this.markSmall());
    new ResizeObserver(() => this.fit()).observe(place);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.paint());
  }

  showGrid(grid: Grid): void {
    const first = this.grid === null;
    this.grid = grid;
    const bounds = boundsOf(grid);
    this.drawing.cover(grid);
    if (first) {
      L.svgOverlay(this.drawing.svg, bounds, { pane: "overlayPane" }).addTo(this.map);
      this.map.fitBounds(bounds, { animate: false });
    }
    this.map.setMaxBounds(bounds.pad(0.5));
    this.paint();
    this.fit();
  }

  showNames(places: readonly Place[], nameOf: (place: Place) => string): void {
    this.names.clearLayers();
    this.drawing.showRooms(places);
    for (const place of places) {
      const { x, y } = place.polygon
        ? middle(place.polygon)
        : { x: place.pose.x_m, y: place.pose.y_m };
      const label = document.createElement("span");
      label.textContent = nameOf(place); // as text: a name may hold anything
      const icon = L.divIcon({
        html: label,
        className: `name name-${place.kind}`,
        iconSize: [0, 0],
      });
      L.marker([y, x], { icon, interactive: false, keyboard: false }).addTo(this.names);
    }
  }

  showZoom(zoomInTitle: string, zoomOutTitle: string): void {
    this.zoom?.remove();
    this.zoom = L.control.zoom({ zoomInTitle, zoomOutTitle, position: "topright" }).addTo(this.map);
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
    if (this.grid) this.map.fitBounds(boundsOf(this.grid), { animate: false, padding: [6, 6] });
    this.markSmall();
  }

  private markSmall(): void {
    this.place.classList.toggle("small", 2 ** this.map.getZoom() < SMALL_PX_PER_M);
  }

  private paint(): void {
    if (!this.grid) return;
    const url = picture(this.grid, colour("--floor"), colour("--wall"));
    if (url === null) return;
    this.image ??= L.imageOverlay(url, boundsOf(this.grid), { className: "cells" }).addTo(this.map);
    this.image.setUrl(url);
    this.image.bringToBack();
  }
}

function boundsOf(grid: Grid): L.LatLngBounds {
  const { x_m, y_m } = grid.origin;
  return L.latLngBounds(
    [y_m, x_m],
    [y_m + grid.height * grid.resolution_m, x_m + grid.width * grid.resolution_m],
  );
}
