import { beforeEach, describe, expect, it, vi } from "vitest";
import { bilingual, feed, mission, type Told } from "../src/fleet/decode";
import { ft, WORDS } from "../src/fleet/words";
import { language } from "../src/i18n";

vi.stubGlobal("location", { pathname: "/", hash: "", search: "" });
vi.stubGlobal("document", { hidden: false, addEventListener: () => undefined });
const { chosen, heard, phase, stopTold } = await import("../src/fleet/stopAll");
const { sorted } = await import("../src/fleet/fleet");

const blanks = (sentence: string): string[] => (sentence.match(/\{\w+\}/g) ?? []).sort();
const told = (id: string, ...missing: string[]): Told => ({
  id,
  confirmed: ["r1"],
  not_reached: missing,
  message: { en: id, zh: id },
});

describe("the fleet's words", () => {
  it.each(Object.entries(WORDS))("%s has both languages and the same blanks", (_, { en, zh }) => {
    expect(en).not.toMatch(/[\u4e00-\u9fff]/);
    expect(blanks(zh)).toEqual(blanks(en));
    if (zh.replace(/\{\w+\}/g, "").length > 3) expect(zh).toMatch(/[\u4e00-\u9fff]/);
    expect(en + zh).not.toMatch(/emergency stop|certified|safety-rated|紧急停止|急停/i);
  });

  it("fill their blanks", () => {
    language.value = "zh";
    expect(ft("robot.unknown", { time: "14:02" })).toBe("14:02 起情况不明");
    language.value = "en";
    expect(ft("robot.unknown", { time: "14:02" })).toBe("unknown since 14:02");
  });
});

describe("what robots said", () => {
  const base = { id: "m-1", state: "asking", text: "look" };

  it("becomes text or goes", () => {
    const question = { text: 7, kind: [], options: [null, { text: "a", label: 3 }, { text: {} }] };
    const read = mission({ ...base, question, message: ["x"], robot: {} });
    expect(read?.question).toEqual({
      words: null,
      confirms: false,
      options: [{ text: "a", label: { en: "a", zh: "a" } }],
    });
    expect([read?.message, read?.robot]).toEqual([null, null]);
  });

  it("is bounded", () => {
    const options = Array.from({ length: 999 }, (_, n) => ({ text: `${n}` }));
    const read = mission({ ...base, question: { text: "x".repeat(9999), options } });
    expect(read?.question?.options.length).toBe(12);
    expect(read?.question?.words?.en.length).toBe(2000);
  });

  it.each([null, 3, "x", [], { id: "m-1" }])("that is no mission is left out: %s", (one) => {
    expect(feed({ missions: [one] }).missions).toEqual([]);
  });

  it("is said in the one language that it has", () => {
    expect(bilingual({ zh: "哪扇门？" })).toEqual({ en: "哪扇门？", zh: "哪扇门？" });
  });
});

describe("missions", () => {
  it("are those that are open first, then the newest", () => {
    const one = (id: string, state: string, created_unix_s: number) =>
      mission({ id, state, created_unix_s });
    const all = [one("a", "succeeded", 1), one("b", "unknown", 2), one("c", "failed", 3)];
    const { open, past } = sorted(all.filter((each) => each !== null));
    expect([open, past].map((those) => those.map(({ id }) => id))).toEqual([["b"], ["c", "a"]]);
  });
});

describe("a stop of all", () => {
  beforeEach(() => {
    stopTold.value = null;
    phase.value = "idle";
  });

  it("of before is no news once all have confirmed", () => {
    expect(chosen(told("s-1"), null, "s-1")).toBeNull();
    expect(chosen(told("s-1", "r4"), null, "s-1")?.id).toBe("s-1");
  });

  it("of another person is told, and goes on until all have confirmed", () => {
    heard(null);
    heard(told("s-2", "r4"));
    expect(stopTold.value?.not_reached).toEqual(["r4"]);
    heard(told("s-2"));
    expect(stopTold.value?.not_reached).toEqual([]);
  });

  it("that was not written down is not hidden by an older one", () => {
    const unwritten = told("", "r4");
    expect(chosen(told("s-1"), unwritten, "s-1")).toBe(unwritten);
    expect(chosen(told("s-2"), unwritten, "s-1")?.id).toBe("s-2");
  });
});
