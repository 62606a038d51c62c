/** Let a click on the map give a point to whoever asks for one, instead of a goal. */
import { signal } from "@preact/signals";
import type { Point } from "../map/resolve";

export const picking = signal(false);
/** The point that was clicked last for a place that is to be taught. */
export const picked = signal<Point | null>(null);

/** Takes the next click on the map, where somebody asked for one; null: clicks are goals. */
export const pointAsked = signal<((point: Point) => void) | null>(null);

export function forgetPick(): void {
  picking.value = false;
  picked.value = null;
}
