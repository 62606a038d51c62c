import { describe, expect, it } from "vitest";
import { arrowheads, discs, dots, squares } from "../src/map/drawing";
import { Cells, nameSpot } from "../src/map/cells";
import { pixels, rgb, tinted } from "../src/map/raster";
import { atOneSpot, contains, middle, resolve, thingAt, unwound } from "../src/map/resolve";
import type { Grid, Place } from "../src/wire/types";
import { cup } from "./examples";

const pose = (x_m: number, y_m: number) => ({ x_m, y_m, yaw_rad: 0 });
const square = [
  [0, 0],
  [3, 0],
  [3, 3],
  [0, 3],
] as const;
const room: Place = {
  id: "kitchen",
  kind: "room",
  name: { en: "kitchen", zh: "厨房" },
  polygon: square,
  pose: pose(1.5, 1.5),
};
const sofa: Place = {
  id: "sofa",
  kind: "place",
  name: { en: "sofa", zh: "沙发" },
  polygon: null,
  pose: pose(1, 1),
};
const desk: Place = { ...sofa, id: "desk", pose: pose(1.3, 1) };

describe("a click", () => {
  it("means the nearest place where one is near", () => {
    expect(resolve([room, sofa, desk], { x: 1.1, y: 1 })?.id).toBe("sofa");
    expect(resolve([room, sofa, desk], { x: 1.25, y: 1 })?.id).toBe("desk");
  });

  it("means the room elsewhere, and nothing outside", () => {
    expect(resolve([room, sofa], { x: 2.5, y: 2.5 })?.id).toBe("kitchen");
    expect(resolve([room, sofa], { x: 3.5, y: 2.5 })).toBeNull();
    expect(resolve([], { x: 1, y: 1 })).toBeNull();
  });
});

describe("a click on a thing", () => {
  it("means the nearest one under it, and none where it lies beside all", () => {
    const near = { ...cup, id: "cup_2", x_m: 1.2 };
    expect(thingAt([cup, near], { x: 1.15, y: 2 })?.id).toBe("cup_2");
    expect(thingAt([cup, near], { x: 1.05, y: 1.9 })?.id).toBe("cup_1");
    expect(thingAt([cup, near], { x: 1, y: 2.3 })).toBeNull();
  });
});

describe("polygons", () => {
  it("hold their inside, notches left out", () => {
    const notched = [
      [0, 0],
      [4, 0],
      [4, 4],
      [2, 4],
      [2, 2],
      [0, 2],
    ] as const;
    expect(contains(notched, { x: 1, y: 1 })).toBe(true);
    expect(contains(notched, { x: 1, y: 3 })).toBe(false);
    expect(contains(notched, { x: 3, y: 3 })).toBe(true);
  });

  it("have a middle", () => {
    expect(middle(square)).toEqual({ x: 1.5, y: 1.5 });
  });
});

describe("headings", () => {
  it("turn the short way round", () => {
    expect(unwound(170, -170)).toBe(190);
    expect(unwound(190, -160)).toBe(200);
    expect(unwound(-179, 179)).toBe(-181);
    expect(unwound(0, 90)).toBe(90);
    expect(unwound(725, 0)).toBe(720);
  });
});

describe("the picture", () => {
  const grid = {
    width: 2,
    height: 2,
    resolution_m: 1,
    origin: { x_m: 0, y_m: 0 },
    cells: btoa("\x00\x01\x02\x00"),
  } as Grid;

  it("has its first row at the top, unknown see-through", () => {
    const data = pixels(new Cells(grid), () => [1, 2, 3]);
    expect([...(data ?? [])]).toEqual([0, 0, 0, 0, 1, 2, 3, 255, 1, 2, 3, 255, 1, 2, 3, 255]);
  });

  it("is none where cells are missing", () => {
    expect(pixels(new Cells({ ...grid, height: 3 }), () => [0, 0, 0])).toBeNull();
  });

  it("lays each room's tint over its floor alone", () => {
    const floor = tinted([sofa, room], [9, 9, 9], [[1, 1, 1]]);
    expect(floor({ x: 1, y: 1 })).toEqual([1, 1, 1]);
    expect(floor({ x: 4, y: 1 })).toEqual([9, 9, 9]);
  });

  it("reads short and long colours", () => {
    expect(rgb(" #fff")).toEqual([255, 255, 255]);
    expect(rgb("#102030")).toEqual([16, 32, 48]);
  });

  it("draws a dot for each lidar point and none for half a point", () => {
    expect(dots([100, -250, 7])).toBe("M1 -2.5h0");
  });
});

