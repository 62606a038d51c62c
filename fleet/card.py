"""Read a robot's card: what the fleet uses of it has its shape, whatever version wrote the rest."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from fleet.errors import FleetError

Name = Annotated[str, Field(max_length=200)]
Words = Annotated[dict[str, Name], Field(max_length=20)]


class _Shape(BaseModel):
    model_config = ConfigDict(allow_inf_nan=False)


class _Pose(_Shape):
    x_m: float
    y_m: float


class _Place(_Shape):
    id: Name
    name: Words = {}
    aliases: Annotated[dict[str, list[Name]], Field(max_length=20)] = {}
    pose: _Pose | None = None
    polygon: Annotated[list[tuple[float, float]], Field(max_length=1_000)] | None = None


class _Card(_Shape):
    robot_id: Annotated[str, Field(min_length=1, max_length=64)]
    release: Name | None = None
    site: Name | None = None
    map_id: Name | None = None
    camera: Name | None = None
    places: Annotated[list[_Place], Field(max_length=2_000)] = []
    steps: Annotated[list[Name], Field(max_length=200)] | None = None
    languages: Annotated[list[Name], Field(max_length=20)] | None = None


def read_card(told: Any, name: str) -> dict[str, Any]:
    """Return a card as it came, unknown fields too: another version may have more of them.

    Args:
        told: what the robot answered.
        name: of the robot, for the refusal.

    Raises:
        FleetError: ``card_unread``.
    """
    try:
        _Card.model_validate(told)
    except ValidationError as wrong:
        first = wrong.errors(include_url=False)[0]
        at = ".".join(str(part) for part in first["loc"])
        raise FleetError("card_unread", f"{at}: {first['msg']}"[:200], name=name) from None
    card: dict[str, Any] = told
    return card
