import { afterEach, describe, expect, it, vi } from "vitest";
import { ApiError, fetchObjects, fetchPicture } from "../src/net/api";
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
