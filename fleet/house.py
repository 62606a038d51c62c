"""Hold the rules of the house: quiet hours, rooms for one robot, charging, budget. Pure."""

from __future__ import annotations

import os
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any
from zoneinfo import ZoneInfo, ZoneInfoNotFoundError, available_timezones

from pydantic import BaseModel, ConfigDict, Field, StrictBool, field_validator, model_validator

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

LOCALTIME = Path("/etc/localtime")
_CLOCK = r"(?:[01]\d|2[0-3]):[0-5]\d"
Ratio = Annotated[float, Field(gt=0.0, lt=1.0)]
Word = Annotated[str, Field(min_length=1, max_length=64)]


class HouseRules(BaseModel):
    """Say how the robots of a house behave together; one row, the same for all services."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)

    timezone: Annotated[str, Field(max_length=64)] | None = None
    """By whose clock quiet hours and standing orders go; None: the system's."""
    quiet: Annotated[str, Field(pattern=rf"^{_CLOCK}-{_CLOCK}$")] | None = None
    """The hours in which nothing begins that moves: ``22:00-07:00``."""
    rooms: Annotated[tuple[Word, ...], Field(max_length=100)] = ()
    """Ids of rooms in which one robot at a time may be."""
    homes: Annotated[dict[Word, Word], Field(max_length=1_000)] = {}
    """The home of a map's id; two maps of one home get the same word."""
    charge: StrictBool = True
    """A free robot with a low battery is sent to its dock."""
    low: Ratio = 0.2
    """Of the charge: low from below it on, until ``charged``."""
    charged: Ratio = 0.8
    late_min: Annotated[int, Field(ge=1, le=1_440)] = 30
    """A standing order that has not begun so long after its time is left out and told."""
    money: Annotated[float, Field(ge=0.0)] | None = None
    """Of all robots' models together, a UTC day, in the currency of their own settings."""
    calls: Annotated[int, Field(ge=0)] | None = None

    @field_validator("timezone")
    @classmethod
    def _is_zone(cls, name: str | None) -> str | None:
        if name is not None and name not in available_timezones():
            raise ValueError(f"{name!r} is no time zone; one is Europe/Berlin")
        return name

    @model_validator(mode="after")
    def _charged_above_low(self) -> HouseRules:
        if not self.low < self.charged:
            raise ValueError("charged must be above low")
        return self

    def is_quiet(self, now_unix_s: float) -> bool:
        """Return whether these are quiet hours."""
        if self.quiet is None:
            return False
        begins, ends = self.quiet.split("-")
        clock = f"{datetime.fromtimestamp(now_unix_s, zone_of(self.timezone)):%H:%M}"
        if begins <= ends:
            return begins <= clock < ends
        return clock >= begins or clock < ends

    def home_of(self, card: Mapping[str, Any]) -> tuple[str, str]:
        """Return what tells a robot's home from others, and what people call it.

        A map of the same name and other content is another home until the owner says otherwise.
        """
        map_id, site = str(card.get("map_id")), str(card.get("site"))
        named = self.homes.get(map_id)
        return (named, named) if named is not None else (map_id, site)

    def is_low(self, was_low: bool, battery: object) -> bool:
        """Return whether a battery is low; one whose charge is not told stays as it was."""
        if not isinstance(battery, int | float):
            return was_low
        return not battery >= (self.charged if was_low else self.low)

    def is_spent(self, usages: Iterable[Mapping[str, Any]], now_unix_s: float) -> bool:
        """Return whether the robots' models have spent what the house gives for a day."""
        spent = spent_today(usages, now_unix_s)
        limits = {"money": self.money, "calls": self.calls}
        return any(most is not None and not spent[kind] < most for kind, most in limits.items())


def spent_today(usages: Iterable[Mapping[str, Any]], now_unix_s: float) -> dict[str, Any]:
    """Return what all models have spent on this UTC day, as their robots told last."""
    day = f"{datetime.fromtimestamp(now_unix_s, UTC):%Y-%m-%d}"
    now = [usage for usage in usages if usage.get("day") == day]
    amounts = [usage.get("today") or {} for usage in now]
    return {
        "money": round(sum(float(each.get("money") or 0.0) for each in amounts), 6),
        "calls": sum(int(each.get("calls") or 0) for each in amounts),
        "currencies": sorted({str(each["currency"]) for each in now if each.get("currency")}),
    }


def zone_of(name: str | None) -> ZoneInfo:
    """Return a time zone by its name; without one the system's, else UTC."""
    _, found, linked = str(LOCALTIME.resolve()).partition("zoneinfo/")
    for each in (name, os.environ.get("TZ", "").removeprefix(":"), linked if found else None):
        try:
            if each:
                return ZoneInfo(each)
        except (ZoneInfoNotFoundError, ValueError, OSError):
            continue
    return ZoneInfo("UTC")
