/** Show drawing, picture and names under one camera. Knows no signal and no goal. */
import { percent } from "../panels/format";
import { isDark } from "../state/theme";
import type { Candidate, Grid, Place, Pose, ProposedRoom, Thing } from "../wire/types";
import {
  type Camera,
  changed,
  fitting,
  heldOver,
  originOf,
  revealing,
  toPixel,
  toPoint,
  unmovedPixel,
} from "./camera";
import { type Box, Cells, nameSpot } from "./cells";
import { type Body, Drawing } from "./drawing";
import { Gestures, type Touched } from "./gestures";
import { boxAround, type PixelBox } from "./labels";
import { colourClass, type Kind, type Nameplate, Nameplates } from "./nameplates";
import { colour, picture, tinted } from "./raster";
import { atOneSpot, type Point } from "./resolve";

const SMALL_PX_PER_M = 38; // below it letters are smaller
const FIT_PX = 10;
const REVEAL_PX = 40;
const SETTLED_MS = 150; // after a pan, names keep off the buttons again
const TINTS = ["--tint-0", "--tint-1", "--tint-2", "--tint-3"];

export type Listening = Omit<Touched, "camera" | "look"> & {
  /** Called in the frame in which the map is seen otherwise. */
  readonly looked: (camera: Camera) => void;
};

export class MapView {
  readonly drawing = new Drawing();
  private readonly plates = new Nameplates();
  private readonly turned = document.createElement("div");
  private readonly image = document.createElement("img");
  private readonly resized: ResizeObserver;
  private readonly unsubscribe: () => void;
  private camera: Camera = { x: 0, y: 0, scale: 1, turn: 0, width: 0, height: 0 };
  private drawn: Camera | null = null;
  private cells: Cells | null = null;
  private known: Box | null = null;
  private framed = false;
  private unplaced = true;
  private settling: ReturnType<typeof setTimeout> | undefined;
  private places: readonly Place[] = [];
  private nameOf: (place: Place) => string = (place) => place.id;
  private spots = new Map<string, Point>();
  private robot: Point | null = null;
  private radius = 0.3;

  constructor(
    private readonly place: HTMLElement,
    private readonly listening: Listening,
  ) {
    this.turned.className = "turned";
    this.image.className = "cells";
    this.image.alt = "";
    this.image.draggable = false;
    this.turned.append(this.image, ...this.drawing.layers);
    place.append(this.turned, this.plates.element);
    new Gestures(place, {
      ...listening,
      camera: () => this.camera,
      look: (next) => this.look(next),
    });
    this.resized = new ResizeObserver(() => this.fit());
    this.resized.observe(place);
    this.unsubscribe = isDark.subscribe(() => this.paint());
  }

  showGrid(grid: Grid): void {
    const before = JSON.stringify(this.known);
    this.cells = new Cells(grid);
    this.known = this.cells.known();
    this.drawing.cover(grid);
    this.drawn = null; // its layers may cover other metres
    this.paint();
    this.spotNames();
    this.writeNames();
    if (before === JSON.stringify(this.known)) this.draw();
    else this.fit(); // a map that grew inside keeps a person's zoom
  }

  showNames(places: readonly Place[], nameOf: (place: Place) => string): void {
    const others = this.places !== places;
    this.places = places;
    this.nameOf = nameOf;
    if (others) {
      this.paint();
      this.spotNames();
    }
    this.writeNames();
  }

  private writeNames(): void {
    for (const kind of ["room", "place"] as const) {
      const those = this.places.filter((place) => place.kind === kind);
      const plate = (place: Place): Nameplate => {
        const at = this.spots.get(place.id) ?? pointOf(place.pose);
        return { id: place.id, text: this.nameOf(place), at };
      };
      this.write(kind, those.map(plate));
    }
  }

  showThings(things: readonly Thing[], nameOf: (thing: Thing) => string): void {
    const plate = (thing: Thing): Nameplate => ({
      id: thing.id,
      text: nameOf(thing),
      at: pointOf(thing),
      more: colourClass(thing.color),
    });
    this.write("thing", things.map(plate));
  }

  /** Number the points of a row, in the order in which they are driven to. */
  showRow(points: readonly Pick<Pose, "x_m" | "y_m">[]): void {
    const plate = (point: Pick<Pose, "x_m" | "y_m">, index: number): Nameplate => ({
      id: String(index),
      text: String(index + 1),
      at: pointOf(point),
    });
    this.write("row", points.map(plate));
  }

  /** Draw rooms that wait for a name, each with the number by which it is asked for. */
  showRooms(rooms: readonly ProposedRoom[]): void {
    this.drawing.showRooms(rooms);
    const plate = ({ id, pose }: ProposedRoom): Nameplate => ({
      id,
      text: `${id.replace("room_", "")}?`,
      at: pointOf(pose),
    });
    this.write("proposed", rooms.map(plate));
  }

  /** Draw where the robot might be, each with how well the scan fits there. */
  showGuesses(candidates: readonly Candidate[]): void {
    this.drawing.showGuesses(candidates);
    const plate = ({ pose, score }: Candidate, index: number): Nameplate => ({
      id: String(index),
      text: percent(score),
      at: pointOf(pose),
    });
    this.write("guess", candidates.map(plate));
  }

  showBody(radius: number): void {
    this.radius = radius;
    this.drawing.showBody(radius);
  }

  showRobot(pose: Pose | null): void {
    this.drawing.showRobot(pose);
    this.robot = pose && pointOf(pose);
    if (this.plates.crowds(this.robotBox())) this.replaceNames();
  }

