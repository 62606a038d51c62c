import { describe, expect, it } from "vitest";
import { wayOf } from "../src/rehearse/ghost";
import { figuresOf } from "../src/rehearse/RehearsalPanel";
import { outcomeOf, sumOf } from "../src/rehearse/DrivenPart";
import type { DrivenRehearsal, DrivenStep } from "../src/rehearse/drive";
import type { RehearsedStep } from "../src/rehearse/rehearsal";

const step: RehearsedStep = {
  index: 0,
  kind: "go_to",
  name: { en: "kitchen", zh: "厨房" },
  does: "drives",
  branch: false,
  instead: false,
  points: [],
  length_m: 11.62,
  seconds: 27.3,
  narrowest_m: 0.84,
  suspect_m: 0,
  hoped: false,
  message: null,
};

describe("a rehearsed step", () => {
  it("tells metres, seconds and the narrowest place", () => {
    expect(figuresOf(step)).toBe("11.6 m, 27 s, narrowest 0.84 m");
  });

  it("tells of a turn its time alone, and of a roomy way no narrow place", () => {
    expect(figuresOf({ ...step, length_m: 0, narrowest_m: null })).toBe("27 s");
  });

  it("tells what is not known", () => {
    const told = figuresOf({ ...step, suspect_m: 0.6, hoped: true });
    expect(told).toContain("0.6 m of it past what may still stand there");
    expect(told).toContain("open only if");
    expect(figuresOf({ ...step, does: "open" })).toContain("depends");
  });

  it("says why there is no way", () => {
    const message = { en: "I found no way to the kitchen.", zh: "" };
    expect(figuresOf({ ...step, does: "shut", message })).toBe(message.en);
    expect(figuresOf({ ...step, does: "shut" })).toBe("no way");
  });
});

const came: DrivenStep = {
  index: 0,
  kind: "go_to",
  name: step.name,
  branch: false,
  outcome: "succeeded",
  length_m: 11.7,
  seconds: 28.2,
  nearest_m: 0.19,
  contacts: 0,
  rows: [],
  code: null,
  message: null,
};
const whole: DrivenRehearsal = {
  id: "a",
  state: "done",
  shown: { steps: [step], length_m: 11.6, seconds: 27.3, narrowest_m: 0.84, is_whole: true },
  driven: { steps: [came], trail: [], length_m: 11.7, seconds: 28.2, contacts: 0 },
  left_out: ["localization"],
  times_faster: 12.2,
  message: null,
};

describe("a step that was driven in the simulator", () => {
  it("tells how it ended, its figures and the nearest thing", () => {
    expect(outcomeOf(came)).toBe("done, 11.7 m, 28 s, 0.19 m from the nearest thing");
  });

  it("tells what it touched and what held it back", () => {
    const told = outcomeOf({ ...came, outcome: "stuck", contacts: 2, rows: ["BUMP"] });
    expect(told).toContain("gets stuck");
    expect(told).toContain("touched something 2 times");
    expect(told).toContain("held back by");
  });

  it("says why it does not go, in its own words", () => {
    const message = { en: "I found no way to the kitchen.", zh: "" };
    expect(outcomeOf({ ...came, outcome: "failed", message })).toContain(message.en);
    expect(outcomeOf({ ...came, outcome: "left_out" })).not.toContain(" m");
  });

  it("is summed up beside what was foretold", () => {
    expect(sumOf(whole)).toContain("Driven 11.7 m, 28 s; foretold 11.6 m, 27 s.");
    expect(sumOf(whole)).toContain("12 times faster");
    expect(sumOf({ ...whole, times_faster: 0.8 })).not.toContain("faster");
    expect(sumOf({ ...whole, state: "running" })).toContain("So far");
    const begun = { ...whole.driven, seconds: 0 };
    expect(sumOf({ ...whole, state: "running", driven: begun })).toContain("starts");
  });
});

describe("a way on the map", () => {
  it("is drawn from two points on; an empty path would be an error of the browser", () => {
    expect(wayOf([])).toBe("");
    expect(wayOf([[1, 2]])).toBe("");
    expect(wayOf([[1, 2], [3, 4]])).toMatch(/^M/); // prettier-ignore
  });
});
