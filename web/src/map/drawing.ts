/**
 * Draw what lies and moves on the map as SVG in metres, y up: fence, zones, scan, path, robot.
 * The view scales it; nothing here knows pixels. What moves has a layer of its own, so that a browser
 * paints nothing else for it.
 */
import type { Candidate, Grid, Layers, Mover, Path, Pose, ProposedRoom, Scan } from "../wire/types";
import { contourPath } from "./contours";
import { PointDrawing } from "./pointDrawing";
import { type Point, unwound } from "./resolve";

const SVG = "http://www.w3.org/2000/svg";

type Outline = readonly (readonly [number, number])[];

export const outlineOf = (points: Outline): string =>
  `M${points.map(([x, y]) => `${x} ${y}`).join("L")}`;

const APART_CM = 3; // nearer to the one before, a dot lies under it

/** Return dots: lines of no length with round ends. */
export function dots(scan: Scan): string {
  let path = "";
  let [lastX, lastY] = [Number.NaN, Number.NaN];
  for (let index = 0; index + 1 < scan.length; index += 2) {
    const [x, y] = [scan[index] ?? 0, scan[index + 1] ?? 0];
    if (Math.hypot(x - lastX, y - lastY) < APART_CM) continue;
    [lastX, lastY] = [x, y];
    path += `M${x / 100} ${y / 100}h0`;
  }
  return path;
}

/** Return squares around middles given as x, y, … [cm]. */
export function squares(middles: readonly number[], size: number): string {
  let path = "";
  for (let index = 0; index + 1 < middles.length; index += 2) {
    const x = (middles[index] ?? 0) / 100 - size / 2;
    const y = (middles[index + 1] ?? 0) / 100 - size / 2;
    path += `M${x} ${y}h${size}v${size}h${-size}z`;
  }
  return path;
}

const AHEAD_S = 1; // a mover's line ends where it will be then

/** Return a disc for each thing that moves, and a line to where it goes. */
export function discs(movers: readonly Mover[]): string {
  return movers
    .map(({ x_m: x, y_m: y, vx_mps: vx, vy_mps: vy, radius_m: r }) => {
      const disc = `M${x - r} ${y}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0`;
      return `${disc}M${x} ${y}l${vx * AHEAD_S} ${vy * AHEAD_S}`;
    })
    .join("");
}

const GUESS_M = 0.3;

/** Return an arrowhead for each place where the robot might be, its tip to where it would look. */
export function arrowheads(candidates: readonly Candidate[]): string {
  return candidates
    .map(({ pose: { x_m: x, y_m: y, yaw_rad: yaw } }) => {
      const corner = (turn: number, away: number): string =>
        `${(x + away * Math.cos(yaw + turn)).toFixed(3)} ${(y + away * Math.sin(yaw + turn)).toFixed(3)}`;
      return `M${corner(0, 1.4 * GUESS_M)}L${corner(2.4, GUESS_M)}L${corner(-2.4, GUESS_M)}Z`;
    })
    .join("");
}

function make<K extends keyof SVGElementTagNameMap>(
  name: K,
  attributes: Record<string, string>,
): SVGElementTagNameMap[K] {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  return element;
}

/** Draw a path, where it is another than is drawn: to write the same costs a browser as much. */
const draw = (path: SVGPathElement, d: string): void => {
  if (path.getAttribute("d") !== d) path.setAttribute("d", d);
};

/** Return a robot's disc, with a wedge to the front. */
function bodyOf(radius: number): SVGElement[] {
  const nose = `M${radius * 0.95} 0L${-radius * 0.35} ${radius * 0.55}L${-radius * 0.1} 0L${
    -radius * 0.35
  } ${-radius * 0.55}Z`;
  return [
    make("circle", { class: "halo", r: String(radius * 1.7) }),
    make("circle", { class: "disc", r: String(radius) }),
    make("path", { class: "nose", d: nose }),
  ];
}

const placed = ({ x_m, y_m }: Pose, degrees: number): string =>
  `translate(${x_m}px, ${y_m}px) rotate(${degrees}deg)`;

/** One of several robots on a map. */
export type Body = {
  readonly id: string;
  readonly pose: Pose;
  readonly radius: number;
  readonly stale: boolean;
};

function layer(name: string, ...content: readonly SVGElement[]): SVGSVGElement {
  const svg = make("svg", { class: name, "aria-hidden": "true" });
  const up = make("g", { transform: "scale(1,-1)" });
  up.append(...content);
  svg.append(up);
  return svg;
}

export class Drawing {
  readonly points = new PointDrawing();
  private readonly walls = make("path", { class: "standing" });
  private readonly fence = make("path", { class: "fence" });
  private readonly zones = make("path", { class: "zone" });
  private readonly scan = make("path", { class: "scan" });
  private readonly path = make("path", { class: "way" });
  private readonly goal = make("circle", { class: "way-end", r: "0.14" });
  private readonly doubt = make("circle", { class: "doubt", r: "0.22" });
  private readonly guesses = make("path", { class: "guess" });
  private readonly picked = make("circle", { class: "picked", r: "0.2" });
  private readonly cells = make("path", { class: "obstacle" });
  private readonly suspicions = make("path", { class: "suspicion" });
  private readonly movers = make("path", { class: "mover" });
  private readonly rooms = make("path", { class: "proposed-room" });
  private cellSize = 0.05;
  private readonly robot = make("g", { class: "robot" });
  private degrees = 0;
  private readonly all = make("g", { class: "robots" });
  private readonly bodies = new Map<
    string,
    { readonly element: SVGGElement; readonly degrees: number; readonly radius: number }
  >();
  /** From the lowest up; all cover the same. */
  readonly layers: readonly SVGSVGElement[] = [
    layer("layer", this.walls),
    layer("layer", this.scan),
    layer("layer", this.suspicions, this.cells, this.movers),
    layer(
      "drawing",
      this.zones,
      this.rooms,
      this.fence,
      ...this.points.elements,
      this.path,
      this.goal,
      this.doubt,
      this.guesses,
      this.picked,
    ),
    layer("layer", this.robot, this.all),
  ];

