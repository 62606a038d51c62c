import { beforeEach, describe, expect, it } from "vitest";
import type { Setting } from "../src/net/settings";
import { changesOf, draft, readTyped, settings, shownValue, type } from "../src/state/settings";

const field = (more: Partial<Setting>): Setting => ({
  name: "limits.max_speed_mps",
  group: "limits",
  kind: "number",
  value: null,
  is_set: false,
  source: "default",
  choices: [],
  least: 0.05,
  most: 0.5,
  in_force: "next_start",
  is_pending: false,
  ...more,
});
const SPEED = field({ value: 0.3, is_set: true });
const KEY = field({ name: "model.key", group: "model", kind: "secret", is_set: true });

beforeEach(() => {
  draft.value = {};
  settings.value = { revision: "r", fields: [SPEED, KEY], changes: [], can_restart: false };
});

describe("a setting that is typed", () => {
  it.each([
    ["number", "0.25", 0.25],
    ["number", " 0,25 ", 0.25],
    ["number", "fast", "fast"],
    ["number", "", null],
    ["yes", "true", true],
    ["yes", "false", false],
    ["yes", "", null],
    ["text", " 0.25 ", "0.25"],
    ["choice", "ollama", "ollama"],
  ] as const)("as %s %o is %o", (kind, text, value) => {
    expect(readTyped(field({ kind }), text)).toBe(value);
  });

  it("is a change of its group alone, and none once it is as it was", () => {
    type(SPEED, 0.2);
    type(KEY, "sk-1");
    expect(changesOf("limits")).toEqual({ "limits.max_speed_mps": 0.2 });
    expect(shownValue(SPEED)).toBe(0.2);
    type(SPEED, 0.3);
    expect(changesOf("limits")).toEqual({});
    expect(changesOf("model")).toEqual({ "model.key": "sk-1" });
  });

  it("is taken away by an empty box, where it was set", () => {
    type(SPEED, null);
    expect(changesOf("limits")).toEqual({ "limits.max_speed_mps": null });
    type(field({}), null);
    expect(changesOf("limits")).toEqual({});
  });

  it("is a secret that is kept where its box is emptied again", () => {
    type(KEY, "sk-1");
    type(KEY, null);
    expect(changesOf("model")).toEqual({});
  });
});
