"""Hold robots to the shape of what they tell, so that a wrong answer of one troubles no other."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from fleet.errors import FleetError
from fleet.link import RobotRefusal

if TYPE_CHECKING:
    from collections.abc import Mapping

Words = dict[str, str]
Spent = Annotated[float, Field(ge=0.0)]


class _Shape(BaseModel):
    model_config = ConfigDict(extra="allow", allow_inf_nan=False)


class _Point(_Shape):
    x_m: float
    y_m: float


class CardPlace(_Shape):
    """Be a place of a card."""

    id: str
    name: Words = {}
    aliases: dict[str, list[str]] = {}
    pose: _Point | None = None
    polygon: list[tuple[float, float]] | None = None


class CardSkill(_Shape):
    """Be a skill of the owner's, with the sentences that call it."""

    name: str
    en: list[str] = []
    zh: list[str] = []


class Card(_Shape):
    """Be what ``GET /v1/capabilities`` tells, and the skills of ``GET /v1/skills``."""

    robot_id: str
    map_id: str | None = None
    site: str | None = None
    places: list[CardPlace] = []
    skills: list[CardSkill] = []
    steps: list[str] = []
    languages: list[str] = []
    camera: str | None = None


class _Drive(_Shape):
    battery: float | None = None


class _Status(_Shape):
    drive: _Drive | None = None
    base_in_map: _Point | None = None


class RobotTold(_Shape):
    """Be what ``GET /v1/robot`` tells."""

    status: _Status | None = None
    room: str | None = None
    map_id: str | None = None


class _Amounts(_Shape):
    money: Spent = 0.0
    calls: Annotated[int, Field(ge=0)] = 0


class UsageTold(_Shape):
    """Be what ``GET /v1/usage`` tells. Nobody gives anything back to the house's budget."""

    model: str | None = "?"
    day: str = ""
    currency: str | None = None
    today: _Amounts = _Amounts()


def read_told(shape: type[_Shape], told: Mapping[str, Any]) -> dict[str, Any]:
    """Return what a robot told, as it is meant to be.

    Raises:
        RobotRefusal: ``answer_unread``: it is not.
    """
    try:
        return shape.model_validate(told).model_dump()
    except ValidationError as wrong:
        first = wrong.errors()[0]
        at = ".".join(str(part) for part in first["loc"])[:200]
        told_as = FleetError("answer_unread", name=shape.__name__, why=f"{at}: {first['msg']}")
        raise RobotRefusal(502, told_as.code, told_as.detail, told_as.message) from None
