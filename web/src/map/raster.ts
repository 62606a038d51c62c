/** Draw the map's cells as a picture: walls and floor in the theme's colours, unknown see-through. */
import type { Grid } from "../wire/types";

const FREE = 0;
const OCCUPIED = 1;

export type Rgb = readonly [number, number, number];

/** Return the picture's pixels, its first row the highest y; null where the cells are not as many. */
export function pixels(grid: Grid, floor: Rgb, wall: Rgb): Uint8ClampedArray | null {
  const cells = atob(grid.cells);
  if (cells.length !== grid.width * grid.height) return null;
  const out = new Uint8ClampedArray(cells.length * 4);
  for (let row = 0; row < grid.height; row += 1) {
    for (let column = 0; column < grid.width; column += 1) {
      const cell = cells.charCodeAt(row * grid.width + column);
      if (cell !== FREE && cell !== OCCUPIED) continue;
      const at = ((grid.height - 1 - row) * grid.width + column) * 4;
      out.set([...(cell === FREE ? floor : wall), 255], at);
    }
  }
  return out;
}

/** Return the picture as a data URL, which the page's policy allows for images alone. */
export function picture(grid: Grid, floor: Rgb, wall: Rgb): string | null {
  const data = pixels(grid, floor, wall);
  const canvas = document.createElement("canvas");
  canvas.width = grid.width;
  canvas.height = grid.height;
  const pen = canvas.getContext("2d");
  if (data === null || pen === null) return null;
  const image = pen.createImageData(grid.width, grid.height);
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
