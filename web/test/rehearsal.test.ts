import { describe, expect, it } from "vitest";
import { figuresOf } from "../src/rehearse/RehearsalPanel";
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
