/**
 * Know how metres of the map become pixels of the view: moved, zoomed, turned, fitted. Pure.
 * A map has y up, a view y down; `turn` is how far the map is turned clockwise on the screen [rad].
 */
import type { Box } from "./cells";
import type { Point } from "./resolve";

export const MIN_PX_PER_M = 4;
export const MAX_PX_PER_M = 512;

export type Camera = {
  /** What lies in the middle of the view [m]. */
  readonly x: number;
  readonly y: number;
  readonly scale: number; // pixels a metre
  readonly turn: number;
  readonly width: number; // of the view [px]
  readonly height: number;
};

/** Return pixels from the map's origin, before the view is moved: what panning leaves alone. */
export function unmovedPixel({ scale, turn }: Camera, { x, y }: Point): Point {
  const [right, down] = [scale * x, -scale * y];
  const [cos, sin] = [Math.cos(turn), Math.sin(turn)];
  return { x: right * cos - down * sin, y: right * sin + down * cos };
}

/** Return where the map's origin lies in the view [px]. */
export function originOf(camera: Camera): Point {
  const middle = unmovedPixel(camera, camera);
  return { x: camera.width / 2 - middle.x, y: camera.height / 2 - middle.y };
}

export function toPixel(camera: Camera, point: Point): Point {
  const [origin, at] = [originOf(camera), unmovedPixel(camera, point)];
  return { x: origin.x + at.x, y: origin.y + at.y };
}

export function toPoint(camera: Camera, pixel: Point): Point {
  const [dx, dy] = [pixel.x - camera.width / 2, pixel.y - camera.height / 2];
  const [cos, sin] = [Math.cos(camera.turn), Math.sin(camera.turn)];
  return {
    x: camera.x + (dx * cos + dy * sin) / camera.scale,
    y: camera.y - (dy * cos - dx * sin) / camera.scale,
  };
}

/** Return the view moved so that a point of the map lies under a pixel. */
export function pinned(camera: Camera, point: Point, pixel: Point): Camera {
  const now = toPoint(camera, pixel);
  return { ...camera, x: camera.x + point.x - now.x, y: camera.y + point.y - now.y };
}

/** Return the view zoomed and turned about a pixel, which keeps its point. */
export function changed(camera: Camera, factor: number, by: number, pixel: Point): Camera {
  const scale = Math.min(MAX_PX_PER_M, Math.max(MIN_PX_PER_M, camera.scale * factor));
  const turn = Math.atan2(Math.sin(camera.turn + by), Math.cos(camera.turn + by));
  return pinned({ ...camera, scale, turn }, toPoint(camera, pixel), pixel);
}

/** Return the view in which a box is seen whole, however the map is turned. */
export function fitting(camera: Camera, box: Box, padding: number): Camera {
  const [wide, high] = [box.right - box.left, box.top - box.bottom];
  const [cos, sin] = [Math.abs(Math.cos(camera.turn)), Math.abs(Math.sin(camera.turn))];
  const scale = Math.min(
    (camera.width - 2 * padding) / (wide * cos + high * sin),
    (camera.height - 2 * padding) / (wide * sin + high * cos),
  );
  return {
    ...camera,
    x: (box.left + box.right) / 2,
    y: (box.bottom + box.top) / 2,
    scale: Math.min(MAX_PX_PER_M, Math.max(MIN_PX_PER_M, scale)),
  };
}

/** Return the view whose middle stays over a box: nobody pans the map out of sight. */
export const heldOver = (camera: Camera, box: Box): Camera => ({
  ...camera,
  x: Math.min(box.right, Math.max(box.left, camera.x)),
  y: Math.min(box.top, Math.max(box.bottom, camera.y)),
});

/** Return the view moved as little as brings a point at least so far inside [px]. */
export function revealing(camera: Camera, point: Point, padding: number): Camera {
  const at = toPixel(camera, point);
  const inside = (value: number, size: number): number =>
    size < 2 * padding ? size / 2 : Math.min(size - padding, Math.max(padding, value));
  const to = { x: inside(at.x, camera.width), y: inside(at.y, camera.height) };
  return to.x === at.x && to.y === at.y ? camera : pinned(camera, point, to);
}