describe("cells", () => {
  const around = (rows: readonly string[]): Cells => {
    const cells = [...rows].reverse().join("").replaceAll(".", "\x00").replaceAll("#", "\x01");
    return new Cells({
      width: rows[0]?.length ?? 0,
      height: rows.length,
      resolution_m: 0.5,
      origin: { x_m: -1, y_m: -1 },
      cells: btoa(cells.replaceAll("?", "\x02")),
    } as Grid);
  };

  it("have a box around what is known, and the whole grid where nothing is", () => {
    const box = { left: -0.5, bottom: -0.5, right: 0.5, top: 0 };
    expect(around(["????", "?.#?", "????"]).known()).toEqual(box);
    expect(around(["??", "??"]).known()).toEqual({ left: -1, bottom: -1, right: 0, top: 0 });
  });

  it("let a name shun furniture and the names of places", () => {
    const free = Array<string>(12).fill("............");
    expect(nameSpot(room, [room], null)).toEqual({ x: 1.5, y: 1.5 });
    const alone = nameSpot(room, [room], around(free));
    expect(Math.hypot(alone.x - 1.5, alone.y - 1.5)).toBeLessThan(0.25);
    const sat = nameSpot(room, [room, { ...sofa, pose: pose(1.5, 1.5) }], around(free));
    expect(Math.abs(sat.y - 1.35)).toBeGreaterThanOrEqual(0.5);
    const full = free.map((line, row) => (row > 5 ? line : "............".replaceAll(".", "#")));
    expect(nameSpot(room, [room], around(full)).y).toBeLessThan(1.8);
    expect(nameSpot(sofa, [room, sofa], around(free))).toEqual({ x: 1, y: 1 });
  });
});

describe("layers", () => {
  it("draw a square around each middle, in metres", () => {
    expect(squares([100, 200], 0.05)).toBe("M0.975 1.975h0.05v0.05h-0.05z");
    expect(squares([], 0.05)).toBe("");
  });
  it("draw what moves with a line to where it will be in a second", () => {
    const mover = { number: 1, x_m: 2, y_m: 1, vx_mps: 0.5, vy_mps: -0.25, radius_m: 0.3 };
    expect(discs([mover])).toContain("M2 1l0.5 -0.25");
  });
});

describe("where it might be", () => {
  const guess = (yaw_rad: number) => ({ pose: { x_m: 1, y_m: 2, yaw_rad }, score: 0.5 });

  it("is an arrowhead whose tip lies ahead of the place", () => {
    expect(arrowheads([guess(0)])).toMatch(/^M1\.420 2\.000L/);
    expect(arrowheads([guess(Math.PI / 2)])).toMatch(/^M1\.000 2\.420L/);
  });

  it("is drawn once for each candidate, and not at all without", () => {
    expect(arrowheads([guess(0), guess(1), guess(2)]).match(/Z/g)).toHaveLength(3);
    expect(arrowheads([])).toBe("");
  });
});

describe("robots at one spot", () => {
  const at = (id: string, x_m: number, radius = 0.2) => ({
    id,
    pose: { x_m, y_m: 0, yaw_rad: 0 },
    radius,
  });
  const names = (...bodies: ReturnType<typeof at>[]) =>
    atOneSpot(bodies).map((group) => group.map(({ id }) => id));

  it("share a plate where one stands over another's middle, and none else", () => {
    expect(names(at("a", 0), at("b", 0.1), at("c", 0.2), at("d", 3))).toEqual([
      ["a", "b"],
      ["c"],
      ["d"],
    ]);
    expect(names(at("a", Number.NaN), at("b", 0))).toEqual([["a"], ["b"]]);
    expect(names()).toEqual([]);
  });
});