  /** Draw several robots, each with its name; those that cover each other share a plate. */
  showBodies(bodies: readonly Body[]): void {
    this.drawing.showBodies(bodies);
    const plate = ([first, ...others]: readonly [Body, ...Body[]]): Nameplate => ({
      id: first.id,
      text: [first, ...others].map(({ id }) => id).join("\n"),
      at: pointOf(first.pose),
      radius: first.radius,
    });
    this.write("robot", atOneSpot(bodies).map(plate));
  }

  /** Say whether a name stands nowhere for want of room. */
  isLeftOut(id: string): boolean {
    return this.plates.isLeftOut(id);
  }

  /** Show that the next click gives a point and no goal. */
  showPicking(on: boolean): void {
    this.place.classList.toggle("picking", on);
  }

  /** Show the whole map. */
  fit(): void {
    const { clientWidth: width, clientHeight: height } = this.place;
    if (!this.known || width === 0 || height === 0) return;
    this.look(fitting({ ...this.camera, width, height }, this.known, FIT_PX));
  }

  zoom(factor: number): void {
    this.look(changed(this.camera, factor, 0, this.middle()));
  }

  /** Turn the map clockwise [rad]; null: its top up again. */
  turn(by: number | null): void {
    this.look(changed(this.camera, 1, by ?? -this.camera.turn, this.middle()));
  }

  /** Bring a point into view, where it is not well inside. */
  reveal(point: Point): void {
    this.look(revealing(this.camera, point, REVEAL_PX));
  }

  centre(): Point {
    return toPoint(this.camera, this.middle());
  }

  /** Return where a point of the map is in the view [px]. */
  pixel(point: Point): Point {
    return toPixel(this.camera, point);
  }

  close(): void {
    clearTimeout(this.settling);
    this.resized.disconnect();
    this.unsubscribe();
  }

  private middle(): Point {
    return { x: this.camera.width / 2, y: this.camera.height / 2 };
  }

  private look(next: Camera): void {
    if (next === this.camera) return;
    this.camera = this.known ? heldOver(next, this.known) : next;
    this.draw();
  }

  private write(kind: Kind, plates: readonly Nameplate[]): void {
    if (this.plates.show(kind, plates)) this.replaceNames();
  }

  private replaceNames(): void {
    this.unplaced = true;
    this.draw();
  }

  /** Draw in the next frame, once for all that changed in this one. */
  private draw(): void {
    if (this.framed) return;
    this.framed = true;
    requestAnimationFrame(() => {
      this.framed = false;
      if (this.camera.width > 0) this.frame();
    });
  }

  private frame(): void {
    const { camera, drawn } = this;
    const origin = originOf(camera);
    const moved = `translate(${origin.x}px, ${origin.y}px)`;
    this.turned.style.transform = `${moved} rotate(${camera.turn}rad)`;
    this.plates.element.style.transform = moved;
    const zoomed = drawn?.scale !== camera.scale;
    if (zoomed) this.sizeLayers();
    if (zoomed || drawn?.turn !== camera.turn || this.unplaced) this.placeNames();
    else this.settle();
    this.drawn = camera;
    this.listening.looked(camera);
  }

  /** Lay the layers out for how large a metre is. */
  private sizeLayers(): void {
    const { scale } = this.camera;
    if (this.cells) {
      const { origin, width, height, resolution_m } = this.cells.grid;
      const top = origin.y_m + height * resolution_m;
      for (const { style } of [this.image, ...this.drawing.layers]) {
        style.left = `${scale * origin.x_m}px`;
        style.top = `${-scale * top}px`;
        style.width = `${scale * width * resolution_m}px`;
        style.height = `${scale * height * resolution_m}px`;
      }
    }
    const isSmall = scale < SMALL_PX_PER_M;
    if (this.place.classList.contains("small") === isSmall) return;
    this.place.classList.toggle("small", isSmall);
    this.plates.resize();
  }

  private placeNames(): void {
    this.unplaced = false;
    const origin = originOf(this.camera);
    const view = this.place.getBoundingClientRect();
    const buttons = this.place.parentElement?.querySelectorAll(".map-layers, .map-buttons") ?? [];
    const blocked = [...buttons].map((button): PixelBox => {
      const box = button.getBoundingClientRect();
      const [x, y] = [view.left + origin.x, view.top + origin.y];
      return { left: box.left - x, top: box.top - y, right: box.right - x, bottom: box.bottom - y };
    });
    this.plates.place(this.camera, blocked, this.robotBox());
  }

  private settle(): void {
    clearTimeout(this.settling);
    this.settling = setTimeout(() => this.placeNames(), SETTLED_MS);
  }

  private robotBox(): PixelBox | null {
    if (!this.robot) return null;
    const half = this.camera.scale * this.radius + 2;
    return boxAround(unmovedPixel(this.camera, this.robot), half, half);
  }

  private spotNames(): void {
    this.spots = new Map(
      this.places.map((place) => [place.id, nameSpot(place, this.places, this.cells)]),
    );
  }

  private paint(): void {
    if (this.cells === null) return;
    const floor = tinted(this.places, colour("--floor"), TINTS.map(colour));
    const url = picture(this.cells, floor);
    if (url !== null) this.image.src = url;
  }
}

const pointOf = ({ x_m, y_m }: Pick<Pose, "x_m" | "y_m">): Point => ({ x: x_m, y: y_m });
