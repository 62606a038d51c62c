"""Serve the people who may use this robot: the owner sees and changes all, a person itself."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Annotated, Any

from fastapi import APIRouter
from pydantic import Field
from starlette.requests import Request

from planner.api.problems import HttpProblem
from planner.api.schemas import Body
from planner.people import ASKER, PeopleError, Person, Role

if TYPE_CHECKING:
    from planner.api.interfaces import Services

_STATUS = {"unknown_person": 404}


class NewPerson(Body):
    """Let a person, or one of their devices, use the robot."""

    name: Annotated[str, Field(min_length=1, max_length=64)]
    role: Role = Role.OPERATOR


def routes(services: Services) -> APIRouter:
    """Return the routes below /v1/people."""
    router = APIRouter(prefix="/v1/people", tags=["people"])
    people = services.people

    @router.get("", operation_id="list_people")
    async def several(request: Request) -> dict[str, Any]:
        """Tell who asks, and to the owner who may use the robot; no token is told again."""
        asker = ASKER.get()
        is_owner = asker is None and request.state.role is Role.OPERATOR
        return {
            "you": None if asker is None else _view(asker),
            "people": [_view(person) for person in people.list_all()] if is_owner else None,
        }

    @router.post("", operation_id="add_person", status_code=201)
    async def add(new: NewPerson) -> dict[str, Any]:
        """Add a person and give the token, which is told this once."""
        try:
            person, token = await asyncio.to_thread(people.add, new.name, new.role)
        except PeopleError as refused:
            raise _problem(refused) from None
        return {**_view(person), "token": token}

    @router.delete("/{person_id}", operation_id="remove_person")
    async def remove(person_id: str) -> dict[str, Any]:
        """Forget a person; the next request with their token is refused."""
        try:
            return _view(await asyncio.to_thread(people.remove, person_id))
        except PeopleError as refused:
            raise _problem(refused) from None

    return router


def _view(person: Person) -> dict[str, Any]:
    return {"id": person.id, "name": person.name, "role": person.role, "since": person.since}


def _problem(refused: PeopleError) -> HttpProblem:
    return HttpProblem(_STATUS.get(refused.code, 409), refused.code, refused.detail)
