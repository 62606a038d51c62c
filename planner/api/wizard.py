"""Serve the wizard: what is plugged in, which preset, three numbers, and over to set-up.

The owner's alone: it writes this home's robot.toml, saves its map and changes what `pons up` runs.
"""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Annotated, Any

from fastapi import APIRouter
from pydantic import BaseModel, Field

from planner.api.interfaces import Services
from planner.api.problems import HttpProblem
from planner.api.schemas import Body, Source
from planner.api.settings import MOVING
from planner.language.catalogue import UnknownMessage, say
from planner.setup_wizard import WizardRefusal

if TYPE_CHECKING:
    from collections.abc import Iterator

Metres = Annotated[float, Field(ge=0.01, le=3.0, strict=True)]


class PluggedIn(BaseModel):
    """Show one port or camera and what answers there."""

    path: str
    lasting: str
    part: str | None
    kind: str | None
    code: str
    device: str
    cure: dict[str, str] | None


class PresetView(BaseModel):
    """Show a robot that comes with Pons; ``fits`` counts its parts among what was found."""

    name: str
    what: str
    drive: str
    lidar: str
    base: dict[str, float]
    fits: int


class WizardView(BaseModel):
    """Show how far the set-up of a robot has come; the same on each page."""

    steps: list[str]
    done: list[str]
    step: str | None
    """The next one; null where all is done."""
    ports: list[PluggedIn] | None
    preset: str | None
    presets: list[PresetView] | None
    is_written: bool
    can_take: bool
    """Whether `pons up` changes over to the robot that was written."""
    mapping: str | None
    """Of the map that is being made."""
    can_map: bool
    """Whether `pons up` changes over to a map that grows, and back."""


class PresetChoice(Body):
    """Choose a preset."""

    preset: Annotated[str, Field(min_length=1, max_length=64)]


class Measures(Body):
    """Name the robot and give what a person has measured."""

    name: Annotated[str, Field(pattern=r"^[a-z0-9][a-z0-9_-]{0,31}$")]
    wheel_radius_m: Metres
    wheel_separation_m: Metres
    radius_m: Metres


class WizardAsk(Body):
    """Ask for a step."""

    source: Source = "api"


def routes(services: Services) -> APIRouter:
    """Return the routes below /v1/wizard."""
    router = APIRouter(prefix="/v1/wizard", tags=["setup"])

    @router.get("", operation_id="get_wizard")
    async def get() -> WizardView:
        """Say which step of setting a robot up comes next, and what it needs."""
        return await _view(services)

    @router.post("/look", operation_id="wizard_look")
    async def look(order: WizardAsk | None = None) -> WizardView:
        """Find out what is plugged in, by what moves nothing; some ten seconds."""
        return await _view_after(services, services.wizard.look())

    @router.post("/preset", operation_id="wizard_choose")
    async def choose(order: PresetChoice) -> WizardView:
        """Remember which preset is meant."""
        return await _view_after(services, services.wizard.choose(order.preset))

    @router.post("/robot", operation_id="wizard_measure")
    async def measure(order: Measures) -> WizardView:
        """Write this home's robot.toml; one that is there stays."""
        base = order.model_dump(exclude={"name"})
        return await _view_after(services, services.wizard.measure(order.name, base))

    @router.post("/take", operation_id="wizard_take", status_code=202)
    async def take(order: WizardAsk | None = None) -> dict[str, str]:
        """End what runs, and begin with the robot that was written, in set-up."""
        if not services.take_robot.is_there:
            raise _problem(WizardRefusal("wizard_elsewhere", "end `pons up` and start it again"))
        _require_standing(services)
        services.take_robot.throw()
        return {"source": (order or WizardAsk()).source}

    @router.post("/map", operation_id="wizard_map", status_code=202)
    async def begin_map(order: WizardAsk | None = None) -> dict[str, str]:
        """End what runs, and begin a map of this home; the robot stands until it is driven."""
        _require_changeover(services)
        with _refusals():
            services.wizard.check_may_map()
        services.change_map.throw()
        return {"source": (order or WizardAsk()).source}

    @router.post("/map/save", operation_id="wizard_save_map", status_code=202)
    async def save_map(order: WizardAsk | None = None) -> dict[str, str]:
        """Save the map that grows as this home's, end what runs, and begin to drive on it."""
        _require_changeover(services)
        with _refusals():
            await services.wizard.save_map()
        services.change_map.throw()
        return {"source": (order or WizardAsk()).source}

    return router


def _require_changeover(services: Services) -> None:
    """Hold that maps can be changed now."""
    if not services.change_map.is_there:
        raise _problem(WizardRefusal("map_elsewhere", "only `pons up` changes over to a map"))
    _require_standing(services)


def _require_standing(services: Services) -> None:
    status = services.robot.status
    if status is not None and status.mode in MOVING:
        raise HttpProblem(409, "robot_moves", f"the robot is {status.mode.value}",
                          message=say("settings.robot_moves").model_dump())  # fmt: skip


async def _view(services: Services) -> WizardView:
    return WizardView(
        **await services.wizard.view(),
        can_take=services.take_robot.is_there,
        can_map=services.change_map.is_there,
    )


async def _view_after(services: Services, work: Any) -> WizardView:
    with _refusals():
        await work
    return await _view(services)


@contextmanager
def _refusals() -> Iterator[None]:
    """Tell what a step refuses in both languages."""
    try:
        yield
    except WizardRefusal as refused:
        raise _problem(refused) from None
    except OSError as error:
        why = error.strerror or str(error)
        told = say("settings.settings_unwritable").model_dump()
        raise HttpProblem(503, "settings_unwritable", why, message=told) from None


def _problem(refused: WizardRefusal) -> HttpProblem:
    try:
        told = say(f"wizard.{refused.code}", detail=refused.detail)
    except UnknownMessage:
        told = say(f"wizard.{refused.unnamed}", detail=refused.detail)
    return HttpProblem(409, refused.code, refused.detail, message=told.model_dump())
