"""Serve the house: its rules, its standing orders, and missions that wait or rest."""

from __future__ import annotations

import asyncio
import time
import uuid
from datetime import date
from typing import TYPE_CHECKING, Annotated, Any, Literal

from fastapi import APIRouter
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from fleet.addressee import Addressee, to_names
from fleet.errors import FleetError
from fleet.house import HouseRules, spent_today, zone_of
from fleet.standing import judge_standing, show_standing

if TYPE_CHECKING:
    from collections.abc import Callable

    from fleet.desk import Desk
    from fleet.records import MissionRow

    View = Callable[[MissionRow], dict[str, Any]]


class FleetBody(BaseModel):
    """Refuse unknown fields: a misspelt option must not be ignored."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class NewStanding(FleetBody):
    """Give a sentence to be said to the house again and again."""

    text: Annotated[str, Field(min_length=1, max_length=4_000)]
    when: Annotated[str, Field(min_length=1, max_length=120)]
    """Each day at a time (``19:00``), or five fields of cron."""
    timezone: Annotated[str, Field(max_length=64)] | None = None
    """None: the house's as it is now."""


class SkippedRuns(FleetBody):
    """Name a day that a standing order leaves out."""

    day: date


class OtherAddressee(FleetBody):
    """Say who shall take an order that waits."""

    to: Literal["any", "nearest"] | Annotated[str, Field(min_length=1, max_length=32)]


def house_routes(desk: Desk, view: View) -> APIRouter:
    """Return the routes."""
    router = APIRouter(prefix="/v1")
    _rules(router, desk)
    _standing(router, desk)
    _resting(router, desk, view)
    return router


def _rules(router: APIRouter, desk: Desk) -> None:
    def show(rules: HouseRules) -> dict[str, Any]:
        now_s = time.time()
        spent = spent_today((each.usage for each in desk.watches.values()), now_s)
        zone = zone_of(rules.timezone).key
        return {**rules.model_dump(mode="json"), "timezone_used": zone, "spent_today": spent,
                "is_quiet": rules.is_quiet(now_s)}  # fmt: skip

    @router.get("/house", operation_id="get_house")
    async def house() -> dict[str, Any]:
        """Show the rules of the house, and what all models have spent today."""
        return show(await asyncio.to_thread(desk.store.rules))

    @router.patch("/house", operation_id="change_house")
    async def change(changes: dict[str, Any]) -> dict[str, Any]:
        """Set some of the rules; they are in force at once."""
        try:
            rules = await asyncio.to_thread(desk.store.change_rules, changes)
        except ValidationError as wrong:
            first = wrong.errors()[0]
            at = ".".join(str(part) for part in first["loc"])
            why = f"{at}: {first['msg']}; there are {', '.join(HouseRules.model_fields)}"
            raise FleetError("invalid_request", why=why[:400]) from None
        desk.dispatcher.work.set()
        return show(rules)


def _standing(router: APIRouter, desk: Desk) -> None:
    @router.get("/orders", operation_id="list_standing_orders")
    async def several() -> dict[str, Any]:
        """List the standing orders of the house: next run, and what came of the newest."""
        rules = await asyncio.to_thread(desk.store.rules)
        kept = await asyncio.to_thread(desk.store.standing_orders)
        return {"orders": [show_standing(each, rules) for each in kept]}

    @router.post("/orders", status_code=201, operation_id="give_standing_order")
    async def give(new: NewStanding) -> dict[str, Any]:
        """Keep a standing order; who goes is decided at each of its times."""
        rules = await asyncio.to_thread(desk.store.rules)
        wanted = new.timezone if new.timezone is not None else rules.timezone
        zone = zone_of(wanted).key
        if new.timezone is not None and zone != new.timezone:
            why = f"timezone: {new.timezone!r} is none; one is Europe/Berlin"
            raise FleetError("invalid_request", why=why)
        known = tuple(sorted(desk.watches))
        cron = await asyncio.to_thread(judge_standing, new.text, new.when, zone, known)
        order_id = uuid.uuid4().hex[:8]
        kept = await asyncio.to_thread(desk.store.keep_standing, order_id, new.text, cron, zone)
        return show_standing(kept, rules)

    @router.delete("/orders/{order_id}", operation_id="remove_standing_order")
    async def remove(order_id: str) -> dict[str, Any]:
        """Remove a standing order; a mission of it that runs goes on."""
        removed = await asyncio.to_thread(desk.store.remove_standing, order_id)
        return show_standing(removed, await asyncio.to_thread(desk.store.rules))

    @router.post("/orders/{order_id}/skip", operation_id="skip_standing_order")
    async def skip(order_id: str, skipped: SkippedRuns) -> dict[str, Any]:
        """Leave one day out, by the order's own clock."""
        day = skipped.day.isoformat()
        changed = await asyncio.to_thread(desk.store.skip_standing, order_id, day)
        return show_standing(changed, await asyncio.to_thread(desk.store.rules))


def _resting(router: APIRouter, desk: Desk, view: View) -> None:
    @router.post("/missions/{mission_id}/resume", operation_id="resume_mission")
    async def resume(mission_id: str) -> dict[str, Any]:
        """Go on with a mission that its robot paused: after a stop, or a restart there."""
        return view(await desk.resume(mission_id))

    @router.post("/missions/{mission_id}/pause", operation_id="pause_mission")
    async def pause(mission_id: str) -> dict[str, Any]:
        """Keep a mission's place at its robot, standing."""
        return view(await desk.pause(mission_id))

    @router.post("/missions/{mission_id}/to", operation_id="readdress_mission")
    async def readdress(mission_id: str, other: OtherAddressee) -> dict[str, Any]:
        """Give an order that waits for a busy robot to another one, or to any."""
        if other.to in ("any", "nearest"):
            to = Addressee("any" if other.to == "any" else "nearest")
        else:
            to = Addressee("named", to_names((other.to,), tuple(sorted(desk.watches))))
        return view(await desk.readdress(mission_id, to))
