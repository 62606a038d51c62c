import { describe, expect, it } from "vitest";
import {
  boxAround,
  boxOf,
  type Label,
  lies,
  meet,
  placeLabels,
  type PixelBox,
  spotsOf,
} from "../src/map/labels";
import { someNumbers } from "./numbers";

const label = (x: number, y: number, mark = 4, width = 60): Label => ({
  at: { x, y },
  width,
  height: 14,
  mark,
});

type World = { readonly labels: readonly Label[]; readonly blocked: readonly PixelBox[] };

/** Crowded and empty maps of a phone: 1 to 50 labels, rooms first, and a robot. */
const worlds = (): World[] =>
  Array.from({ length: 60 }, (_, index) => {
    const rows = someNumbers(1 + ((index * 7) % 50), 4, index + 1);
    const labels = rows.map(([x = 0, y = 0, w = 0], at) =>
      label(195 * x, 170 * y, at < 5 ? 0 : 5, 50 + 30 * w),
    );
    const [[x = 0, y = 0] = []] = someNumbers(1, 2, index + 99);
    return { labels, blocked: [boxAround({ x: 195 * x, y: 170 * y }, 14, 14)] };
  });

describe("labels", () => {
  it("never lie on each other, on the robot or on the mark of another", () => {
    for (const { labels, blocked } of worlds()) {
      const spots = placeLabels(labels, blocked);
      const boxes = labels.flatMap((one, index) => {
        const spot = spots[index];
        return spot ? [boxOf(one, spot)] : [];
      });
      boxes.forEach((box, index) => {
        expect(boxes.slice(index + 1).some((other) => meet(box, other))).toBe(false);
        expect(blocked.some((other) => meet(box, other))).toBe(false);
      });
      labels.forEach((one, index) => {
        const [spot, others] = [spots[index], labels.filter((other) => other !== one)];
        const on = others.some(
          ({ at, mark }) => spot && meet(boxOf(one, spot), boxAround(at, mark, mark)),
        );
        expect(on).toBe(false);
      });
    }
  });

  it("are left out only where each of their spots is taken", () => {
    for (const { labels, blocked } of worlds()) {
      const spots = placeLabels(labels, blocked);
      labels.forEach((one, index) => {
        if (spots[index] !== null) return;
        const before = labels.slice(0, index).flatMap((other, at) => {
          const spot = spots[at];
          return spot ? [boxOf(other, spot)] : [];
        });
        const marks = labels.filter((other) => other !== one);
        const hard = [...blocked, ...before, ...marks.map((o) => boxAround(o.at, o.mark, o.mark))];
        for (const spot of spotsOf(one))
          expect(hard.some((box) => meet(boxOf(one, spot), box))).toBe(true);
      });
    }
  });

  it("give way to none that comes later, and are the same each time", () => {
    for (const { labels, blocked } of worlds()) {
      expect(placeLabels(labels, blocked)).toEqual(placeLabels(labels, blocked));
      const rooms = labels.filter(({ mark }) => mark === 0);
      const alone = placeLabels(rooms, [
        ...blocked,
        ...labels.filter(({ mark }) => mark > 0).map(({ at, mark }) => boxAround(at, mark, mark)),
      ]);
      expect(placeLabels(labels, blocked).slice(0, rooms.length)).toEqual(alone);
    }
  });

  it("lead by a line only where they stand away from their mark", () => {
    expect(placeLabels([label(0, 0)], [])).toEqual([{ x: 0, y: 14, leads: false }]);
    const ring = boxAround({ x: 0, y: 0 }, 30, 12);
    const [spot] = placeLabels([label(0, 0)], [ring]);
    expect(spot?.leads).toBe(true);
    expect(placeLabels([label(0, 0)], [boxAround({ x: 0, y: 0 }, 500, 500)])).toEqual([null]);
  });

  it("are never cut by the edge of the view, but where what they name is outside it", () => {
    const view = { left: 0, top: 0, right: 100, bottom: 100 };
    expect(placeLabels([label(500, 50)], [], view)[0]).toEqual({ x: 500, y: 64, leads: false });
    for (let crowd = 1; crowd <= 12; crowd++) {
      const labels = Array.from({ length: crowd }, (_, n) => label((n * 37) % 100, (n * 61) % 100));
      const spots = placeLabels(labels, [], view);
      expect(spots[0]).not.toBeNull();
      spots.forEach((spot, n) => {
        if (spot) expect(lies(boxOf(labels[n] as Label, spot), view)).toBe(true);
      });
    }
  });

  it("of rooms stand on their point where that is free", () => {
    expect(placeLabels([label(5, 6, 0)], [])).toEqual([{ x: 5, y: 6, leads: false }]);
  });
});
