"""Measure a fleet in fair weather: accepting, reaching the journal, stopping, and standing idle."""

from __future__ import annotations

import asyncio
import os
import time
from statistics import quantiles
from typing import TYPE_CHECKING

from tools.fleet_trial.storm import FIRST, PLACES
from tools.fleet_trial.verdict import written_at

if TYPE_CHECKING:
    from collections.abc import Sequence

    from tools.fleet_trial.house import House

A_SECOND, IDLE_S = 5.0, 30.0


def tell(name: str, seconds: Sequence[float], goal_s: float) -> str:
    """Return a row: how many, their median, 99th percentile and greatest, beside the goal."""
    parts = quantiles(seconds, n=100, method="inclusive")
    return (f"{name:<34} n {len(seconds):4}  p50 {1e3 * parts[49]:6.0f} ms"
            f"  p99 {1e3 * parts[98]:6.0f} ms  max {1e3 * max(seconds):6.0f} ms"
            f"  goal p99 {1e3 * goal_s:.0f} ms  load {os.getloadavg()[0]:.1f}")  # fmt: skip


async def measure(house: House, orders: int, stops: int) -> list[str]:
    """Return rows of figures; orders come at 5 a second, to anybody."""
    rows = [await _stand_idle(house)]
    accept_s, told_unix_s = [], {}
    before_s, _ = house.service_cost()
    begin_s = time.monotonic()
    for number in range(FIRST, FIRST + orders):
        await asyncio.sleep(begin_s + (number - FIRST) / A_SECOND - time.monotonic())
        text = f"go to the {PLACES[number % len(PLACES)]} and say {number}"
        asked_s = time.monotonic()
        answer = await house.client.post("/v1/missions", json={"text": text, "to": "any"})
        accept_s.append(time.monotonic() - asked_s)
        told_unix_s[number] = time.time()
        answer.raise_for_status()
    rows.append(tell("accept (202) at 5/s", accept_s, 0.05))
    await asyncio.sleep(10.0)
    rows.append(_cost(house, before_s, orders, "an order, from accept to its end"))
    written = await asyncio.to_thread(written_at, house.homes)
    late_s = [written[number] - told for number, told in told_unix_s.items() if number in written]
    rows.append(tell("accept to the robot's journal", [max(0.0, s) for s in late_s], 0.3))
    rows.append(f"  of {orders} orders {len(late_s)} are in a journal")
    stop_s, missed = [], 0
    before_s, _ = house.service_cost()
    for _ in range(stops):
        asked_s = time.monotonic()
        told = (await house.client.post("/v1/stop")).json()
        stop_s.append(time.monotonic() - asked_s)
        missed += len(told["not_reached"])
        await asyncio.sleep(0.5)
    rows.append(tell("stop all, echoed by all reached", stop_s, 0.5))
    rows.append(_cost(house, before_s, stops, "a stop of all, with 0.5 s of rest"))
    rows.append(f"  {missed} of {stops * len(house.robots)} confirmations were missing")
    return rows


def _cost(house: House, before_s: float, count: int, what: str) -> str:
    """Return a row: the processor time of the service for each of these."""
    after_s, memory_mb = house.service_cost()
    return (
        f"  {1e3 * (after_s - before_s) / count:.0f} ms of processor for {what}; {memory_mb:.0f} MB"
    )


async def _stand_idle(house: House) -> str:
    await asyncio.sleep(5.0)
    before_s, _ = house.service_cost()
    begin_s = time.monotonic()
    await asyncio.sleep(IDLE_S)
    after_s, memory_mb = house.service_cost()
    share = 100.0 * (after_s - before_s) / (time.monotonic() - begin_s)
    return (f"idle, {len(house.robots)} robots: {share:.1f} % of a core (goal 10), "
            f"{memory_mb:.0f} MB (goal 150)  load {os.getloadavg()[0]:.1f}")  # fmt: skip
