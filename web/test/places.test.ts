import { afterEach, describe, expect, it } from "vitest";
import { language } from "../src/i18n";
import { whole } from "../src/panels/Draft";
import { meterWords, share } from "../src/panels/Meter";
import { stepWords } from "../src/panels/steps";
import { verdict } from "../src/panels/verdict";
import { advance, EMPTY } from "../src/state/model";
import { decode } from "../src/wire/decode";
import type { Frame } from "../src/wire/types";
import { goal, snapshot, usage } from "./examples";

const at = { monotonicMs: 0, wallMs: 0 };
const frame = (more: object): Frame | null => decode(JSON.stringify({ seq: 2, ...more }));

afterEach(() => {
  language.value = "en";
});

describe("what is new on the stream", () => {
  const draft = { goal: "a", text: '{"kind":"pl', steps: [{ kind: "wait", seconds: 5 }] };

  it("is read strictly", () => {
    expect(frame({ kind: "thinking", change: draft })?.kind).toBe("thinking");
    expect(frame({ kind: "thinking", change: { ...draft, steps: [{ place: 3 }] } })).toBeNull();
    expect(frame({ kind: "usage", usage })?.kind).toBe("usage");
    expect(frame({ kind: "usage", usage: { ...usage, today: { calls: 1 } } })).toBeNull();
    expect(frame({ kind: "places", version: 3 })?.kind).toBe("places");
    expect(frame({ kind: "places" })).toBeNull();
  });

  it("shows a draft until its goal goes on, and no other's", () => {
    let model = advance(EMPTY, snapshot(1) as Frame, at);
    for (const id of ["a", "bb"]) {
      const change = { ...draft, goal: id, text: "x".repeat(9000) };
      model = advance(model, frame({ kind: "thinking", change }), at);
    }
    expect(model.drafts.map((one) => one.goal)).toEqual(["bb", "a"]);
    expect(model.drafts[0]?.text.length).toBe(4000);
    const planned = frame({ kind: "goal", change: { goal: goal("bb", "running") } });
    expect(advance(model, planned, at).drafts.map((one) => one.goal)).toEqual(["a"]);
  });

  it("tells a new version of the places", () => {
    const model = advance(EMPTY, frame({ kind: "places", version: 4 }), at);
    expect(model.placesVersion).toBe(4);
  });
});

describe("a step", () => {
  const step = (more: object) => whole({ kind: "go_to", state: "succeeded", ...more });

  it("as it is written reads as one of a plan", () => {
    expect(stepWords(whole({ kind: "wait", seconds: 5 }))).toBe("Wait 5 s");
    expect(stepWords(whole({ kind: "turn", angle_rad: Math.PI / 2 }))).toBe("Turn 90°");
  });

  it("says what was reached and what is left", () => {
    const reached = { place: null, room: "kitchen", x_m: 1, y_m: 2 };
    expect(verdict(step({ reached, residual_m: 0.031 }))).toEqual([
      "reached: kitchen",
      "0.03 m from the goal",
    ]);
    expect(verdict(step({ kind: "move", moved_m: 0.98 }))).toEqual(["0.98 m by its wheels"]);
    expect(verdict(step({ kind: "ask", answer: "tea" }))).toEqual(["answer: “tea”"]);
    const patrol = { kind: "patrol", places: ["a", "b"], visited: 1, state: "running" };
    expect(verdict(step({ ...patrol, left_m: 2.34 }))).toEqual(["2.3 m to go", "1 of 2 visited"]);
    expect(verdict(step({ state: "pending" }))).toEqual([]);
    const bill = {
      pictures: 3,
      pictures_most: 24,
      tokens: 5100,
      tokens_most: 51840,
      money: 0.0024,
      money_most: 0.03,
      currency: "USD",
    };
    expect(verdict(step({ kind: "find", state: "running", bill }))).toEqual([
      "pictures shown to the model so far: 3 · 0.00240 USD",
      "at most 24 pictures · 0.0300 USD",
    ]);
    const free = { ...bill, money: null, money_most: null, currency: null };
    expect(verdict(step({ kind: "find", bill: free }))).toEqual(["pictures shown to the model: 3"]);
  });
});

describe("the meter", () => {
  it("says what was spent of how much, in both languages", () => {
    expect(meterWords(usage)).toBe("3 of 20 calls · 1,000 tokens · 4 of 60 s · 0.02 USD");
    language.value = "zh";
    expect(meterWords(usage)).toContain("调用 3/20 次");
  });

  it("is full where the tightest limit is", () => {
    expect(share(usage)).toBeCloseTo(0.15);
    expect(share({ ...usage, today: { ...usage.today, seconds: 99 } })).toBe(1);
  });
});
