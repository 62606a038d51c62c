/**
 * Say in one word how the robot is, in which colour, and what a person may do next. Pure: header, Stop
 * bar and transcript all ask this one table, so that none says "Ready" where another says "Stopped".
 */
import type { Key } from "../i18n/en";

export type Tone = "good" | "busy" | "warn" | "bad" | "old";
export type NextAct = "answer" | "resume" | "arm" | "reset" | "locate";

export type Facts = {
  /** How the page hears: not yet, no more, no bridge yet, a silent bridge, or all of it now. */
  readonly link: "connecting" | "lost" | "unheard" | "silent" | "live";
  readonly setup: boolean;
  readonly mode: string;
  readonly held: string | null;
  readonly pose: "searching" | "lost" | null;
  /** A row of the bridge that lets nothing drive, or something that it waits for. */
  readonly barred: boolean;
  readonly blocked: boolean;
  readonly low: boolean;
  readonly asks: boolean;
  /** What the goals are about: the first of these that any of them is. */
  readonly goals: "running" | "thinking" | "paused" | "none";
};

export type Headline = {
  readonly word: Key;
  readonly tone: Tone;
  readonly act: NextAct | null;
};

type Rule = readonly [is: (facts: Facts) => boolean, word: Key, tone: Tone, act?: NextAct];

const mode =
  (...modes: readonly string[]) =>
  (facts: Facts): boolean =>
    modes.includes(facts.mode);

/** The first line that fits. What is worse, and what is done first, stands higher. */
const RULES: readonly Rule[] = [
  [({ link }) => link === "connecting", "link.connecting", "old"],
  [({ link }) => link === "lost", "now.no_contact", "bad"],
  [({ setup }) => setup, "mode.setup", "busy"],
  [({ link }) => link !== "live", "now.silent", "bad"],
  [mode("FAULT"), "mode.FAULT", "bad", "reset"],
  [mode("ESTOPPED"), "mode.ESTOPPED", "bad", "reset"],
  [mode("BOOT"), "mode.BOOT", "busy"],
  [mode("SELFTEST"), "mode.SELFTEST", "busy"],
  [mode("STOPPING"), "mode.STOPPING", "warn"],
  [mode("TELEOP"), "mode.TELEOP", "busy"],
  [({ pose }) => pose === "lost", "mode.lost", "bad", "locate"],
  [({ pose }) => pose === "searching", "mode.searching", "bad", "locate"],
  [mode("DISARMED"), "mode.DISARMED", "warn", "arm"],
  [({ held }) => held === "stop", "now.stopped", "warn", "resume"],
  [({ held }) => held !== null, "now.held", "warn", "resume"],
  [({ asks }) => asks, "now.asks", "warn", "answer"],
  [({ blocked }) => blocked, "now.blocked", "warn"],
  [({ barred, low }) => barred && low, "now.low", "warn"],
  [({ barred }) => barred, "now.waits", "warn"],
  [mode("ACTIVE"), "mode.ACTIVE", "busy"],
  [({ low }) => low, "now.low", "warn"],
  [({ goals }) => goals === "running", "now.works", "busy"],
  [({ goals }) => goals === "thinking", "now.thinks", "busy"],
  [({ goals }) => goals === "paused", "now.paused", "warn", "resume"],
  [mode("HOLD"), "mode.HOLD", "good"],
];

export function headline(facts: Facts): Headline {
  const rule = RULES.find(([is]) => is(facts));
  if (rule === undefined) return { word: "mode.none", tone: "old", act: null };
  const [, word, tone, act = null] = rule;
  return { word, tone, act };
}

/** Say how it moves, as measured: a turn on the spot has no speed to tell. */
export function motion(v_mps: number, w_radps: number): "moving" | "turning" | "standing" {
  if (Math.abs(v_mps) > 0.02) return "moving";
  return Math.abs(w_radps) > 0.05 ? "turning" : "standing";
}
