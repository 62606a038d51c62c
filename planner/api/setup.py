"""Serve set-up: what is plugged in, and the trial of a robot of metal, wheels off the ground.

Relays and decides nothing: the process at the bridge's place asks for the operator's proof itself,
and takes a page that falls silent for gone (docs/robot-try.md).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from fastapi import APIRouter

from planner.api.interfaces import Services
from planner.api.problems import HttpProblem
from planner.api.schemas import SetupAsk, TrialAsk
from wire import Mode, TrialOrder

if TYPE_CHECKING:
    from planner.api.interfaces import Robot


def routes(services: Services) -> APIRouter:
    """Return the routes of set-up."""
    router = APIRouter(prefix="/v1", tags=["setup"])
    robot = services.robot

    @router.post("/trial", operation_id="trial", status_code=202)
    async def trial(asked: TrialAsk) -> dict[str, Any]:
        """Begin a trial, watch it three times a second, look at the ports, or leave set-up."""
        if robot.trial is None:
            raise HttpProblem(409, "no_setup", "this robot is not in set-up, or set-up is silent")
        order = TrialOrder(
            id=asked.id,
            source=asked.source,
            act=asked.act,
            answered=asked.answered,
            proof=asked.proof,
        )
        if not await robot.order_trial(order):
            raise HttpProblem(503, "setup_silent", f"set-up did not take {asked.act} within 2 s")
        return {"act": asked.act}

    @router.post("/setup", operation_id="set_up", status_code=202)
    async def set_up(asked: SetupAsk | None = None) -> dict[str, Any]:
        """Take the bridge down and put set-up in its place; only while disarmed."""
        if not services.setup.is_there:
            raise HttpProblem(
                409,
                "setup_unavailable",
                "only `pons up`, on a robot of metal with a serial line, changes to set-up; "
                "elsewhere stop the bridge and run `pons robot try`",
            )
        _require_disarmed(robot)
        services.setup.throw()
        return {"source": (asked or SetupAsk()).source}

    return router


def _require_disarmed(robot: Robot) -> None:
    status = robot.status
    if status is None or status.mode is not Mode.DISARMED:
        mode = "unknown" if status is None else status.mode.value
        raise HttpProblem(409, "not_disarmed", f"the robot is {mode}; disarm it first")


def setup_view(services: Services) -> dict[str, Any]:
    """Return whether set-up can be had, and how its trial stands; null while a bridge drives."""
    trial = services.robot.trial
    return {
        "is_there": services.setup.is_there,
        "trial": None if trial is None else trial.model_dump(mode="json"),
    }
