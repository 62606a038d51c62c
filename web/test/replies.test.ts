import type { ComponentChildren, VNode } from "preact";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { language } from "../src/i18n";
import { setToken } from "../src/net/token";
import { ReplyList } from "../src/panels/Replies";
import { fetchReplies, wasModelAsked } from "../src/state/replies";
import type { ModelReply, Tag } from "../src/wire/types";
import { goal } from "./examples";

const reply: ModelReply = {
  at: "2026-01-01T12:00:00Z",
  model: "qwen3",
  turn: "repair",
  text: '<img src=x onerror="alert(1)">\n{"kind": "plan"}',
  cut: false,
  used: false,
};

const tag = (name: string, fallback_from: string | null): Tag => ({
  name,
  version: "1",
  fallback_from,
  fallback_reason: null,
  fallback_message: null,
});

/** Answer each request with the next of these, the last again and again; return what was asked. */
function answering(...made: (() => Response)[]): string[] {
  const asked: string[] = [];
  vi.stubGlobal("fetch", (path: string) => {
    const make = made[Math.min(asked.length, made.length - 1)];
    asked.push(path);
    return make ? Promise.resolve(make()) : Promise.reject(new TypeError("no network"));
  });
  return asked;
}

let asker = 0;
beforeEach(() => {
  vi.stubGlobal("sessionStorage", { setItem: () => undefined });
  vi.stubGlobal("location", { pathname: "/" });
  setToken(`token-${asker++}`); // each test is an asker whom nobody has turned away
});
afterEach(() => {
  vi.unstubAllGlobals();
  language.value = "en";
});

describe("a goal", () => {
  it.each([
    ["nobody has planned", null, false],
    ["the offline brain has planned", tag("offline", null), false],
    ["a model has planned", tag("qwen3", null), true],
    ["the offline brain has planned for a model", tag("offline", "qwen3"), true],
  ])("that %s: %#", (_, brain, asked) => {
    expect(wasModelAsked(goal("a", "running", { brain }))).toBe(asked);
  });
});

describe("what the model wrote", () => {
  it("is fetched by its goal", async () => {
    const asked = answering(() => Response.json({ kept: 5, replies: [reply] }));
    expect(await fetchReplies("g 1")).toEqual([reply]);
    expect(await fetchReplies("g2")).toEqual([reply]);
    expect(asked).toEqual(["v1/goals/g%201/replies", "v1/goals/g2/replies"]);
  });

  it.each([
    ["nothing is kept", () => Response.json({ kept: 0, replies: [] })],
    ["a viewer asks", () => Response.json({ code: "operator_needed" }, { status: 403 })],
  ])("is not asked for again where %s, until another asks", async (_, make) => {
    const asked = answering(make, () => Response.json({ kept: 5, replies: [reply] }));
    expect(await fetchReplies("g1")).toEqual([]);
    expect(await fetchReplies("g2")).toEqual([]);
    expect(asked).toHaveLength(1);
    setToken(`token-${asker++}`);
    expect(await fetchReplies("g2")).toEqual([reply]);
  });

  it("is asked for again where nobody answered, or this goal is gone", async () => {
    const gone = () => Response.json({ code: "unknown_goal" }, { status: 404 });
    const asked = answering(gone, () => Response.json({ kept: 5, replies: [] }));
    for (const id of ["g1", "g2", "g3"]) expect(await fetchReplies(id)).toEqual([]);
    expect(asked).toHaveLength(3);
    answering();
    expect(await fetchReplies("g4")).toEqual([]);
  });
});

/** Return every node of a drawn tree. */
function nodes(drawn: ComponentChildren): readonly (VNode | string)[] {
  if (Array.isArray(drawn)) return drawn.flatMap(nodes);
  if (typeof drawn === "string") return [drawn];
  if (typeof drawn !== "object" || drawn === null) return [];
  const node = drawn as VNode<{ children?: ComponentChildren }>;
  return [node, ...nodes(node.props.children)];
}

describe("the list of replies", () => {
  it.each([
    ["en", "repair", "not used", "used", "(nothing)"],
    ["zh", "修正", "未采用", "已采用", "（空）"],
  ] as const)("is plain text in %s", (tongue, turn, unused, used, empty) => {
    language.value = tongue;
    const replies = [reply, { ...reply, used: true, text: "" }];
    const drawn = nodes(ReplyList({ replies }));
    const words = drawn.filter((node) => typeof node === "string");
    expect(words).toContain(reply.text);
    for (const word of [turn, unused, used, empty, "qwen3"]) expect(words).toContain(word);
    for (const node of drawn)
      if (typeof node !== "string")
        expect(node.props).not.toHaveProperty("dangerouslySetInnerHTML");
  });
});
