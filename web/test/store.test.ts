import { expect, it, vi } from "vitest";
import {
  age,
  began,
  goals,
  layers,
  open,
  pageFresh,
  receive,
  scan,
  shown,
  startClock,
} from "../src/state/store";
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

it("shows what is so after an hour without a socket, and says that all was old until then", () => {
  vi.useFakeTimers();
  startClock();
  began();
  receive(JSON.stringify(snapshot(1)));
  vi.advanceTimersByTime(200);
  expect(pageFresh.value).toBe(true);
  open.value = false;
  vi.advanceTimersByTime(3_600_000);
  expect(pageFresh.value).toBe(false);
  expect(age("page")).toBeGreaterThan(3_500);
  began();
  expect(pageFresh.value).toBe(false); // a socket alone says nothing of the robot
  receive(JSON.stringify({ ...snapshot(1), goals: [] }));
  vi.advanceTimersByTime(200);
  expect([pageFresh.value, goals.value.length]).toEqual([true, 0]);
  vi.useRealTimers();
});
