import { afterEach, describe, expect, it } from "vitest";
import { language } from "../src/i18n";
import { told } from "../src/panels/events";
import { en } from "../src/i18n/en";
import { mindWords } from "../src/panels/MindLine";
import { limitWords } from "../src/panels/steps";
import { decode } from "../src/wire/decode";
import type { Mind } from "../src/wire/types";
import { goal, robot, snapshot } from "./examples";

const entry = (kind: "bridge" | "say" | "act" | "planner", code: string, text = "") => ({
  id: 1,
  at: 0,
  kind,
  code,
  text,
});

afterEach(() => {
  language.value = "en";
});

describe("the log", () => {
  it("says the bridge's events in sentences, with the code beside", () => {
    expect(told(entry("bridge", "row_down", "BRAIN_LATE.0")).text).toMatch(
      /^Over: Pons thinks slowly/,
    );
    expect(told(entry("bridge", "mode", "HOLD ACTIVE waypoints"))).toEqual({
      text: "Ready → Driving",
      fine: "waypoints",
    });
    expect(told(entry("bridge", "held", "stop page-1")).text).toMatch(/^It was stopped/);
    language.value = "zh";
    expect(told(entry("bridge", "row_up", "LIDAR_STALE.0 400 ms")).text).toMatch(/[\u4e00-\u9fff]/);
    expect(told(entry("bridge", "owner", "planner p1")).text).toBe("规划器取得控制权。");
  });

  it("keeps what it does not know as it came", () => {
    expect(told(entry("bridge", "brand_new", "x"))).toEqual({ text: "brand_new", fine: "x" });
    expect(told(entry("planner", "oops", "why"))).toEqual({ text: "why", fine: "oops" });
    expect(told(entry("say", "say", "<b>hi</b>")).text).toBe("The robot says: <b>hi</b>");
  });
});

describe("who plans", () => {
  const mind: Mind = { name: "m", breaker: null, rests_s: 0, last_error: null };
  const last_error = { code: "timeout", message: { en: "Late.", zh: "超时。" } };

  it("is said for every state of the breaker", () => {
    expect(mindWords(mind)).toMatch(/No model/);
    expect(mindWords({ ...mind, breaker: "closed" })).toBe("The model m plans.");
    expect(mindWords({ ...mind, breaker: "closed", last_error })).toMatch(/failed last time/);
    expect(mindWords({ ...mind, breaker: "open", rests_s: 11.2, last_error })).toMatch(/for 12 s/);
    expect(mindWords({ ...mind, breaker: "on_trial", last_error })).toMatch(/tried again/);
  });

  it("is read strictly", () => {
    const frame = (brain: unknown) =>
      decode(JSON.stringify({ seq: 1, kind: "robot", robot: { ...robot, brain } }));
    expect(frame({ ...mind, breaker: "open", last_error })).not.toBeNull();
    expect(frame({ ...mind, breaker: "ajar" })).toBeNull();
    expect(frame({ ...mind, last_error: { code: "x", message: "no pair" } })).toBeNull();
    expect(frame(undefined)).toBeNull();
    const brain = { name: "offline", version: "1", fallback_from: 7, fallback_message: null };
    const goals = [{ ...goal("a"), brain }];
    expect(decode(JSON.stringify({ ...snapshot(), goals }))).toBeNull();
  });
});

describe("what holds a robot back", () => {
  const gates = Object.keys(en).filter((key) => key.startsWith("by."));
  it("is named in words, and in no capitals of a program", () => {
    expect(gates.length).toBeGreaterThan(5);
    for (const key of gates) {
      const code = key.slice("by.".length);
      expect(limitWords(code)).toBe(en[key as keyof typeof en]);
      expect(limitWords(code)).not.toBe(code);
    }
  });
});
