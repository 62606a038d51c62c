"""Serve the owner's settings: what is set, changing it, trying the model, and the next start.

The owner's alone: an address that is typed here is where people's words and a key go. No key is
ever told.
"""

from __future__ import annotations

import asyncio
import errno
from functools import partial
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeVar

from fastapi import APIRouter
from pydantic import BaseModel, Field, StrictBool, StrictFloat, StrictInt, StrictStr

from planner.api.interfaces import Services
from planner.api.problems import HttpProblem
from planner.api.schemas import Body, Source
from planner.language.catalogue import UnknownMessage, say
from planner.settings.page_fields import MAX_TEXT
from planner.settings_desk import SettingsRefusal, reach
from wire import ConfigError, Mode

if TYPE_CHECKING:
    from collections.abc import Callable

Text = Annotated[StrictStr, Field(max_length=MAX_TEXT)]
T = TypeVar("T")
MOVING = frozenset({Mode.ACTIVE, Mode.TELEOP, Mode.STOPPING})


class SettingView(BaseModel):
    """Show one setting; a secret's value is never told."""

    name: str
    group: str
    kind: Literal["text", "secret", "yes", "number", "choice"]
    value: str | bool | int | float | None
    is_set: bool
    source: Literal["file", "environment", "default"]
    choices: list[str]
    least: float | None
    most: float | None
    in_force: Literal["at_once", "next_start"]
    is_pending: bool
    """Saved, and not in force before the next start."""


class SettingsChangeView(BaseModel):
    """Tell who changed what, and when."""

    at: str
    by: str
    names: list[str]


class SettingsView(BaseModel):
    """Show all settings of the page."""

    revision: str
    """Of the file as it was read: a change names the one that its person saw."""
    fields: list[SettingView]
    changes: list[SettingsChangeView]
    can_restart: bool
    """Whether the planner is started again where it ends."""


class SettingsChange(Body):
    """Change settings, all or none; null takes one away."""

    revision: Annotated[str, Field(max_length=64)]
    changes: Annotated[
        dict[
            Annotated[str, Field(max_length=64)],
            Text | StrictBool | StrictInt | StrictFloat | None,
        ],
        Field(min_length=1, max_length=64),
    ]
    source: Source = "api"


class ModelTest(Body):
    """Name a server that is not saved yet; without, the saved one is tried."""

    url: Text | None = None


class ModelReachability(BaseModel):
    """Tell whether a model's server can be connected to."""

    name: str
    where: str
    is_reached: bool
    trouble: str | None


class RestartAsk(Body):
    """Ask for the planner's next start."""

    source: Source = "api"


def routes(services: Services) -> APIRouter:
    """Return the routes below /v1/settings."""
    router = APIRouter(prefix="/v1/settings", tags=["settings"])

    @router.get("", operation_id="get_settings")
    async def get() -> SettingsView:
        """Give every setting of the page; of a key only whether it is set."""
        return _view(services, await _do_on_disk(services.settings_desk.view))

    @router.patch("", operation_id="change_settings")
    async def change(order: SettingsChange) -> SettingsView:
        """Save changes, if a start would take them; the answer says which are in force."""
        desk = services.settings_desk
        change = partial(desk.change, order.revision, order.changes, order.source)
        return _view(services, await _do_on_disk(change))

    @router.post("/model/test", operation_id="test_model")
    async def test_model(order: ModelTest | None = None) -> ModelReachability:
        """Connect to a model's server; nothing is sent, so nothing is spent."""
        desk, wanted = services.settings_desk, order or ModelTest()
        name, address = await _do_on_disk(partial(desk.model_to_test, wanted.url))
        return ModelReachability(**await asyncio.to_thread(reach, name, address))

    @router.post("/restart", operation_id="restart_planner", status_code=202)
    async def restart(order: RestartAsk | None = None) -> dict[str, str]:
        """Start the planner again, so that all settings are in force; only while standing."""
        if not services.restart.is_there:
            detail = "nobody starts this planner again; end `pons up` and start it"
            raise HttpProblem(409, "restart_unavailable", detail)
        status = services.robot.status
        if status is not None and status.mode in MOVING:
            raise HttpProblem(
                409, "robot_moves", f"the robot is {status.mode.value}; stop it first"
            )
        services.restart.throw()
        return {"source": (order or RestartAsk()).source}

    return router


def _view(services: Services, shown: dict[str, Any]) -> SettingsView:
    return SettingsView(**shown, can_restart=services.restart.is_there)


async def _do_on_disk(work: Callable[[], T]) -> T:
    """Do what blocks on the disk beside the loop; its refusals are told in both languages."""
    try:
        return await asyncio.to_thread(work)
    except SettingsRefusal as refused:
        status = 409 if refused.code in ("settings_changed", "model_unset") else 422
        raise _problem(status, refused.code, refused.detail, **refused.said) from None
    except ConfigError as wrong:
        raise _problem(422, wrong.code, wrong.detail, detail=wrong.detail) from None
    except OSError as error:
        full = error.errno == errno.ENOSPC
        code, status = ("settings_disk_full", 507) if full else ("settings_unwritable", 503)
        raise _problem(status, code, error.strerror or str(error)) from None


def _problem(status: int, code: str, why: str, **said: str) -> HttpProblem:
    name = code.removeprefix("orders.")
    try:
        told = say(f"settings.{name}", **said)
    except UnknownMessage:
        told = say("settings.settings_malformed", detail=why)
    return HttpProblem(status, name, why, message=told.model_dump())
