import { afterEach, describe, expect, it } from "vitest";
import { language } from "../src/i18n";
import codes from "../src/i18n/codes.json";
import { ApiError } from "../src/net/api";
import { told } from "../src/panels/events";
import { reasons } from "../src/panels/reasons";
import { reasonWords } from "../src/panels/steps";
import { explain } from "../src/state/note";
import type { LogEntry } from "../src/state/model";
import type { Status } from "../src/wire/types";
import { status } from "./examples";

const CHINESE = /[\u4e00-\u9fff]/;
const mode = (text: string): LogEntry => ({ id: 1, at: 0, kind: "bridge", code: "mode", text });
const faulted = (code: string): Status => ({
  ...status,
  mode: "FAULT",
  held: { reason: "fault", id: code },
  waiting_for: [code],
});

afterEach(() => {
  language.value = "en";
});

describe("why the robot does not drive", () => {
  it.each(["drive_no_timeout", "drive_moves_on", "encoders_moving", "stop_too_slow"])(
    "is a sentence for the fault %s, in both languages, and nothing that is waited for",
    (code) => {
      const words = (codes.sentences as Record<string, { en: string; zh: string }>)[code];
      expect(words).toBeDefined();
      expect(reasons(faulted(code), [])).toContain(words?.en);
      expect(reasons(faulted(code), []).join()).not.toMatch(/Waiting for/);
      expect(reasons(faulted(code), [])).toHaveLength(3);
      language.value = "zh";
      expect(reasons(faulted(code), [])).toContain(words?.zh);
      for (const said of reasons(faulted(code), [])) expect(said).toMatch(CHINESE);
    },
  );

  it("is what is waited for, by name", () => {
    const testing = { ...status, mode: "SELFTEST", waiting_for: ["drive_echo", "fence_changing"] };
    expect(reasons(testing, [])).toEqual(["Waiting for: the drive's answer, the new fence"]);
    language.value = "zh";
    expect(reasons(testing, [])).toEqual(["正在等待：驱动应答、新围栏生效"]);
  });

  it("is a row's sentence where a row is waited for or a fault's", () => {
    const silent = { ...status, mode: "DISARMED", waiting_for: ["enc_stale"] };
    expect(reasons(silent, []).join()).toMatch(/The drive reports nothing/);
    const ran = reasons(faulted("runaway"), []);
    expect(ran.filter((said) => said.startsWith("The robot moves faster"))).toHaveLength(1);
  });

  it.each([
    ["fence", /too near the fence/],
    ["contact", /bumper/],
    ["obstacle", /stands in the way/],
  ])("is the gate that shut the way: %s", (gate, words) => {
    const shut = { ...status, blocked: true };
    const log = [mode("STOPPING HOLD ok"), mode(`ACTIVE STOPPING ${gate}`)];
    expect(reasons(shut, log).join()).toMatch(words);
    expect(reasons({ ...shut, blocked: false }, log)).toEqual([]);
    language.value = "zh";
    expect(reasons(shut, log).join()).toMatch(CHINESE);
  });

  it("is not the hand that drives it now, and is so once that has let go", () => {
    const held = { reason: "teleop" as const, id: "page-1" };
    expect(reasons({ ...status, mode: "TELEOP", held }, [])).toEqual([]);
    expect(reasons({ ...status, mode: "HOLD", held }, [])).toEqual([
      "Held: it was steered by hand.",
    ]);
  });

  it("is only that the way is blocked where nobody here heard what shuts it", () => {
    const shut = { ...status, blocked: true };
    expect(reasons(shut, [])).toEqual(["The way is blocked."]);
    const before = [mode("ACTIVE STOPPING brain_lost"), mode("ACTIVE STOPPING fence")];
    expect(reasons(shut, before)).toEqual(["The way is blocked."]);
  });

  it("is that the planner was refused, with what to do", () => {
    const answer = { id: "p2", kind: "hello", accepted: false, code: "robot_mismatch", detail: "" };
    const refused = { ...status, owner: null, answers: [answer] };
    expect(reasons(refused, []).join()).toMatch(/robot\.toml.*`pons up`/);
    language.value = "zh";
    expect(reasons(refused, []).join()).toMatch(/robot\.toml.*重新启动/);
    language.value = "en";
    expect(reasons({ ...refused, owner: status.owner }, [])).toEqual([]);
    expect(reasons({ ...refused, answers: [{ ...answer, accepted: true }] }, [])).toEqual([]);
    expect(reasons({ ...refused, answers: [{ ...answer, kind: "arm" }] }, [])).toEqual([]);
  });
});

describe("the log", () => {
  it("says why a mode was left, where that has words", () => {
    expect(told(mode("ACTIVE STOPPING fence"))).toEqual({
      text: "Driving → Stopping: The way leads too near the fence. Send the robot elsewhere or steer it away by hand; where the fence is drawn wrong, change it (docs/fence.md).",
      fine: "fence",
    });
    expect(told(mode("STOPPING FAULT runaway")).text).toMatch(/Fault: The robot moves faster/);
    expect(told(mode("HOLD ACTIVE goal-1")).text).toBe("Ready → Driving");
    expect(told(mode("HOLD TELEOP teleop stop")).text).toBe("Ready → Steered by hand");
  });

  it("says which gate shut the way", () => {
    const blocked = (text: string): string => told({ ...mode(text), code: "blocked" }).text;
    expect(blocked("by fence, asked 0.40 m/s")).toMatch(/too near the fence/);
    expect(blocked("the way is not free, asked 0.40 m/s")).toBe("The way is blocked.");
    expect(blocked("by brand_new, asked 0.40 m/s")).toBe("The way is blocked.");
  });

  it("says why a planner was refused and a stop failed", () => {
    const entry = (code: string, text: string): LogEntry => ({ ...mode(text), code });
    const hello = told(entry("hello_refused", "p2 fence_mismatch came a, expected b"));
    expect(hello.text).toMatch(/refused. The bridge and the planner.*fence\.json/);
    expect(told(entry("stop_failed", "stop_too_long")).text).toMatch(/took longer than planned/);
    expect(told(entry("hello_refused", "p2 brand_new x")).text).toMatch(/was refused\.$/);
  });
});

describe("a goal that is paused", () => {
  it("says why where no row is up", () => {
    expect(reasonWords("fault(HELD)")).toBe("waits for a person");
    expect(reasonWords("fault(FAULT)")).toBe("fault");
    expect(reasonWords("fault(LIDAR_STALE)")).toMatch(/The lidar sends nothing/);
  });
});

describe("an order that is refused", () => {
  it("is explained in the person's language where the code has words", () => {
    const refusal = (code: string): string => explain(new ApiError(code, "detail"));
    expect(refusal("bad_proof")).toMatch(/not signed with this robot's/);
    expect(refusal("stick_not_neutral")).toBe("Waiting for: the joystick to be let go");
    expect(refusal("driver_nack")).toMatch(/^The drive does not take commands/);
    language.value = "zh";
    expect(refusal("not_standing")).toBe("正在等待：机器人静止");
    expect(refusal("brand_new")).toBe("brand_new：detail");
  });
});
