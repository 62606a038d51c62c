/**
 * Find room for the labels of the map so that none lies on another, on the robot or on a button. Pure.
 * Who comes first chooses first; a label without room is left out, and its mark tells that there is one.
 */
import type { Point } from "./resolve";

export type PixelBox = {
  readonly left: number;
  readonly top: number;
  readonly right: number;
  readonly bottom: number;
};

export type Label = {
  readonly at: Point; // of what it names [px]
  readonly width: number;
  readonly height: number;
  /** Half of the mark at `at`; 0: the name stands on its point, as a room's does. */
  readonly mark: number;
};

/** Where a label's middle is, and whether a line must lead from it to what it names. */
export type Spot = Point & { readonly leads: boolean };

export const meet = (one: PixelBox, other: PixelBox): boolean =>
  one.left < other.right &&
  other.left < one.right &&
  one.top < other.bottom &&
  other.top < one.bottom;

export const boxAround = ({ x, y }: Point, halfWidth: number, halfHeight: number): PixelBox => ({
  left: x - halfWidth,
  top: y - halfHeight,
  right: x + halfWidth,
  bottom: y + halfHeight,
});

export const boxOf = (label: Label, spot: Point): PixelBox =>
  boxAround(spot, label.width / 2, label.height / 2);

const AROUND: readonly (readonly [number, number])[] = [
  [0, 1],
  [1, 0],
  [-1, 0],
  [0, -1],
  [1, 1],
  [-1, 1],
  [1, -1],
  [-1, -1],
];
const GAP_PX = 3;
/** So far may a label with a line be from its mark, in heights of its own. */
const LEADS = [1.4, 2.6];
const ASIDE = [1.1, 2.2, 3.3];

/** Return the spots that a label may take, the best first. */
export function spotsOf(label: Label): readonly Spot[] {
  const { at, width, height, mark } = label;
  const ring = (away: number, leads: boolean): Spot[] =>
    AROUND.map(([x, y]) => ({
      x: at.x + x * (width / 2 + away),
      y: at.y + y * (height / 2 + away),
      leads,
    }));
  if (mark > 0)
    return [
      ring(mark + GAP_PX, false),
      ...LEADS.map((by) => ring(mark + by * height, true)),
    ].flat();
  const aside = ASIDE.flatMap((by) =>
    AROUND.map(([x, y]) => ({ x: at.x + (x * by * width) / 3, y: at.y + y * by * height })),
  );
  return [at, ...aside].map(({ x, y }) => ({ x, y, leads: false }));
}

const EVERYWHERE: PixelBox = {
  left: Number.NEGATIVE_INFINITY,
  top: Number.NEGATIVE_INFINITY,
  right: Number.POSITIVE_INFINITY,
  bottom: Number.POSITIVE_INFINITY,
};

/** Say whether a box lies wholly within another. */
export const lies = (box: PixelBox, within: PixelBox): boolean =>
  within.left <= box.left &&
  box.right <= within.right &&
  within.top <= box.top &&
  box.bottom <= within.bottom;

/** Return a label's spot, moved so far that the label lies wholly within a view. */
function moveInto(label: Label, { x, y, leads }: Spot, view: PixelBox): Spot {
  const [halfWidth, halfHeight] = [label.width / 2, label.height / 2];
  return {
    x: Math.min(Math.max(x, view.left + halfWidth), view.right - halfWidth),
    y: Math.min(Math.max(y, view.top + halfHeight), view.bottom - halfHeight),
    leads,
  };
}

/**
 * Return a spot for each label, null for one that has no room. `blocked` is never covered; the edge of
 * the view cuts no name of what is in view.
 */
export function placeLabels(
  labels: readonly Label[],
  blocked: readonly PixelBox[],
  view: PixelBox = EVERYWHERE,
): readonly (Spot | null)[] {
  const marks = labels.map(({ at, mark }) => boxAround(at, mark, mark));
  const taken = [...blocked];
  return labels.map((label, index) => {
    const free = (spot: Spot): boolean => {
      const box = boxOf(label, spot);
      if (taken.some((other) => meet(box, other))) return false;
      return !marks.some((mark, other) => (other !== index || label.mark > 0) && meet(box, mark));
    };
    const spots = spotsOf(label);
    const whole = spots.filter((one) => lies(boxOf(label, one), view));
    const moved = spots.map((one) => moveInto(label, one, view));
    const inView = lies(boxAround(label.at, 0, 0), view);
    const spot = (inView ? [...whole, ...moved] : spots).find(free) ?? null;
    if (spot !== null) taken.push(boxOf(label, spot));
    return spot;
  });
}
