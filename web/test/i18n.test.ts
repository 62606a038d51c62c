import { describe, expect, it } from "vitest";
import codes from "../src/i18n/codes.json";
import { byWhom, language } from "../src/i18n";
import { en } from "../src/i18n/en";
import rows from "../src/i18n/rows.json";
import { zh } from "../src/i18n/zh";

const blanks = (sentence: string): string[] => (sentence.match(/\{\w+\}/g) ?? []).sort();

describe("catalogues", () => {
  it("have the same keys in the same order", () => {
    expect(Object.keys(zh)).toEqual(Object.keys(en));
  });

  it.each(Object.keys(en) as (keyof typeof en)[])("%s has words and the same blanks", (key) => {
    expect(en[key].trim()).not.toBe("");
    expect(zh[key].trim()).not.toBe("");
    expect(blanks(zh[key])).toEqual(blanks(en[key]));
  });

  it("are in their language", () => {
    const same = new Set(["error.other", "event.mode", "event.mode_why", "meter.of"]);
    const chinese = Object.entries(zh).filter(([key]) => !same.has(key));
    for (const [key, sentence] of chinese) {
      const bare = sentence.replace(/\{\w+\}/g, "");
      if (/[a-z]{3}/i.test(bare) || bare.length > 3)
        expect(sentence, key).toMatch(/[\u4e00-\u9fff]/);
    }
    for (const sentence of Object.values(en)) expect(sentence).not.toMatch(/[\u4e00-\u9fff]/);
  });

  it("never call our stop what it is not", () => {
    const all = [...Object.values(en), ...Object.values(zh)].join("\n");
    expect(all).not.toMatch(/emergency stop|certified|safety-rated|紧急停止|急停/i);
  });

  it("have one Chinese word for to arm", () => {
    const bridge = [rows, codes.sentences, codes.wants].flatMap((all) => Object.values(all));
    expect([...Object.values(zh), ...bridge.map((words) => words.zh)].join("\n")).not.toMatch(
      /上电/,
    );
    expect(zh["op.arm"]).toBe("解锁");
  });

  it("say every row and every other code of the bridge in both languages", () => {
    for (const words of [rows, codes.sentences, codes.wants].flatMap((all) => Object.values(all))) {
      expect(words.en).not.toBe("");
      expect(words.zh).toMatch(/[\u4e00-\u9fff]/);
    }
  });
});

describe("who did something", () => {
  it.each([
    ["page", "by the page", "通过网页"],
    ["anas-phone", "by anas-phone", "由anas-phone"],
    ["constructor", "by constructor", "由constructor"],
  ])("is told in words: %s", (who, inEnglish, inChinese) => {
    language.value = "en";
    expect(byWhom(who)).toBe(inEnglish);
    language.value = "zh";
    expect(byWhom(who)).toBe(inChinese);
  });
});
