import { describe, expect, it } from "vitest";
import { fresh, since } from "../src/state/moment";

describe("since", () => {
  it("believes the clock that says longer", () => {
    const then = { monotonicMs: 1000, wallMs: 50_000 };
    expect(since(then, { monotonicMs: 3000, wallMs: 50_500 })).toBe(2);
    expect(since(then, { monotonicMs: 1100, wallMs: 90_000 })).toBe(40); // the machine slept
  });

  it("is never below zero", () => {
    expect(since({ monotonicMs: 5, wallMs: 5 }, { monotonicMs: 5, wallMs: 1 })).toBe(0);
  });
});

describe("fresh", () => {
  it.each([
    [0, true],
    [0.75, true],
    [0.751, false],
    [null, false],
    [Number.NaN, false],
    [Number.POSITIVE_INFINITY, false],
  ])("%s s: %s", (age, expected) => {
    expect(fresh(age)).toBe(expected);
  });
});
