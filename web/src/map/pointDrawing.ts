/** Draw what people point at and draw on the map: marks, an outline in the making, a row, a trail. */
import { type Outline } from "./outline";
import type { Point } from "./resolve";
import type { GoalPoint, Marks } from "../net/marks";
import type { Drawn } from "../state/pointing";

const SVG = "http://www.w3.org/2000/svg";
const CORNER_M = 0.07;
const ARROW_M = 0.45;

const line = (points: Outline): string => points.map(([x, y]) => `${x} ${y}`).join("L");
const closed = (outlines: readonly Outline[]): string =>
  outlines.map((outline) => `M${line(outline)}Z`).join("");

const ring = (x: number, y: number, r: number): string =>
  `M${x - r} ${y}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0`;

/** Return a ring at a point, and a line to where the robot is to look. */
export function pose(x: number, y: number, yaw: number | undefined): string {
  const end = yaw === undefined ? "" : `l${ARROW_M * Math.cos(yaw)} ${ARROW_M * Math.sin(yaw)}`;
  return `${ring(x, y, 0.12)}M${x} ${y}${end}`;
}

export class PointDrawing {
  private readonly keepOuts = path("mark-out");
  private readonly slow = path("mark-slow");
  private readonly trail = path("trail");
  private readonly outline = path("mark-drawn");
  private readonly corners = path("mark-corner");
  private readonly row = path("point-row");
  private readonly aim = path("point-aim");
  private readonly move = path("place-move");
  /** From the lowest up. */
  readonly elements: readonly SVGPathElement[] = [
    this.slow,
    this.keepOuts,
    this.trail,
    this.row,
    this.outline,
    this.corners,
    this.aim,
    this.move,
  ];

  showMarks(marks: Marks | null): void {
    this.keepOuts.setAttribute("d", closed(marks?.keep_outs ?? []));
    this.slow.setAttribute("d", closed((marks?.speed_zones ?? []).map((zone) => zone.polygon)));
  }

  showDrawn(drawn: Drawn | null): void {
    const corners = drawn?.corners ?? [];
    this.outline.setAttribute("d", corners.length > 1 ? closed([corners]) : "");
    this.outline.classList.toggle("slow", drawn?.kind === "slow");
    this.corners.setAttribute("d", corners.map(([x, y]) => ring(x, y, CORNER_M)).join(""));
  }

  showRow(points: readonly GoalPoint[]): void {
    const way = points.map(({ x_m, y_m }): readonly [number, number] => [x_m, y_m]);
    const poses = points.map(({ x_m, y_m, yaw_rad }) => pose(x_m, y_m, yaw_rad)).join("");
    this.row.setAttribute("d", points.length > 1 ? `${poses}M${line(way)}` : poses); // numbered by its names
  }

  showTrail(trail: Outline): void {
    this.trail.setAttribute("d", trail.length > 1 ? `M${line(trail)}` : "");
  }

  /** Show from where a place is moved, and where to. */
  showMove(from: Point | null, to: Point | null): void {
    const line = from && to ? `M${from.x} ${from.y}L${to.x} ${to.y}${ring(to.x, to.y, 0.15)}` : "";
    this.move.setAttribute("d", line);
  }

  /** Show the point that is pointed at, with a heading where one is being given. */
  showAim(at: Point | null, yaw: number | null): void {
    this.aim.setAttribute("d", at ? pose(at.x, at.y, yaw ?? undefined) : "");
  }
}

function path(name: string): SVGPathElement {
  const element = document.createElementNS(SVG, "path");
  element.setAttribute("class", name);
  return element;
}
