"""Serve rehearsals: what a sentence or a goal's plan would do, shown before anything moves."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from fastapi import APIRouter
from pydantic import Field, model_validator

from planner.api.interfaces import Services
from planner.api.problems import HttpProblem
from planner.api.schemas import MAX_GOAL_CHARACTERS, Body, law_broken
from planner.driven_rehearsal import DrivenRehearsal
from planner.language.catalogue import say
from planner.plan import Language
from planner.rehearsal import Rehearsal, RehearsalError
from wire.bounded_types import Name

STATUS = 409


class RehearsalAsk(Body):
    """Ask what a sentence would do, or a goal's plan: one of the two."""

    text: str | None = Field(default=None, max_length=MAX_GOAL_CHARACTERS)
    language: Language | None = None
    goal: Name | None = None

    @model_validator(mode="after")
    def _one_of_both(self) -> RehearsalAsk:
        if (self.text is None) == (self.goal is None):
            raise law_broken("rehearsal_of_one")
        return self


def routes(services: Services) -> APIRouter:
    """Return the routes."""
    router = APIRouter(prefix="/v1", tags=["goals"])

    @router.post("/rehearsals", operation_id="rehearse")
    async def rehearse(ask: RehearsalAsk) -> Rehearsal:
        """Show a plan before it moves: each step's way, its metres, seconds and narrowest place.

        Nothing moves, no goal is made and no model is asked: a sentence is read by the built-in
        rules; give a goal with ``confirm`` to rehearse what a model makes of it.

        Raises:
            HttpProblem: ``rehearsal_no_plan``, ``rehearsal_without_pose``, ``rehearsal_too_long``.
        """
        with _problems():
            if ask.goal is not None:
                return await services.rehearser.of_plan(services.goals.goal(ask.goal).plan)
            return await services.rehearser.of_text(ask.text or "", ask.language)

    _driving(router, services)
    return router


def _driving(router: APIRouter, services: Services) -> None:
    @router.post("/rehearsals/drive", status_code=202, operation_id="drive_rehearsal")
    async def drive(ask: RehearsalAsk) -> DrivenRehearsal:
        """Drive a whole plan in the simulator, from here and now; the robot does not move.

        It is driven in a process of its own, among what was seen last; ``GET`` tells how it goes.

        Raises:
            HttpProblem: ``rehearsal_running``, ``rehearsal_map_grows``, and those of a rehearsal.
        """
        drives = services.rehearsal_drives
        with _problems():
            if ask.goal is not None:
                return await drives.of_plan(services.goals.goal(ask.goal).plan)
            return await drives.of_text(ask.text or "", ask.language)

    @router.get("/rehearsals/drive", operation_id="get_driven_rehearsal")
    async def get() -> DrivenRehearsal:
        """Return the newest rehearsal in the simulator, under way or over.

        Raises:
            HttpProblem: ``rehearsal_none``.
        """
        return _newest(services.rehearsal_drives.newest)

    @router.delete("/rehearsals/drive", operation_id="cancel_rehearsal")
    async def cancel() -> DrivenRehearsal:
        """End the rehearsal in the simulator, if one runs, and return what it came to.

        Raises:
            HttpProblem: ``rehearsal_none``.
        """
        return _newest(await services.rehearsal_drives.cancel())


def _newest(newest: DrivenRehearsal | None) -> DrivenRehearsal:
    if newest is None:
        said = say("problem.rehearsal_none").model_dump()
        raise HttpProblem(404, "rehearsal_none", "no plan was driven yet", message=said)
    return newest


@contextmanager
def _problems() -> Iterator[None]:
    try:
        yield
    except RehearsalError as error:
        told = (error.said or say(f"problem.{error.code}")).model_dump()
        raise HttpProblem(STATUS, error.code, error.detail, message=told) from None
