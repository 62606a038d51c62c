"""Take a person's word on where the robot is. Localization judges it by scans before it counts.

An operator's act: a pose decides where the fence lies. Nothing moves by it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

from fastapi import APIRouter
from pydantic import Field, model_validator

from planner.api.interfaces import Services
from planner.api.places import Point
from planner.api.problems import HttpProblem, unknown_place
from planner.api.schemas import Body, Source, law_broken
from planner.language.catalogue import say
from planner.site import Place
from planner.site.places import normalise
from planner.site.pose_hint import hint_at, hint_in

if TYPE_CHECKING:
    from wire import LocalizerStatus

ENOUGH_SCORE = 0.6
"""What localization asks of a place at least (localization.quality), for what a person is told."""
_STATUS = {
    "moving": 409,
    "busy": 409,
    "map_grows": 409,
    "no_scan": 503,
    "no_answer": 503,
    "does_not_fit": 422,
    "ambiguous": 422,
}


class HereHint(Body):
    """Say where the robot is: at a point of the map, or in a room."""

    point: Point | None = None
    place: Annotated[str, Field(min_length=1, max_length=200)] | None = None
    source: Source = "api"

    @model_validator(mode="after")
    def _one_of_both(self) -> HereHint:
        if (self.point is None) == (self.place is None):
            raise law_broken("point_or_place")
        return self


def routes(services: Services) -> APIRouter:
    """Return the routes of localization."""
    router = APIRouter(prefix="/v1/localization", tags=["localization"])

    @router.get("", operation_id="get_localization")
    async def localization() -> dict[str, Any]:
        """Say what the localizer does: its state, its score, and candidates while it searches."""
        return {"localizer": localizer_view(services), "trouble": trouble_view(services)}

    @router.post("/hint", operation_id="hint_localization")
    async def hint(word: HereHint) -> dict[str, Any]:
        """Say where the robot is. It must stand, and a scan must agree; then its pose is set."""
        return await give_hint(services, word)

    return router


def localizer_view(services: Services) -> dict[str, Any] | None:
    """Return what the localizer says that it does; None where none speaks."""
    said = services.robot.localizer
    return None if said is None else said.model_dump(mode="json")


def trouble_view(services: Services) -> dict[str, Any] | None:
    """Return why the localizer has no pose and what helps, where it knows that."""
    said = services.robot.localizer
    if said is None or said.trouble is None:
        return None
    return {"code": said.trouble, "message": say(f"localization.{said.trouble}").model_dump()}


async def give_hint(services: Services, word: HereHint) -> dict[str, Any]:
    """Bring a hint to localization and return what it made of it."""
    if services.memory.facts.grows:  # the mapper takes no hints: nobody would answer
        raise _problem("map_grows", _STATUS["map_grows"])
    if not services.robot.takes_hints:
        raise _problem("no_localizer", 503)
    point = word.point
    if point is not None:
        hint = hint_at(point.x_m, point.y_m, point.yaw_rad)
    else:
        hint = hint_in(_place(services, word))
    verdict = await services.robot.hint(hint)
    code = "no_answer" if verdict is None else verdict.code
    score = None if verdict is None else verdict.score
    if code != "accepted":
        raise _problem(code, _STATUS.get(code, 503), score, services.robot.localizer)
    return {"code": code, "score": score, "message": say("hint.accepted").model_dump()}


def _place(services: Services, word: HereHint) -> Place:
    wanted = word.place or ""
    for place in services.memory.places:
        if normalise(wanted) in map(normalise, place.spoken_names):
            return place
    raise unknown_place(wanted, services.memory.vocabulary)


def _problem(
    code: str, status: int, score: float | None = None, now: LocalizerStatus | None = None
) -> HttpProblem:
    said = say(f"hint.{code}")
    tracks = code == "does_not_fit" and now is not None and now.state == "tracking"
    if score is not None and score >= ENOUGH_SCORE and now is not None and tracks:
        said = say("hint.fits_less", there=score, here=now.score)
        return HttpProblem(status, f"hint_{code}", said.en, message=said.model_dump())
    low = score is not None and score < ENOUGH_SCORE
    needs = f" (score {score:.2f}, needs {ENOUGH_SCORE:.2f})" if low else ""
    return HttpProblem(status, f"hint_{code}", f"{said.en}{needs}", message=said.model_dump())
