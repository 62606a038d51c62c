import { describe, expect, it } from "vitest";
import { en } from "../src/i18n/en";
import { zh } from "../src/i18n/zh";
import { type Facts, headline, motion } from "../src/state/headline";

const LINKS = ["connecting", "lost", "unheard", "silent", "live"] as const;
const MODES = [
  ...["BOOT", "SELFTEST", "DISARMED", "HOLD", "ACTIVE"],
  ...["TELEOP", "STOPPING", "ESTOPPED", "FAULT", "none"],
];
const HELD = [null, "stop", "teleop", "planner_restarted", "fault"];
const POSES = [null, "searching", "lost"] as const;
const GOALS = ["running", "thinking", "paused", "none"] as const;
const EITHER = [false, true];

function* all(): Generator<Facts> {
  for (const link of LINKS)
    for (const mode of MODES)
      for (const held of HELD)
        for (const pose of POSES)
          for (const goals of GOALS)
            for (const bits of Array(32).keys()) {
              const [setup, barred, blocked, low, asks] = [0, 1, 2, 3, 4].map(
                (bit) => EITHER[(bits >> bit) & 1] ?? false,
              ) as [boolean, boolean, boolean, boolean, boolean];
              yield { link, mode, held, pose, goals, setup, barred, blocked, low, asks };
            }
}

const calm: Facts = {
  link: "live",
  setup: false,
  mode: "HOLD",
  held: null,
  pose: null,
  barred: false,
  blocked: false,
  low: false,
  asks: false,
  goals: "none",
};

/** Return the combinations of all states that break a law: to expect each by itself takes seconds. */
const broken = (law: (facts: Facts) => boolean): readonly Facts[] =>
  [...all()].filter((facts) => !law(facts));

const isCalm = (facts: Facts): boolean =>
  Object.entries(calm).every(([name, value]) => facts[name as keyof Facts] === value);

describe("the one word of the state", () => {
  it("is asked in every combination", () => {
    expect([...all()]).toHaveLength(5 * 10 * 5 * 3 * 4 * 32);
  });

  it("is Ready and green only where nothing at all is the matter", () => {
    expect(broken((facts) => (headline(facts).word === "mode.HOLD") === isCalm(facts))).toEqual([]);
    expect(broken((facts) => (headline(facts).tone === "good") === isCalm(facts))).toEqual([]);
  });

  it("has a word in both languages", () => {
    expect(broken((facts) => headline(facts).word in en && headline(facts).word in zh)).toEqual([]);
  });

  it("offers no act to a robot that is not heard, nor without a colour that asks for one", () => {
    const offers = (facts: Facts) => headline(facts).act !== null;
    const warns = (facts: Facts) => ["warn", "bad"].includes(headline(facts).tone);
    expect(broken((facts) => facts.link === "live" || !offers(facts))).toEqual([]);
    expect(broken((facts) => warns(facts) || !offers(facts))).toEqual([]);
  });

  it.each(["held", "pose", "low", "asks", "barred", "blocked"] as const)(
    "is not one of a robot that is well where it is heard and %s is so",
    (name) => {
      const ill = (facts: Facts) => facts[name] !== calm[name] && facts.link === "live";
      expect(broken((facts) => !ill(facts) || headline(facts).tone !== "good")).toEqual([]);
    },
  );

  it.each([
    [{}, "mode.HOLD", "good", null],
    [{ held: "stop" }, "now.stopped", "warn", "resume"],
    [{ held: "stop", asks: true }, "now.stopped", "warn", "resume"],
    [{ held: "planner_restarted" }, "now.held", "warn", "resume"],
    [{ asks: true }, "now.asks", "warn", "answer"],
    [{ asks: true, mode: "ACTIVE" }, "now.asks", "warn", "answer"],
    [{ low: true }, "now.low", "warn", null],
    [{ low: true, mode: "ACTIVE" }, "mode.ACTIVE", "busy", null],
    [{ pose: "lost", held: "stop" }, "mode.lost", "bad", "locate"],
    [{ pose: "searching" }, "mode.searching", "bad", "locate"],
    [{ barred: true }, "now.waits", "warn", null],
    [{ blocked: true, mode: "ACTIVE" }, "now.blocked", "warn", null],
    [{ goals: "running" }, "now.works", "busy", null],
    [{ goals: "thinking" }, "now.thinks", "busy", null],
    [{ goals: "paused" }, "now.paused", "warn", "resume"],
    [{ mode: "DISARMED", held: "stop", asks: true }, "mode.DISARMED", "warn", "arm"],
    [{ mode: "ESTOPPED", pose: "lost" }, "mode.ESTOPPED", "bad", "reset"],
    [{ mode: "FAULT", asks: true }, "mode.FAULT", "bad", "reset"],
    [{ link: "silent", asks: true }, "now.silent", "bad", null],
    [{ link: "lost", setup: true }, "now.no_contact", "bad", null],
    [{ link: "silent", setup: true }, "mode.setup", "busy", null],
    [{ mode: "none" }, "mode.none", "old", null],
  ] as const)("of %o is %s, %s", (facts, word, tone, act) => {
    expect(headline({ ...calm, ...facts })).toEqual({ word, tone, act });
  });
});

describe("how it moves", () => {
  it.each([
    [0, 0, "standing"],
    [0.01, 0.04, "standing"],
    [0.004, 0.6, "turning"],
    [0, -0.6, "turning"],
    [-0.1, 0, "moving"],
    [0.3, 0.6, "moving"],
  ])("at %s m/s and %s rad/s is %s", (v, w, words) => {
    expect(motion(v, w)).toBe(words);
  });
});
