"""Serve what is remembered: list and search it, teach a fact, forget one, some or all of it."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Annotated, Any

from fastapi import APIRouter, Path, Query
from pydantic import Field

from planner.api.problems import HttpProblem, unknown_place
from planner.api.schemas import Body, Source
from planner.language.catalogue import say
from planner.language.object_names import name_object
from planner.memory import FACT, KINDS, FactRefusal, MemoryQuery
from planner.plan import PlaceId

if TYPE_CHECKING:
    from planner.api.interfaces import Services
    from planner.memory import Memo

MAX_QUERY = 120
MAX_BODY_FACT = 20_000
"""A longer fact is refused by its own code, with what would be kept."""
_STATUS = {"facts_full": 409, "facts_off": 409, "memory_unavailable": 503}
Kind = Annotated[str, Field(pattern="^(thing|person|fact)$")]
MemoId = Annotated[int, Path(ge=1, le=2**62)]
Words = Annotated[str, Query(max_length=MAX_QUERY)]


class NewFact(Body):
    """Teach a fact, in a person's words; nothing moves because of it."""

    text: Annotated[str, Field(max_length=MAX_BODY_FACT)]
    place: PlaceId | None = None
    """A room or place that it speaks of."""
    source: Source = "api"
    """What the client calls itself. Kept behind ``api:``, for by which door a fact came is not a
    client's to say."""


def routes(services: Services) -> APIRouter:
    """Return the routes of memory."""
    router = APIRouter(prefix="/v1/memory", tags=["memory"])

    @router.get("", operation_id="list_memories")
    async def memories(
        q: Words = "",
        kind: Annotated[Kind | None, Query()] = None,
        place: Annotated[PlaceId | None, Query()] = None,
        limit: Annotated[int, Query(ge=1, le=200)] = 50,
    ) -> dict[str, Any]:
        """List what was seen and told, the newest first; `q` searches it in words.

        What does not name all of `q` has `fits` false: it is what comes nearest.
        """
        kinds = (kind,) if kind is not None else KINDS
        query = MemoryQuery(words=q, place=place, kinds=kinds, limit=limit)
        return await _list_memories(services, query)

    @router.post("/facts", status_code=201, operation_id="teach_fact")
    async def teach(new: NewFact) -> dict[str, Any]:
        """Keep a fact; the same words again renew it. It orders nothing, whatever it says."""
        if new.place is not None and new.place not in services.memory.vocabulary:
            raise unknown_place(new.place, services.memory.vocabulary)
        try:
            door = "api" if new.source == "api" else f"api:{new.source}"
            kept = await services.recollection.teach(
                new.text, said_by=door, room=new.place, map_id=services.site.map_id
            )
        except FactRefusal as refused:
            raise _problem(refused) from None
        return memo_view(kept)

    @router.delete("", operation_id="forget_memories")
    async def forget_some(
        about: Words = "", kind: Annotated[Kind | None, Query()] = None
    ) -> dict[str, Any]:
        """Forget all that `about` names, or everything of a kind, or everything."""
        kinds = (kind,) if kind is not None else KINDS
        return {"forgotten": await _forget_some(services, about.strip(), kinds)}

    @router.delete("/{memo_id}", operation_id="forget_memory")
    async def forget(memo_id: MemoId) -> dict[str, Any]:
        """Forget one memory."""
        try:
            gone = await services.recollection.forget(memo_id)
        except FactRefusal as refused:
            raise _problem(refused) from None
        if gone is None:
            detail = f"got {memo_id}; GET /v1/memory lists what there is"
            said = say("memory.unknown_memory").model_dump()
            raise HttpProblem(404, "unknown_memory", detail, message=said)
        return {"forgotten": 1}

    return router


async def _list_memories(services: Services, query: MemoryQuery) -> dict[str, Any]:
    try:
        found = await services.recollection.find(query)
        counts = await services.recollection.counts()
    except FactRefusal as refused:
        raise _problem(refused) from None
    return {
        "version": services.recollection.changes,
        "counts": counts,
        "kept_days": services.recollection.limits_days,
        "memories": [memo_view(memo) for memo in found],
    }


async def _forget_some(services: Services, about: str, kinds: tuple[str, ...]) -> int:
    try:
        if about:
            return len(await services.recollection.forget_about(about, kinds))
        return await services.recollection.forget_all(kinds)
    except FactRefusal as refused:
        raise _problem(refused) from None


def memo_view(memo: Memo) -> dict[str, Any]:
    """Return one memory as people and pages read it."""
    seen = memo.kind != FACT
    return {
        "id": memo.id,
        "kind": memo.kind,
        "words": memo.words or None,
        "name": name_object(memo.label, memo.color).model_dump() if seen else None,
        "on": name_object(memo.support).model_dump() if memo.support else None,
        "room": memo.room,
        "x_m": None if memo.x_m is None else round(memo.x_m, 2),
        "y_m": None if memo.y_m is None else round(memo.y_m, 2),
        "first_unix_s": round(memo.first_unix_s, 1),
        "last_unix_s": round(memo.last_unix_s, 1),
        "age_s": round(max(0.0, time.time() - memo.last_unix_s), 1),
        "confidence": round(memo.confidence, 2),
        "sightings": memo.sightings,
        "step": memo.step or None,
        "source": memo.said_by or None,
        "fits": memo.fits,
    }


def _problem(refused: FactRefusal) -> HttpProblem:
    status = _STATUS.get(refused.code, 422)
    return HttpProblem(status, refused.code, refused.detail, message=refused.said.model_dump())
