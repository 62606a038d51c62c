/** Draw the map's floor as a picture, in each room's tint, also below what stands; unknown see-through. */
import type { Place } from "../wire/types";
import { Cells, FREE, OCCUPIED } from "./cells";
import { contains, type Point } from "./resolve";

export type Rgb = readonly [number, number, number];
export type Floor = (point: Point) => Rgb;

/** Return the picture's pixels, its first row the highest y; null where the cells are not as many. */
export function pixels(cells: Cells, floor: Floor): Uint8ClampedArray | null {
  if (!cells.whole) return null;
  const { width, height } = cells.grid;
  const out = new Uint8ClampedArray(width * height * 4);
  for (let row = 0; row < height; row += 1) {
    for (let column = 0; column < width; column += 1) {
      const cell = cells.at(column, row);
      if (cell !== FREE && cell !== OCCUPIED) continue;
      const at = ((height - 1 - row) * width + column) * 4;
      out.set([...floor(cells.point(column, row)), 255], at);
    }
  }
  return out;
}

/** Return what colours the floor: each room's tint laid over it, the bare floor between rooms. */
export function tinted(places: readonly Place[], bare: Rgb, tints: readonly Rgb[]): Floor {
  const rooms = places
    .filter((place) => place.polygon !== null)
    .map((place, index) => ({
      outline: place.polygon ?? [],
      tint: tints[index % tints.length] ?? bare,
    }));
  return (point) => rooms.find(({ outline }) => contains(outline, point))?.tint ?? bare;
}

/** Return the picture as a data URL, which the page's policy allows for images alone. */
export function picture(cells: Cells, floor: Floor): string | null {
  const data = pixels(cells, floor);
  const canvas = document.createElement("canvas");
  canvas.width = cells.grid.width;
  canvas.height = cells.grid.height;
  const pen = canvas.getContext("2d");
  if (data === null || pen === null) return null;
  const image = pen.createImageData(canvas.width, canvas.height);
  image.data.set(data);
  pen.putImageData(image, 0, 0);
  return canvas.toDataURL("image/png");
}

/** Return a CSS variable's colour, `#rrggbb` or `#rgb`, as numbers. */
export function rgb(text: string): Rgb {
  const digits = text.trim().slice(1);
  const wide = digits.length === 3 ? digits.replace(/./g, "$&$&") : digits;
  const number = Number.parseInt(wide, 16);
  return [(number >> 16) & 255, (number >> 8) & 255, number & 255];
}

export const colour = (name: string): Rgb =>
  rgb(getComputedStyle(document.documentElement).getPropertyValue(name));
