import { describe, expect, it } from "vitest";
import { decode } from "../src/wire/decode";
import { cup, goal, robot, sight, snapshot, status } from "./examples";

const text = (frame: object): string => JSON.stringify(frame);

describe("decode", () => {
  it("takes whole frames", () => {
    expect(decode(text(snapshot()))?.kind).toBe("snapshot");
    expect(decode(text({ seq: 2, kind: "robot", robot }))?.kind).toBe("robot");
    expect(decode(text({ seq: 2, kind: "robot", robot: { ...robot, status: null } }))?.kind).toBe(
      "robot",
    );
    expect(decode(text({ seq: 3, kind: "goal", change: { goal: goal("a") } }))?.kind).toBe("goal");
    expect(decode(text({ seq: 3, kind: "sight", sight }))?.kind).toBe("sight");
    const none = { version: 0, blind: "no_camera", message: cup.name, look: null, things: [] };
    expect(decode(text({ seq: 3, kind: "sight", sight: none }))?.kind).toBe("sight");
    expect(decode(text({ seq: 4, kind: "stopped", confirmed: false }))).toEqual({
      seq: 4,
      kind: "stopped",
      confirmed: false,
    });
  });

  it("takes a trial whole or not at all", () => {
    const trial = {
      robot: "r1",
      drive: "pons_mcu",
      port: "/dev/x",
      tried: null,
      phase: "trying",
      by: "page-1",
      plan: ["listen"],
      steps: [{ step: "listen", seen: "" }],
      ask: 1,
      question: { en: "a", zh: "b" },
      code: null,
      detail: "",
      cure: null,
      wrote: [],
      ports: null,
      part: [],
    };
    const framed = (given: object): unknown =>
      decode(
        text({
          seq: 2,
          kind: "robot",
          robot: { ...robot, setup: { is_there: true, trial: given } },
        }),
      );
    expect(framed(trial)).not.toBeNull();
    expect(framed({ ...trial, question: "a" })).toBeNull();
    expect(framed({ ...trial, steps: [{ step: 1 }] })).toBeNull();
  });

  it("takes of progress what is a number", () => {
    const change = { type: "progress", goal: "a", step: 0, left_m: 1.5, left_rad: "2" };
    const progress = { goal: "a", step: 0, left_m: 1.5 };
    expect(decode(text({ seq: 5, kind: "progress", change }))).toEqual({
      seq: 5,
      kind: "progress",
      progress,
    });
    const nameless = { ...change, goal: null };
    expect(decode(text({ seq: 5, kind: "progress", change: nameless }))).toBeNull();
  });

  const whole = text(snapshot());
  it.each([1, 2, 10, 100, whole.length - 1])("takes no half frame (%i characters)", (length) => {
    expect(decode(whole.slice(0, length))).toBeNull();
  });

  it.each([
    ["an unknown kind", { seq: 1, kind: "surprise" }],
    ["no kind", { seq: 1 }],
    ["no seq", { kind: "gap" }],
    ["a list", [1, 2]],
    ["a number", 7],
    ["null", null],
    ["a robot that is none", { seq: 1, kind: "robot", robot: { status: {} } }],
    [
      "a mode that is a number",
      { seq: 1, kind: "robot", robot: { ...robot, status: { ...status, mode: 3 } } },
    ],
    [
      "an answer without a verdict",
      {
        seq: 1,
        kind: "robot",
        robot: {
          ...robot,
          status: { ...status, answers: [{ id: "a", kind: "arm", code: "ok", accepted: "yes" }] },
        },
      },
    ],
    [
      "a goal without a text",
      { seq: 1, kind: "goal", change: { goal: { ...goal("a"), text: null } } },
    ],
    [
      "a patrol's stop without words",
      {
        seq: 1,
        kind: "goal",
        change: {
          goal: {
            ...goal("a"),
            plan: {
              kind: "plan",
              steps: [{ kind: "patrol", state: "running", stops: [{ place: "kitchen" }] }],
              options: [],
              text: null,
            },
          },
        },
      },
    ],
    [
      "steps that are no list",
      {
        seq: 1,
        kind: "goal",
        change: { goal: { ...goal("a"), plan: { kind: "plan", steps: 3 } } },
      },
    ],
    [
      "a path of strings",
      { seq: 1, kind: "path", path: { goal: "g", leg: 1, points: [["1", "2"]] } },
    ],
    [
      "a doubt that stands nowhere",
      {
        seq: 1,
        kind: "path",
        path: {
          goal: "g",
          leg: 1,
          points: [[1, 2]],
          doubt: { code: "route_bent", x_m: 1, y_m: 1 },
        },
      },
    ],
    [
      "a candidate without a place",
      {
        seq: 1,
        kind: "robot",
        robot: { ...robot, match: { score: 0.2, candidates: [{ pose: null, score: 1 }] } },
      },
    ],
    [
      "a thing that is nowhere",
      { seq: 1, kind: "sight", sight: { ...sight, things: [{ ...cup, x_m: null }] } },
    ],
    [
      "a look of no size",
      { seq: 1, kind: "sight", sight: { ...sight, look: { ...sight.look, width: "wide" } } },
    ],
    [
      "half a box",
      {
        seq: 1,
        kind: "sight",
        sight: {
          ...sight,
          look: {
            ...sight.look,
            boxes: [{ label: "cup", name: cup.name, score: 1, box: [1, 2, 3], id: null }],
          },
        },
      },
    ],
    ["a scan with a hole", { seq: 1, kind: "scan", scan: [1, null] }],
  ])("takes nothing with %s", (_, frame) => {
    expect(decode(JSON.stringify(frame))).toBeNull();
  });

  it("takes no number that is not finite", () => {
    const broken = text({ seq: 2, kind: "robot", robot }).replace('"x_m":1', '"x_m":1e999');
    expect(broken).toContain("1e999");
    expect(decode(broken)).toBeNull();
    expect(decode('{"seq":1e999,"kind":"gap"}')).toBeNull();
  });

  it("takes no bytes", () => {
    expect(decode(new ArrayBuffer(8))).toBeNull();
  });
});
