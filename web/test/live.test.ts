/** What of the planner's words means that it has stopped. */
import { expect, test } from "vitest";
import { saysStopped } from "../src/talk/live";

test("only the planner's own word is a stop", () => {
  expect(saysStopped('{"type":"stopped","transcript":"stop","confirmed":true}')).toBe(true);
  for (const other of ['{"type":"problem","code":"x"}', "stopped", "null", "[]", "{", 7, null])
    expect(saysStopped(other)).toBe(false);
});
