"""Serve what people drew on the map: where to stay out and where to go slowly.

Marks are one text that an operator means as a whole. It counts once the bridge has it, also while
the robot drives, since marks only take away from the fence; the routes follow.
"""

from __future__ import annotations

import asyncio
import secrets
from typing import Any

from fastapi import APIRouter

from planner.api.interfaces import Services
from planner.api.problems import HttpProblem
from planner.api.schemas import Body, OperatorOrder
from planner.language.catalogue import CATALOGUE, say
from planner.site.fence_check import FenceRefusal
from planner.site.marks import (
    MarkExit,
    check_marks,
    check_outlines,
    find_exit,
    marks_hash,
    round_marks,
)
from planner.site.taught_place_errors import PlaceRefusal
from wire import VIRTUAL_KEY, MarksFile, MarksRequest, sign_marks
from wire.bounded_types import Fingerprint
from wire.fence import fence_text

_STATUS = dict.fromkeys(
    ("mark_holds_robot", "mark_too_near", "mark_without_exit", "marks_busy", "marks_changed"), 409
)


class Drawing(Body):
    """Check marks before they are meant: no proof is needed, and nothing comes into force."""

    marks: MarksFile


class Marking(OperatorOrder):
    """Put marks in force in place of all that were drawn on this map before."""

    marks: MarksFile
    before: Fingerprint | None = None
    """The hash of the marks that these were made from; none where nothing was drawn."""


def routes(services: Services) -> APIRouter:
    """Return the routes of marks."""
    router = APIRouter(prefix="/v1/marks", tags=["fence"])

    @router.get("", operation_id="get_marks")
    async def marks() -> dict[str, Any]:
        """Give the marks that routes keep to, and the hash of those that the bridge holds."""
        return _view(services)

    @router.post("/check", operation_id="check_marks")
    async def check(drawing: Drawing) -> dict[str, Any]:
        """Say whether marks could come into force here and now, and give the text to be signed."""
        text = fence_text(await _check(services, drawing.marks))
        return {"text": text}

    @router.post("/exit", operation_id="find_exit")
    async def exit_of(drawing: Drawing) -> MarkExit:
        """Say where the robot would leave marks that hold it, by the shortest way; nothing moves.

        Raises:
            HttpProblem: ``mark_without_exit``, and those of outlines.
        """
        known, drawn = services.memory, round_marks(drawing.marks)
        try:
            await asyncio.to_thread(check_outlines, drawn, services.site.fence)
            return await find_exit(known.drawn.site_with(drawn), known.survey, known.radius_m)
        except FenceRefusal as refused:
            raise _problem(refused.code, refused.detail) from None
        except PlaceRefusal as refused:
            raise _problem("mark_without_exit", refused.detail or refused.code) from None

    @router.put("", operation_id="put_marks")
    async def put(order: Marking) -> dict[str, Any]:
        """Put marks in force: the bridge keeps the robot to them, and routes keep off them."""
        drawn = await _check(services, order.marks)
        now = marks_hash(services.memory.drawn.marks)
        if order.before != now:
            raise _problem("marks_changed", f"they are {now or 'none'} by now; read them again")
        answer = await services.robot.offer_marks(_request(services, fence_text(drawn), order))
        if answer is None:
            raise HttpProblem(503, "bridge_silent", "the bridge did not answer within 2 s")
        if not answer.accepted:
            raise _problem(answer.code, answer.detail or "the bridge refused the marks")
        try:
            await services.memory.keep_marks(drawn)
        except OSError as error:
            raise _problem("marks_unwritable", f"{error.filename}: {error.strerror}") from None
        return _view(services)

    return router


def _view(services: Services) -> dict[str, Any]:
    marks, status = services.memory.drawn.marks, services.robot.status
    mine, held = marks_hash(marks), status.marks_hash if status is not None else None
    map_id = services.site.map_id
    shown = marks or MarksFile(version=1, map_id=map_id)
    return {
        "map_id": map_id,
        "marks": shown.model_dump(mode="json"),
        "marks_hash": mine,
        "bridge_marks_hash": held,
        "agreed": held == mine,
    }


async def _check(services: Services, marks: MarksFile) -> MarksFile:
    """Return marks as they are kept.

    Raises:
        HttpProblem: they can't come into force.
    """
    status, drawn = services.robot.status, round_marks(marks)
    pose = status.base_in_map if status is not None else None
    try:
        await asyncio.to_thread(check_marks, drawn, services.site.fence, pose)
    except FenceRefusal as refused:
        raise _problem(refused.code, refused.detail) from None
    return drawn


def _request(services: Services, text: str, order: Marking) -> MarksRequest:
    """Return the request with the person's proof, or signed where the drive is virtual.

    Raises:
        HttpProblem: ``bridge_silent`` or ``operator_proof_needed``.
    """
    if (given := order.operator) is not None:
        return MarksRequest(id=given.id, source=order.source, marks=text, proof=given.proof)
    status = services.robot.status
    if status is None:
        raise HttpProblem(503, "bridge_silent", "no bridge is heard to put marks in force")
    if not status.drive.virtual:
        detail = "marks on this robot need a proof made with the operator's key"
        raise HttpProblem(403, "operator_proof_needed", detail)
    request_id = f"api-{secrets.token_hex(8)}"
    proof = sign_marks(VIRTUAL_KEY, status.robot, status.nonce, request_id, text)
    return MarksRequest(id=request_id, source=order.source, marks=text, proof=proof)


def _problem(code: str, detail: str) -> HttpProblem:
    """Return a refusal, with a sentence in both languages where the code has one."""
    told = say(f"marks.{code}").model_dump() if CATALOGUE.has(f"marks.{code}") else None
    return HttpProblem(_STATUS.get(code, 422), code, detail, message=told)
