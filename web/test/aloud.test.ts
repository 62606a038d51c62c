import { beforeEach, describe, expect, it, vi } from "vitest";
import { goal } from "./examples";

type Said = { text: string; lang: string; onend: () => void };

const said: Said[] = [];
let cancelled = 0;
const kept = new Map<string, string>();

/** A browser's voice that a test lets end. */
function browser(): void {
  vi.stubGlobal("localStorage", {
    getItem: (slot: string) => kept.get(slot) ?? null,
    setItem: (slot: string, value: string) => kept.set(slot, value),
  });
  vi.stubGlobal(
    "SpeechSynthesisUtterance",
    class {
      lang = "";
      onend = (): void => undefined;
      constructor(readonly text: string) {}
    },
  );
  vi.stubGlobal("speechSynthesis", {
    speak: (one: Said) => said.push(one),
    cancel: () => (cancelled += 1),
  });
}

beforeEach(() => {
  said.length = cancelled = 0;
  kept.clear();
  vi.resetModules();
  browser();
});

const load = async () => ({
  aloud: await import("../src/talk/aloud"),
  store: await import("../src/state/store"),
});

describe("reading aloud", () => {
  it("is off until a person switches it on, and remembered", async () => {
    const { aloud } = await load();
    aloud.startAloud();
    aloud.readAloud("hello", "en");
    expect(said).toEqual([]);
    aloud.setAloud(true);
    aloud.readAloud("hello", "en");
    expect(said.map(({ text, lang }) => [text, lang])).toEqual([["hello", "en-US"]]);
    vi.resetModules();
    const again = await load();
    again.aloud.startAloud();
    expect(again.aloud.aloud.value).toBe(true);
  });

  it("says how goals end in their own language, once, and nothing of before", async () => {
    const { aloud, store } = await load();
    const message = { en: "Arrived: kitchen.", zh: "已到达：厨房。" };
    const outcome = { code: "arrived", message } as never;
    store.learn(goal("old", "succeeded", { outcome }));
    aloud.startAloud();
    aloud.setAloud(true);
    store.learn(goal("a", "running"));
    store.learn(goal("a", "succeeded", { outcome, language: "zh", updated: "2027" }));
    store.learn(goal("a", "succeeded", { outcome, language: "zh", updated: "2028" }));
    expect(said.map(({ text, lang }) => [text, lang])).toEqual([["已到达：厨房。", "zh-CN"]]);
  });

  it("is broken off at once and goes on with what comes later", async () => {
    const { aloud } = await load();
    aloud.setAloud(true);
    for (let n = 0; n < 9; n++) aloud.readAloud(`late ${n}`, "en");
    expect(said.length).toBe(4); // more than that would come too late
    aloud.hush();
    expect(cancelled).toBe(1);
    aloud.readAloud("now", "en");
    expect(said.at(-1)?.text).toBe("now");
  });

  it("never fails where the browser has no voice", async () => {
    vi.unstubAllGlobals();
    vi.stubGlobal("localStorage", { getItem: () => "1", setItem: () => undefined });
    const { aloud } = await load();
    aloud.startAloud();
    aloud.setAloud(true);
    aloud.hush();
    aloud.readAloud("hello", "en");
    expect(aloud.aloud.value).toBe(false);
  });
});
