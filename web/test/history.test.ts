import { describe, expect, it } from "vitest";
import { span } from "../src/plots/span";
import { History, series, WINDOW_S, wheels } from "../src/state/history";
import { about, status } from "./examples";

describe("wheels", () => {
  it("turn against each other on the spot", () => {
    expect(wheels({ v_mps: 0, w_radps: 1 }, about.base)).toEqual({ left: -2.5, right: 2.5 });
    expect(wheels({ v_mps: 0.5, w_radps: 0 }, about.base)).toEqual({ left: 5, right: 5 });
  });
});

describe("history", () => {
  it("keeps a minute", () => {
    const history = new History();
    for (let n = 0; n < 1000; n += 1) history.take({ ...status, seq: n }, about.base, n * 0.1);
    const kept = history.samples;
    expect((kept.at(-1)?.atS ?? 0) - (kept[0]?.atS ?? 0)).toBeLessThanOrEqual(WINDOW_S);
    expect(kept.length).toBeGreaterThan(590);
  });

  it("draws no line from a bridge that is frozen", () => {
    const history = new History();
    history.take(status, about.base, 1);
    history.take(status, about.base, 2);
    expect(history.samples).toHaveLength(1);
    history.take({ ...status, boot: "b2" }, about.base, 3);
    expect(history.samples).toHaveLength(2);
  });
});

describe("series", () => {
  it("has a hole where nothing came", () => {
    const history = new History();
    history.take({ ...status, seq: 1 }, about.base, 1);
    history.take({ ...status, seq: 2 }, about.base, 1.1);
    history.take({ ...status, seq: 3 }, about.base, 5);
    const [x, y] = series(history.samples, 5, [(sample) => sample.sent.left]);
    expect(x?.map((value) => Math.round((value ?? 0) * 100) / 100)).toEqual([-4, -3.9, -3.89, 0]);
    expect(y).toEqual([0, 0, null, 0]);
  });
});

describe("span", () => {
  it("never shows noise as motion", () => {
    expect(span(0, 0.001, 1)).toEqual([0, 1.1]);
    expect(span(null, null, 1)).toEqual([0, 1.1]);
    expect(span(-0.001, 0, 1)[0]).toBeCloseTo(-1.1);
    expect(span(0, 5, 1)[1]).toBeCloseTo(5.5);
  });
});
