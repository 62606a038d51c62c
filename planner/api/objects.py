"""Serve the remembered things on the map, and an operator's order to forget them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

from fastapi import APIRouter, Path

from planner.api.interfaces import Services
from planner.api.problems import HttpProblem, saying_of
from planner.language.object_names import name_object
from planner.memory import FactRefusal
from planner.perception.failure import REFUSALS

if TYPE_CHECKING:
    from planner.perception import LookSnapshot, Thing

ThingId = Annotated[str, Path(min_length=1, max_length=120)]
RETOLD_S = 2.0
"""A thing that changed is told so long in each event: whoever missed one has it from the next."""


def routes(services: Services) -> APIRouter:
    """Return the routes of things."""
    router = APIRouter(prefix="/v1/objects", tags=["objects"])

    @router.get("", operation_id="list_objects")
    async def objects() -> dict[str, Any]:
        """List the remembered objects, why nothing is seen now, and the classes that could be.

        What has one of `sightings` was in one picture alone, and may be a mistake.
        """
        return objects_view(services)

    @router.delete("", operation_id="forget_objects")
    async def forget_all() -> dict[str, Any]:
        """Forget all objects, in memory too; those that are there will be seen again."""
        gone = [thing.id for thing in services.eyes.forget()]
        await _forget_in_memory(services, gone)
        return {"forgotten": gone}

    @router.delete("/{thing_id}", operation_id="forget_object")
    async def forget(thing_id: ThingId) -> dict[str, Any]:
        """Forget one thing, in memory too."""
        known = {thing.id for thing in services.eyes.sight.things}
        if thing_id not in known:
            names = ", ".join(sorted(known)[:20]) or "none"
            raise HttpProblem(404, "unknown_object", f"got {thing_id[:60]!r}; known: {names}")
        gone = [thing.id for thing in services.eyes.forget(thing_id)]
        await _forget_in_memory(services, gone)
        return {"forgotten": gone}

    return router


async def _forget_in_memory(services: Services, things: list[str]) -> None:
    try:
        await services.recollection.forget_things(things)
    except FactRefusal as refused:
        raise HttpProblem(503, refused.code, refused.detail, **saying(refused)) from None


def saying(refused: FactRefusal) -> dict[str, Any]:
    """Return the sentence of memory's refusal, for a person."""
    return {"message": refused.said.model_dump()}


def objects_view(services: Services) -> dict[str, Any]:
    """Return all that is known by eye."""
    eyes = services.eyes
    sight = eyes.sight
    return {
        "version": eyes.version,
        **_blind(sight.blind),
        "classes": [{"id": label, "name": _name_object(label)} for label in eyes.classes],
        "objects": [thing_view(thing, eyes.now_s) for thing in sight.things],
    }


def sight_view(services: Services) -> dict[str, Any]:
    """Return the newest look and the objects that changed of late, as a page draws them."""
    eyes = services.eyes
    sight, now_s = eyes.sight, eyes.now_s
    since_s = now_s - RETOLD_S
    changed = (t for t in sight.things if eyes.changed_s.get(t.id, now_s) >= since_s)
    return {
        "version": eyes.version,
        **_blind(sight.blind),
        "look": None if sight.look is None else _look(sight.look, now_s),
        "things": [thing_view(thing, now_s) for thing in changed],
    }


def thing_view(thing: Thing, now_s: float) -> dict[str, Any]:
    """Return one thing as people and pages read it."""
    return {
        "id": thing.id,
        "label": thing.label,
        "name": _name_object(thing.label, thing.color),
        "color": thing.color,
        "x_m": round(thing.x_m, 2),
        "y_m": round(thing.y_m, 2),
        "z_m": round(thing.z_m, 2),
        "sigma_m": round(thing.sigma_m, 2),
        "confidence": round(thing.confidence, 2),
        "age_s": round(max(0.0, now_s - thing.seen_s), 1),
        "room": thing.room,
        "sightings": thing.sightings,
    }


def _look(look: LookSnapshot, now_s: float) -> dict[str, Any]:
    here = look.here or ("",) * len(look.detections)
    return {
        "seq": look.seq,
        "age_s": round(max(0.0, now_s - look.taken_s), 2),
        "width": look.width,
        "height": look.height,
        "placed": look.base_in_map is not None,
        "boxes": [
            {
                "label": seen.label,
                "name": _name_object(seen.label, seen.color),
                "score": round(seen.score, 2),
                "box": [round(edge) for edge in seen.box],
                "color": seen.color,
                "id": thing_id or None,
            }
            for seen, thing_id in zip(look.detections, here, strict=True)
        ],
    }


def _name_object(label: str, color: str | None = None) -> dict[str, str]:
    return name_object(label, color).model_dump()


def _blind(code: str | None) -> dict[str, Any]:
    message = None if code is None else saying_of(code).get("message")
    if (
        code is not None and code in REFUSALS
    ):  # the owner's detector, refused while the planner runs
        message = dict(zip(("en", "zh"), REFUSALS[code], strict=True))
    return {"blind": code, "message": message}
