"""Serve the fence: the one in force, the proposals, and an operator's yes or no.

A proposal changes nothing. The yes goes to the bridge with a proof that binds the very text that
was reviewed; the bridge alone writes it, and only while DISARMED.
"""

from __future__ import annotations

import asyncio
import json
import secrets
from typing import TYPE_CHECKING, Any

from fastapi import APIRouter

from planner.api.interfaces import Services
from planner.api.problems import HttpProblem
from planner.api.schemas import Body, OperatorOrder, OperatorProof, Source
from planner.site.fence_check import FenceRefusal, check_fence
from planner.site.fence_diff import fence_diff
from planner.site.fence_store import State
from wire import VIRTUAL_KEY, Answer, FenceFile, FenceRequest, sign_fence
from wire.bounded_types import Name

if TYPE_CHECKING:
    from planner.site import FenceProposal

_STATUS = {"unknown_fence_proposal": 404, "fence_proposals_full": 409}


class Proposal(Body):
    """Propose another fence for this site's map."""

    fence: FenceFile
    source: Source = "api"


class Rejection(Body):
    """Say no to a proposal."""

    source: Source = "api"


def routes(services: Services) -> APIRouter:
    """Return the fence's routes."""
    router = APIRouter(prefix="/v1/fence", tags=["fence"])
    _reading(router, services)
    _deciding(router, services)
    return router


def _reading(router: APIRouter, services: Services) -> None:
    @router.get("", operation_id="get_fence")
    async def fence() -> dict[str, Any]:
        """Give the fence that the planner routes by, and the hash of the one the bridge holds."""
        status, mine = services.robot.status, services.site.fence
        held = status.fence_hash if status else None
        return {
            "fence": mine.record.model_dump(mode="json"),
            "fence_hash": mine.fence_hash,
            "bridge_fence_hash": held,
            "agreed": held == mine.fence_hash,
        }

    @router.get("/proposals", operation_id="list_fence_proposals")
    async def proposals() -> dict[str, Any]:
        """List proposals, newest first, each with the changes it would make."""
        return {"proposals": await asyncio.to_thread(_list_proposals, services)}

    @router.get("/proposals/{proposal_id}", operation_id="get_fence_proposal")
    async def proposal(proposal_id: Name) -> dict[str, Any]:
        """Give one proposal whole: its text is the one that an operator signs."""
        item = await _found(services, proposal_id)
        return await asyncio.to_thread(_view, services, item)


def _deciding(router: APIRouter, services: Services) -> None:
    @router.post("/proposals", operation_id="propose_fence", status_code=201)
    async def propose(order: Proposal) -> dict[str, Any]:
        """Check a fence and keep it for an operator to read. Nothing comes into force."""
        status = services.robot.status
        pose = status.base_in_map if status else None
        try:
            await asyncio.to_thread(check_fence, order.fence, services.site, pose)
            item = await asyncio.to_thread(services.fences.propose, order.fence, order.source)
        except FenceRefusal as refused:
            raise _problem(refused) from None
        return await asyncio.to_thread(_view, services, item)

    @router.post("/proposals/{proposal_id}/accept", operation_id="accept_fence")
    async def accept(proposal_id: Name, order: OperatorOrder | None = None) -> Answer:
        """Put a proposal in force: the bridge writes it and starts anew. Only while DISARMED."""
        asked = order or OperatorOrder()
        item = await _found(services, proposal_id)
        answer = await services.robot.offer_fence(_request(services, item, asked))
        if answer is None:
            raise HttpProblem(503, "bridge_silent", "the bridge did not answer within 2 s")
        state: State = "accepted" if answer.accepted else "proposed"
        reason = None if answer.accepted else answer.code
        await asyncio.to_thread(services.fences.decide, item.id, state, asked.source, reason)
        if not answer.accepted:
            raise HttpProblem(409, answer.code, answer.detail or "the bridge refused the fence")
        return answer

    @router.post("/proposals/{proposal_id}/reject", operation_id="reject_fence")
    async def reject(proposal_id: Name, order: Rejection | None = None) -> dict[str, Any]:
        """Say no to a proposal."""
        asked = order or Rejection()
        item = await _found(services, proposal_id)
        if item.state != "proposed":
            raise HttpProblem(409, "fence_decided", f"{item.id} was {item.state} already")
        item = await asyncio.to_thread(services.fences.decide, item.id, "rejected", asked.source)
        return await asyncio.to_thread(_view, services, item)


def _request(services: Services, item: FenceProposal, order: OperatorOrder) -> FenceRequest:
    """Return the request with the person's proof, or signed where the drive is virtual.

    Raises:
        HttpProblem: ``bridge_silent`` or ``operator_proof_needed``.
    """
    given: OperatorProof | None = order.operator
    if given is not None:
        return FenceRequest(id=given.id, source=order.source, fence=item.text, proof=given.proof)
    status = services.robot.status
    if status is None:
        raise HttpProblem(
            503, "bridge_silent", "no bridge is heard, so no fence can be put in force"
        )
    if not status.drive.virtual:
        raise HttpProblem(
            403,
            "operator_proof_needed",
            "a fence on this robot needs a proof made with the operator's key; use "
            f"`pons fence accept {item.id}` on a machine that holds the key",
        )
    request_id = f"api-{secrets.token_hex(8)}"
    proof = sign_fence(VIRTUAL_KEY, status.robot, status.nonce, request_id, item.text)
    return FenceRequest(id=request_id, source=order.source, fence=item.text, proof=proof)


async def _found(services: Services, proposal_id: str) -> FenceProposal:
    try:
        return await asyncio.to_thread(services.fences.get, proposal_id)
    except FenceRefusal as refused:
        raise _problem(refused) from None


def _list_proposals(services: Services) -> list[dict[str, Any]]:
    return [_view(services, item) for item in services.fences.list_all()]


def _view(services: Services, item: FenceProposal) -> dict[str, Any]:
    site = services.site
    record = FenceFile.model_validate(json.loads(item.text))
    diff = fence_diff(site.fence.record, record, site.rooms)
    return {**item.model_dump(mode="json"), "diff": diff.model_dump(mode="json")}


def _problem(refused: FenceRefusal) -> HttpProblem:
    return HttpProblem(_STATUS.get(refused.code, 422), refused.code, refused.detail)
