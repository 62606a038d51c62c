import { expect, it, vi } from "vitest";
import { began, layers, receive, scan, shown, startClock } from "../src/state/store";
import { robot, snapshot } from "./examples";

const hear = (seq: number, frame: object): void => receive(JSON.stringify({ seq, ...frame }));
const points = [100, 200, 300, 400];

it("draws a scan with the robot's next word, or by the clock where the robot is silent", () => {
  vi.useFakeTimers();
  startClock();
  receive(JSON.stringify(snapshot(1)));
  hear(2, { kind: "scan", scan: points });
  expect(scan.value).toEqual([100, 200]); // as the snapshot has it
  hear(3, { kind: "robot", robot });
  expect(scan.value).toEqual(points);
  expect(shown.value).not.toBeNull();
  hear(4, { kind: "scan", scan: [] });
  expect(scan.value).toEqual(points);
  vi.advanceTimersByTime(200);
  expect(scan.value).toEqual([]);
  hear(5, { kind: "scan", scan: points });
  began(); // what the connection before had not shown is not this one's
  vi.advanceTimersByTime(400);
  expect(scan.value).toEqual([]);
  expect(layers.value.cells).toEqual([]);
  vi.useRealTimers();
});
