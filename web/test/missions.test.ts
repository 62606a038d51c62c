import { describe, expect, it } from "vitest";
import { frame } from "../src/panels/MissionTrack";
import { question } from "../src/state/missions";

const asked = (path: string): Record<string, string> =>
  Object.fromEntries(new URLSearchParams(path.slice(path.indexOf("?"))));

describe("the question to the list of missions", () => {
  it("asks for all where nothing is wanted", () => {
    expect(asked(question({ day: "", state: "", search: " " }, null))).toEqual({ limit: "50" });
  });
  it("asks for one day of this device's clock, a result and words", () => {
    const { since_unix_s, until_unix_s, ...rest } = asked(
      question({ day: "2026-11-29", state: "failed", search: "a & b" }, 7),
    );
    expect(rest).toEqual({ limit: "50", state: "failed", search: "a & b", before: "7" });
    expect(Number(since_unix_s)).toBe(new Date("2026-11-29T00:00").getTime() / 1000);
    expect(Number(until_unix_s)).toBe(new Date("2026-11-30T00:00").getTime() / 1000);
  });
  it("asks for all days where the day is none", () => {
    expect(asked(question({ day: "yesterday", state: "", search: "" }, null))).toEqual({
      limit: "50",
    });
  });
});

describe("the drawing of a way", () => {
  it("is a box around it, y down", () => {
    const at = (x_m: number, y_m: number) => ({
      s: 0, x_m, y_m, yaw_rad: 0, asked_mps: 0, measured_mps: 0, mode: "ACTIVE", rows: [],
    }); // prettier-ignore
    expect(frame([at(0, 0), at(2, 3)])).toEqual([-1, -4, 4, 5]);
  });
});
