import { afterEach, describe, expect, it } from "vitest";
import { language } from "../src/i18n";
import { standsWords } from "../src/panels/standing";

const MONDAY = "2026-11-30T00:00:00+08:00";

afterEach(() => {
  language.value = "en";
});

describe("a standing order that was put off", () => {
  it("says until when, on the robot's own clock", () => {
    expect(standsWords("paused", MONDAY)).toBe("Paused until 2026-11-30 00:00");
    language.value = "zh";
    expect(standsWords("paused", MONDAY)).toBe("已暂停，2026-11-30 00:00 恢复");
  });

  it("is only paused where a person must resume it, and over where it is over", () => {
    expect(standsWords("paused", null)).toBe("Paused");
    expect(standsWords("ended", MONDAY)).toBe("Over");
    language.value = "zh";
    expect(standsWords("paused", null)).toBe("已暂停");
  });
});
