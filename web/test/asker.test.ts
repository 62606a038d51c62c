import { afterEach, describe, expect, it, vi } from "vitest";
import { asker, isOwner, learnAsker, mayForesee, mayReadReplies } from "../src/state/asker";

const ana = { id: "ana", name: "Ana", since: "2026-11-30" };

afterEach(() => {
  asker.value = null;
  vi.unstubAllGlobals();
});

describe("whoever asks", () => {
  it.each([
    ["the owner", { you: null, people: [] }, [true, true, true]],
    ["the token that only looks", { you: null, people: null }, [false, false, false]],
    ["a viewer", { you: { ...ana, role: "viewer" }, people: null }, [false, false, false]],
    ["a dispatcher", { you: { ...ana, role: "dispatcher" }, people: null }, [true, false, false]],
    ["an operator", { you: { ...ana, role: "operator" }, people: null }, [true, true, false]],
  ])("as %s is asked for no more than that role may", async (_, answer, rights) => {
    vi.stubGlobal("fetch", () => Promise.resolve(Response.json(answer)));
    await learnAsker();
    expect([mayForesee.value, mayReadReplies.value, isOwner.value]).toEqual(rights);
  });

  it("may what all may where nobody tells who it is", async () => {
    vi.stubGlobal("fetch", () => Promise.reject(new TypeError("gone")));
    await learnAsker();
    expect([mayForesee.value, mayReadReplies.value, isOwner.value]).toEqual([false, false, null]);
  });
});