  constructor() {
    this.showBody(0.3);
    this.showRobot(null);
    this.greyRobot(true);
    this.showPath(null);
    this.showPicked(null);
  }

  /** Mark the point at which a place is to be taught. */
  showPicked(point: Point | null): void {
    this.picked.style.display = point ? "" : "none";
    this.picked.setAttribute("cx", String(point?.x ?? 0));
    this.picked.setAttribute("cy", String(point?.y ?? 0));
  }

  /** Draw what the route search remembers and what moves; empty lists hide a layer. */
  showLayers({ cells, suspicions, movers }: Layers): void {
    draw(this.cells, squares(cells, this.cellSize));
    draw(this.suspicions, squares(suspicions, this.cellSize));
    draw(this.movers, discs(movers));
  }

  showFence(on: boolean): void {
    this.fence.style.display = on ? "" : "none";
  }

  /** Draw the outlines of rooms that wait for a name. */
  showRooms(rooms: readonly ProposedRoom[]): void {
    this.rooms.setAttribute("d", rooms.map((room) => `${outlineOf(room.polygon)}Z`).join(""));
  }

  /** Cover a map, in metres. */
  cover(grid: Grid): void {
    this.cellSize = grid.resolution_m;
    this.walls.setAttribute("d", contourPath(grid));
    const { x_m, y_m } = grid.origin;
    const wide = grid.width * grid.resolution_m;
    const high = grid.height * grid.resolution_m;
    for (const svg of this.layers)
      svg.setAttribute("viewBox", `${x_m} ${-(y_m + high)} ${wide} ${high}`);
    const { allowed, keep_outs, speed_zones } = grid.fence;
    const closed = (outlines: readonly Outline[]): string =>
      outlines.map((outline) => `${outlineOf(outline)}Z`).join("");
    this.fence.setAttribute("d", closed([...allowed, ...keep_outs]));
    this.zones.setAttribute("d", closed(speed_zones.map((zone) => zone.polygon)));
  }

  showBody(radius: number): void {
    this.robot.replaceChildren(...bodyOf(radius));
  }

  showRobot(pose: Pose | null): void {
    this.robot.style.display = pose ? "" : "none";
    if (!pose) return;
    this.degrees = unwound(this.degrees, (pose.yaw_rad * 180) / Math.PI);
    this.robot.style.transform = placed(pose, this.degrees);
  }

  /** Draw these robots and no others, beside the one that a robot's own page shows. */
  showBodies(bodies: readonly Body[]): void {
    const before = new Map(this.bodies);
    for (const { id, pose, radius, stale } of bodies) {
      const known = this.bodies.get(id) ?? { element: make("g", {}), degrees: 0, radius: 0 };
      if (known.radius !== radius) known.element.replaceChildren(...bodyOf(radius));
      const degrees = unwound(known.degrees, (pose.yaw_rad * 180) / Math.PI);
      known.element.setAttribute("class", stale ? "robot stale" : "robot");
      known.element.dataset.robot = id;
      known.element.style.transform = placed(pose, degrees);
      if (!before.delete(id)) this.all.append(known.element);
      this.bodies.set(id, { element: known.element, degrees, radius });
    }
    for (const [id, { element }] of before) {
      element.remove();
      this.bodies.delete(id);
    }
  }

  showPath(path: Path | null): void {
    const last = path?.points.at(-1);
    this.path.setAttribute("d", path && last ? outlineOf(path.points) : "");
    this.goal.style.display = last ? "" : "none";
    this.goal.setAttribute("cx", String(last?.[0] ?? 0));
    this.goal.setAttribute("cy", String(last?.[1] ?? 0));
    this.doubt.style.display = path?.doubt ? "" : "none";
    this.doubt.setAttribute("cx", String(path?.doubt?.x_m ?? 0));
    this.doubt.setAttribute("cy", String(path?.doubt?.y_m ?? 0));
  }

  /** Draw where the robot might be, while it looks for where it is. */
  showGuesses(candidates: readonly Candidate[]): void {
    this.guesses.setAttribute("d", arrowheads(candidates));
  }

  showScan(scan: Scan): void {
    this.scan.setAttribute("d", dots(scan));
  }

  /** Draw the robot hollow while scans do not confirm where it is. */
  doubtRobot(doubtful: boolean): void {
    this.robot.classList.toggle("doubtful", doubtful);
  }

  greyRobot(stale: boolean): void {
    this.robot.classList.toggle("stale", stale);
  }

  greyPath(stale: boolean): void {
    this.path.classList.toggle("stale", stale);
    this.goal.classList.toggle("stale", stale);
  }

  greyScan(stale: boolean): void {
    this.scan.classList.toggle("stale", stale);
  }
}
