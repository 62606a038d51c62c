"""Send free robots with a low battery to their dock, once until they have charged.

A robot that goes home by its own standing order is left to it. The goal comes behind whatever a
person gave at the robot itself, and ends nothing.
"""

from __future__ import annotations

import asyncio
import logging
import uuid
from typing import TYPE_CHECKING, Any, Protocol

from fleet.addressee import Addressee
from fleet.choice import place_names
from fleet.errors import FleetError
from fleet.link import RobotAway, RobotBusy, RobotRefusal
from fleet.records import CHARGE
from fleet.watch import SOURCE, battery_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fleet.dispatch import Dispatcher
    from fleet.house import HouseRules
    from fleet.store import FleetStore
    from fleet.watch import RobotWatch

log = logging.getLogger(__name__)

LOOK_S = 2.0
DOCKS = frozenset({"dock", "charging dock", "docking station", "charger", "charging station",
                   "充电桩", "充电座"})  # fmt: skip
"""Names by which a card's place is where a robot charges."""


class ChargeDesk(Protocol):
    """Be where batteries are looked after."""

    store: FleetStore
    watches: dict[str, RobotWatch]
    dispatcher: Dispatcher


def dock_of(card: Mapping[str, Any]) -> Mapping[str, Any] | None:
    """Return the place of a card where its robot charges."""
    return next((place for name, place in place_names(card) if name in DOCKS), None)


async def look_after_batteries(desk: ChargeDesk) -> None:
    """Note who is low, and send who is free, until cancelled. Raises SQLAlchemyError."""
    while True:
        await asyncio.sleep(LOOK_S)
        try:
            rules = await asyncio.to_thread(desk.store.rules)
            lows = await note_batteries(desk, rules)
            if lows and rules.charge:
                await send_to_charge(desk, lows)
        except FleetError as refused:  # queue_full
            log.warning("%s", refused)


async def note_batteries(desk: ChargeDesk, rules: HouseRules) -> dict[str, float]:
    """Keep who is low on battery and since when; a robot that is silent stays as it was."""
    lows = await asyncio.to_thread(desk.store.lows)
    has_changed = False
    for name, watch in list(desk.watches.items()):
        was = name in lows
        low = rules.is_low(was, battery_of(watch.told)) if watch.is_ready else was
        if low != was:
            has_changed = True
            await asyncio.to_thread(desk.store.note_low, name, low=low)
    if not has_changed:
        return lows
    desk.dispatcher.work.set()
    return await asyncio.to_thread(desk.store.lows)


async def send_to_charge(desk: ChargeDesk, lows: Mapping[str, float]) -> None:
    """Give each robot that is low and free one mission to its dock."""
    held = await asyncio.to_thread(desk.store.missions_at_robots)
    cards = {row.name: row.capabilities for row in await asyncio.to_thread(desk.store.robots)}
    for name, since_s in lows.items():
        watch, dock = desk.watches.get(name), dock_of(cards.get(name, {}))
        if watch is None or dock is None or not watch.is_ready or name in held:
            continue
        key = f" {CHARGE}{name}-{since_s}"  # no client has a key that begins with a space
        if await asyncio.to_thread(desk.store.has_order, key) or await goes_by_itself(watch):
            continue
        words = f"go to the {(dock.get('name') or {}).get('en') or dock['id']}"
        body = {"language": "en", "source": SOURCE, "confirm": False,
                "steps": [{"kind": "go_to", "place": dock["id"]}]}  # fmt: skip
        wanted = [(f"m-{uuid.uuid4().hex}", Addressee("named", (name,)), body, False)]
        order_id = f"{CHARGE}{uuid.uuid4().hex[:20]}"
        await asyncio.to_thread(desk.store.accept, order_id, words, key, key, wanted, words)
        log.warning("%s is low on battery and is sent to charge", name)
        desk.dispatcher.work.set()


async def goes_by_itself(watch: RobotWatch) -> bool:
    """Return whether a robot has a standing order upon a low battery; one that can't say may."""
    try:
        told = await watch.link.get("/v1/orders")
        return any(
            (order.get("rule") or {}).get("event") == "battery_low"
            and order.get("state") == "active"
            for order in told["orders"]
        )
    except RobotRefusal:  # an older robot has no such route, and no such order
        return False
    except (RobotAway, RobotBusy, KeyError, TypeError, AttributeError):
        return True
