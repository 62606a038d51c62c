/** Keep labels from lying on each other: the later one waits until a person zooms in. */

export type Box = Pick<DOMRect, "left" | "top" | "right" | "bottom">;

const overlap = (one: Box, other: Box): boolean =>
  one.left < other.right &&
  other.left < one.right &&
  one.top < other.bottom &&
  other.top < one.bottom;

/** Tell of each box whether it lies on a fixed one or on an earlier one that is shown. */
export function crowded(boxes: readonly Box[], fixed: readonly Box[]): boolean[] {
  const shown = [...fixed];
  return boxes.map((box) => {
    const hidden = shown.some((other) => overlap(box, other));
    if (!hidden) shown.push(box);
    return hidden;
  });
}

/** Hide the names of things that lie on the name of a room, a place or another thing. */
export function spreadLabels(map: HTMLElement): void {
  const labels = [...map.querySelectorAll<HTMLElement>(".thing span")];
  const names = [...map.querySelectorAll(".name span")];
  const boxOf = (element: Element): Box => element.getBoundingClientRect();
  const hidden = crowded(labels.map(boxOf), names.map(boxOf));
  labels.forEach((label, index) => label.classList.toggle("crowded", hidden[index]));
}
