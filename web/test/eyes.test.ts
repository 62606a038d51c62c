import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { PERIOD_MS, Puller } from "../src/eyes/pull";
import { blindFor, boxed, rows, things } from "../src/eyes/sight";
import { knownWords, lookWords, orderTo, pictureAgeWords } from "../src/eyes/words";
import { language } from "../src/i18n";
import { moment } from "../src/state/moment";
import { learnThings, now, receive } from "../src/state/store";
import { listed, retold } from "../src/state/things";
import type { Look } from "../src/wire/types";
import { cup, sight, snapshot } from "./examples";

const ball = { ...cup, id: "ball_1", label: "ball", name: { en: "blue ball", zh: "蓝色的球" } };

describe("pictures", () => {
  beforeEach(() => void vi.useFakeTimers());
  afterEach(() => void vi.useRealTimers());

  it("are asked for at most three times a second, each once, and one at a time", async () => {
    let [asked, done] = [0, (): void => undefined];
    const puller = new Puller(() => {
      asked += 1;
      return new Promise((resolve) => (done = resolve));
    }, Date.now);
    puller.want("1");
    puller.want("1");
    await vi.advanceTimersByTimeAsync(5 * PERIOD_MS);
    expect(asked).toBe(1); // the first one hangs
    puller.want("2");
    puller.want("3");
    done();
    await vi.advanceTimersByTimeAsync(0);
    expect(asked).toBe(2);
    done();
    puller.want("3");
    await vi.advanceTimersByTimeAsync(5 * PERIOD_MS);
    expect(asked).toBe(2); // it is there already
    for (let ms = 0; ms < 10 * PERIOD_MS; ms += 20) {
      puller.want(`at ${ms}`);
      await vi.advanceTimersByTimeAsync(20);
      done();
    }
    expect(asked).toBeLessThanOrEqual(13);
    expect(asked).toBeGreaterThanOrEqual(10);
  });

  it("are not asked for by whoever looks away, and at once by whoever looks again", async () => {
    let asked = 0;
    const puller = new Puller(() => {
      asked += 1;
      return Promise.resolve();
    }, Date.now);
    puller.want("1");
    puller.want(null);
    await vi.advanceTimersByTimeAsync(5 * PERIOD_MS);
    expect(asked).toBe(0);
    puller.want("1");
    await vi.advanceTimersByTimeAsync(0);
    puller.want(null);
    puller.want("1"); // the same picture, for eyes that were away
    await vi.advanceTimersByTimeAsync(PERIOD_MS);
    expect(asked).toBe(2);
  });
});

describe("things", () => {
  const at = (s: number) => ({ monotonicMs: 1000 * s, wallMs: 1000 * s });

  it("that nothing is said of stay and grow old", () => {
    const known = retold(listed([cup, ball], at(0)), [{ ...ball, x_m: 9 }], at(5));
    expect(known.map(({ thing, at }) => [thing.id, thing.x_m, at.wallMs])).toEqual([
      ["cup_1", 1, 0],
      ["ball_1", 9, 5000],
    ]);
    expect(retold(known, [], at(9))).toBe(known);
  });

  it("are listed by name with where and when, and rest while nothing reads differently", () => {
    receive(JSON.stringify(snapshot(1)));
    learnThings({ version: 3, objects: [cup, ball] });
    now.value = moment();
    const before = rows.value;
    expect(before.map(({ what, order }) => [what, order])).toEqual([
      ["blue ball", "go to the blue ball"],
      ["red cup", "go to the red cup"],
    ]);
    const drawn = things.value;
    const trembled = { ...sight, things: [{ ...cup, x_m: 1.001, age_s: 0.3 }] };
    receive(JSON.stringify({ seq: 2, kind: "sight", sight: trembled }));
    expect(rows.value).toBe(before);
    receive(
      JSON.stringify({ seq: 3, kind: "sight", sight: { ...sight, things: [{ ...cup, x_m: 2 }] } }),
    );
    expect(things.value).not.toBe(drawn);
    learnThings({ version: 4, objects: [cup] });
    expect(things.value.map(({ id }) => id)).toEqual(["cup_1"]);
  });

  it("have no boxes once the look is older than a second, or what it sees is unsure", () => {
    receive(JSON.stringify(snapshot(1)));
    const at = moment();
    const later = (ms: number) => ({ monotonicMs: at.monotonicMs + ms, wallMs: at.wallMs });
    const drawn = { look: sight.look as Look, at };
    expect(boxed(drawn, null, later(800))).toBe(sight.look);
    expect(boxed(drawn, null, later(1000))).toBeNull(); // it was 0.1 s old when it came
    expect(boxed(drawn, "camera_unusable", later(0))).toBeNull();
    expect(boxed({ look: { ...drawn.look, age_s: NaN }, at }, null, later(0))).toBeNull();
    expect(boxed(null, null, at)).toBeNull();
  });

  it("are blind since when this page heard so, anew for each reason", () => {
    const later = (s: number) => {
      const at = moment();
      return { monotonicMs: at.monotonicMs + 1000 * s, wallMs: at.wallMs };
    };
    const tell = (seq: number, blind: string | null) =>
      receive(JSON.stringify({ seq, kind: "sight", sight: { ...sight, look: null, blind } }));
    receive(JSON.stringify(snapshot(1)));
    expect(blindFor.value).toBe("");
    tell(2, "camera_silent");
    now.value = later(0.9);
    expect(blindFor.value).toBe(""); // "at least 0 s" would tell nothing
    now.value = later(7.9);
    expect(blindFor.value).toBe("For at least 7 s.");
    tell(3, "camera_silent"); // told again: it lasts
    expect(blindFor.value).toBe("For at least 7 s.");
    now.value = later(235);
    expect(blindFor.value).toBe("For at least 3 min.");
    tell(4, "camera_frozen");
    now.value = later(1.2);
    expect(blindFor.value).toBe("For at least 1 s.");
    expect(pictureAgeWords(12.3)).toBe("This picture is 12 s old.");
    tell(5, null);
    expect(blindFor.value).toBe("");
  });

  it("are told of in both languages", () => {
    const look = sight.look as Look;
    expect(knownWords(cup, 0.4)).toBe("kitchen · in view · 90 % sure · within 0.08 m");
    expect(knownWords({ ...cup, room: null, sightings: 1 }, 0.4)).toBe(
      "in view · in one picture only · 90 % sure · within 0.08 m",
    );
    expect(knownWords({ ...cup, room: null }, 7.6)).toBe(
      "seen 8 s ago · 90 % sure · within 0.08 m",
    );
    expect(lookWords(look)).toBe("red cup 81 %");
    expect(lookWords({ ...look, boxes: [] })).toBe("Nothing that it knows is in view.");
    language.value = "zh";
    expect(orderTo(cup)).toBe("去红色的杯子那里");
    expect(knownWords(cup, 200)).toBe("kitchen · 3 分钟前见过 · 把握 90 % · 误差约 0.08 m");
    language.value = "en";
  });
});
