/** A page below a path of a proxy asks there, and keeps its token apart from its neighbour's. */
import { afterEach, expect, it, vi } from "vitest";
import { dial } from "../src/net/socket";
import { authorization, setToken, startToken } from "../src/net/token";

const at = (href: string): void => void vi.stubGlobal("location", new URL(href));

afterEach(() => void vi.unstubAllGlobals());

it.each([
  ["http://host:8420/#token=x", "ws://host:8420/v1/events"],
  ["https://host/robot/?a=1#view", "wss://host/robot/v1/events"],
  ["https://host/house/robot/", "wss://host/house/robot/v1/events"],
])("at %s the socket is %s", (href, wanted) => {
  const dialled: string[] = [];
  vi.stubGlobal("WebSocket", function (address: string): void {
    dialled.push(address);
  });
  at(href);
  dial("v1/events");
  expect(dialled).toEqual([wanted]);
});

it("two robots of one origin have a token each", () => {
  const kept = new Map<string, string>();
  vi.stubGlobal("sessionStorage", {
    getItem: (slot: string) => kept.get(slot) ?? null,
    setItem: (slot: string, text: string) => void kept.set(slot, text),
  });
  at("https://host/one/");
  setToken("first");
  at("https://host/two/");
  startToken();
  expect(authorization()).toEqual({});
  at("https://host/one/");
  startToken();
  expect(authorization()).toEqual({ authorization: "Bearer first" });
});
