/**
 * Turn what fingers, a mouse and its wheel do on the map into a view, taps and drags. Knows no goal:
 * whoever listens says what a finger takes hold of.
 */
import { type Camera, changed, pinned, toPoint } from "./camera";
import type { Point } from "./resolve";

/** Something on the map that follows the finger until it is let go. */
export type Grip = {
  readonly move: (point: Point) => void;
  readonly drop: (point: Point) => void;
  readonly cancel: () => void;
};

export type Touched = {
  readonly camera: () => Camera;
  readonly look: (next: Camera) => void;
  /** A drag aims and does not move the map. */
  readonly aims: () => boolean;
  readonly tap: (point: Point) => void;
  readonly hover: (point: Point) => void;
  /** Return what is taken hold of at once, within so much of the map [m]. */
  readonly grab: (point: Point, withinM: number) => Grip | null;
  /** Return what is taken hold of by a finger that stays. */
  readonly hold: (point: Point, withinM: number) => Grip | null;
};

const HOLD_MS = 550;
const REACH_PX = { mouse: 10, touch: 22 };
const STILL_PX = { mouse: 3, touch: 8 };
const TURN_FROM_RAD = 0.2; // two fingers that zoom are never quite parallel
const WHEEL_PX = 240; // of the wheel for twice the size
const WHEEL_RAD = Math.PI / 12;

type Pressed = { readonly from: Point; readonly pinned: Point; moved: boolean; grip: Grip | null };

export class Gestures {
  private readonly fingers = new Map<number, Point>();
  private pressed: Pressed | null = null;
  private turned = 0; // by the two fingers that are down, before it counts
  private waiting: ReturnType<typeof setTimeout> | undefined;

  constructor(
    private readonly place: HTMLElement,
    private readonly touched: Touched,
  ) {
    place.addEventListener("pointerdown", (event) => this.down(event));
    place.addEventListener("pointermove", (event) => this.move(event));
    place.addEventListener("pointerup", (event) => this.up(event));
    place.addEventListener("pointercancel", (event) => this.lost(event));
    place.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    place.addEventListener("contextmenu", (event) => event.preventDefault()); // a long press is a hold
  }

  private pixel(event: MouseEvent): Point {
    const box = this.place.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  private point(pixel: Point): Point {
    return toPoint(this.touched.camera(), pixel);
  }

  private down(event: PointerEvent): void {
    if (event.button !== 0) return;
    const at = this.pixel(event);
    this.fingers.set(event.pointerId, at);
    clearTimeout(this.waiting);
    if (this.fingers.size > 1) {
      this.pressed?.grip?.cancel();
      this.pressed = null; // two fingers are no tap
      this.turned = 0;
      return;
    }
    const [there, reach] = [this.point(at), REACH_PX[kindOf(event)] / this.touched.camera().scale];
    const grip = this.touched.grab(there, reach);
    this.pressed = { from: at, pinned: there, moved: false, grip };
    if (grip === null) this.waiting = setTimeout(() => this.held(there, reach), HOLD_MS);
  }

  /** Take hold of what lies under a finger that has not moved. */
  private held(there: Point, reach: number): void {
    if (!this.pressed || this.pressed.moved) return;
    this.pressed.grip = this.touched.hold(there, reach);
    this.pressed.grip?.move(there);
  }

  private move(event: PointerEvent): void {
    const at = this.pixel(event);
    const before = this.fingers.get(event.pointerId);
    if (before === undefined) {
      this.touched.hover(this.point(at));
      return;
    }
    if (this.fingers.size > 1) this.pinch(event.pointerId, at);
    this.fingers.set(event.pointerId, at);
    const { pressed } = this;
    if (!pressed || this.fingers.size > 1) return;
    if (!pressed.moved && away(at, pressed.from) <= STILL_PX[kindOf(event)]) return;
    if (!pressed.moved) this.place.setPointerCapture(event.pointerId); // also beside the map
    pressed.moved = true;
    clearTimeout(this.waiting);
    if (pressed.grip) pressed.grip.move(this.point(at));
    else if (this.touched.aims()) this.touched.hover(this.point(at));
    else this.touched.look(pinned(this.touched.camera(), pressed.pinned, at));
  }

  /** Zoom and turn about the middle of two fingers, one of which has moved. */
  private pinch(id: number, at: Point): void {
    const [one, two] = [...this.fingers.values()];
    if (!one || !two || this.fingers.size > 2) return;
    const other = this.fingers.get(id) === one ? two : one;
    const before = this.fingers.get(id) ?? at;
    const zoom = away(at, other) / Math.max(1, away(before, other));
    const raw = Math.atan2(at.y - other.y, at.x - other.x);
    const turn = raw - Math.atan2(before.y - other.y, before.x - other.x);
    const by = Math.atan2(Math.sin(turn), Math.cos(turn));
    const counts = Math.abs(this.turned) >= TURN_FROM_RAD;
    this.turned += by;
    const camera = this.touched.camera();
    const [was, is] = [middle(before, other), middle(at, other)];
    const moved = pinned(camera, toPoint(camera, was), is);
    this.touched.look(changed(moved, zoom, counts ? by : 0, is));
  }

  private up(event: PointerEvent): void {
    clearTimeout(this.waiting);
    if (!this.fingers.delete(event.pointerId)) return;
    const { pressed } = this;
    this.pressed = null;
    if (!pressed) return;
    const there = this.point(this.pixel(event));
    if (pressed.grip) pressed.grip.drop(there);
    else if (!pressed.moved || this.touched.aims()) this.touched.tap(there);
  }

  private lost(event: PointerEvent): void {
    clearTimeout(this.waiting);
    this.fingers.delete(event.pointerId);
    this.pressed?.grip?.cancel();
    this.pressed = null;
  }

  /** Zoom by the wheel; with Shift turn. */
  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const by = event.deltaY || event.deltaX; // some browsers scroll sideways while Shift is down
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 * by : by;
    const [zoom, turn] = event.shiftKey
      ? [1, Math.sign(by) * WHEEL_RAD]
      : [2 ** (-lines / WHEEL_PX), 0];
    this.touched.look(changed(this.touched.camera(), zoom, turn, this.pixel(event)));
  }
}

const kindOf = (event: PointerEvent): "mouse" | "touch" =>
  event.pointerType === "mouse" ? "mouse" : "touch";
const away = (one: Point, other: Point): number => Math.hypot(one.x - other.x, one.y - other.y);
const middle = (one: Point, other: Point): Point => ({
  x: (one.x + other.x) / 2,
  y: (one.y + other.y) / 2,
});
