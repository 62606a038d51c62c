"""Serve rehearsals: what a sentence or a goal's plan would do, shown before anything moves."""

from __future__ import annotations

from fastapi import APIRouter
from pydantic import Field, model_validator

from planner.api.interfaces import Services
from planner.api.problems import HttpProblem
from planner.api.schemas import MAX_GOAL_CHARACTERS, Body, law_broken
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
    """Return the route."""
    router = APIRouter(prefix="/v1", tags=["goals"])

    @router.post("/rehearsals", operation_id="rehearse")
    async def rehearse(ask: RehearsalAsk) -> Rehearsal:
        """Show a plan before it moves: each step's way, its metres, seconds and narrowest place.

        Nothing moves, no goal is made and no model is asked: a sentence is read by the built-in
        rules; give a goal with ``confirm`` to rehearse what a model makes of it.

        Raises:
            HttpProblem: ``rehearsal_no_plan``, ``rehearsal_without_pose``, ``rehearsal_too_long``.
        """
        try:
            if ask.goal is not None:
                return await services.rehearser.of_plan(services.goals.goal(ask.goal).plan)
            return await services.rehearser.of_text(ask.text or "", ask.language)
        except RehearsalError as error:
            said = error.said or say(f"problem.{error.code}")
            told = said.model_dump()
            raise HttpProblem(STATUS, error.code, error.detail, message=told) from None

    return router
