import { afterEach, describe, expect, it, vi } from "vitest";
import {
  actOnGoal,
  answerGoal,
  ApiError,
  fetchObjects,
  fetchPicture,
  giveGoal,
  giveOrder,
} from "../src/net/api";
import { givePoints, putMarks } from "../src/net/marks";
import { setToken, tokenNeeded } from "../src/net/token";

const answering = (make: () => Response): void => {
  vi.stubGlobal("fetch", () => Promise.resolve(make()));
};
const code = (asked: Promise<unknown>): Promise<string> =>
  asked.then(
    () => "well",
    (error: unknown) => (error instanceof ApiError ? error.code : String(error)),
  );

afterEach(() => void vi.unstubAllGlobals());

describe("an answer", () => {
  it.each([
    ["whole", () => Response.json({ version: 1, objects: [] }), "well"],
    ["that breaks off", () => new Response('{"version": 1, "obj'), "planner_silent"],
    ["that refuses", () => Response.json({ code: "no_camera" }, { status: 503 }), "no_camera"],
    ["that is no JSON", () => new Response("<p>proxy</p>", { status: 502 }), "http_502"],
  ])("%s is read so", async (_, make, expected) => {
    answering(make);
    expect(await code(fetchObjects())).toBe(expected);
  });

  it("without a picture is none", async () => {
    answering(() => new Response("{}", { status: 503 }));
    expect(await code(fetchPicture())).toBe("http_503");
    answering(() => new Response("\xff\xd8"));
    expect(await code(fetchPicture())).toBe("well");
  });
});

describe("a refused token", () => {
  const refused = (): Response => Response.json({ code: "token_needed" }, { status: 401 });

  it("is asked for", async () => {
    vi.stubGlobal("sessionStorage", { setItem: () => undefined });
    vi.stubGlobal("location", { pathname: "/" });
    setToken("wrong");
    answering(refused);
    expect(await code(fetchObjects())).toBe("token_needed");
    expect(tokenNeeded.value).toBe(true);
  });

  it("is not asked for again by an answer to what was sent before it was given", async () => {
    vi.stubGlobal("sessionStorage", { setItem: () => undefined });
    vi.stubGlobal("location", { pathname: "/" });
    setToken("wrong");
    let answer: (late: Response) => void = () => undefined;
    vi.stubGlobal("fetch", () => new Promise<Response>((resolve) => (answer = resolve)));
    const asked = code(fetchObjects());
    setToken("right");
    answer(refused());
    expect(await asked).toBe("token_needed");
    expect(tokenNeeded.value).toBe(false);
  });
});

describe("what a person orders on the page", () => {
  const marks = { version: 1, map_id: "m", keep_outs: [], speed_zones: [] } as const;
  const here = { x_m: 1, y_m: 2 };
  it.each([
    ["a sentence", () => giveGoal("wait", false, null)],
    ["points of the map", () => givePoints([here], "m", "en", false, null)],
    ["an answer", () => answerGoal("g", "yes", null)],
    ["an act", () => actOnGoal("g", "cancel")],
    ["marks", () => putMarks(marks, null, null)],
    ["a standing order", () => giveOrder("every day wait")],
  ])("is told as the page's: %s", async (_, order) => {
    const sent: unknown[] = [];
    vi.stubGlobal("fetch", (_path: string, request: RequestInit) => {
      sent.push(JSON.parse(request.body as string));
      return Promise.resolve(Response.json({}));
    });
    await order();
    expect(sent).toEqual([expect.objectContaining({ source: "page" })]);
  });
});
