"""Prove and check that an operator meant a request, by HMAC-SHA-256 over its content.

The bytes signed are kind, robot, nonce and id, and for a fence or marks the SHA-256 of the text,
each preceded by its length, so that no two different requests share them. The key stays with the
operator (CLI, page) and the bridge; a planner relays proofs that it can't make.
"""

from __future__ import annotations

import hashlib
import hmac
from typing import Literal

from wire.commands import FenceRequest, MarksRequest, OpKind, OpRequest, Proof
from wire.fence import text_sha256
from wire.status import Status

VIRTUAL_KEY = b"pons-virtual-drive-operator-key"
"""The key of every drive that declares itself virtual. Published on purpose: it guards no metal."""

MIN_KEY_BYTES = 16

NEEDS_PROOF: frozenset[OpKind] = frozenset({"arm", "reset", "resume"})
"""What lets a robot move again. What makes it stand still is believed from anybody."""


SignedKind = OpKind | Literal["trial"]
"""What a proof may be for; that of a trial lets wheels turn that are off the ground."""


def sign(key: bytes, kind: SignedKind, robot: str, nonce: str, request_id: str) -> Proof:
    """Make the proof for one request under one nonce."""
    return Proof(nonce=nonce, mac=_mac(key, kind, robot, nonce, request_id))


def signed_request(
    key: bytes, kind: OpKind, status: Status, source: str, request_id: str
) -> OpRequest:
    """Make an operator's request under the nonce of a status, with a proof where it needs one."""
    proof = sign(key, kind, status.robot, status.nonce, request_id) if kind in NEEDS_PROOF else None
    return OpRequest(id=request_id, source=source, proof=proof)


def authentic(
    key: bytes, kind: SignedKind, robot: str, proof: Proof | None, request_id: str
) -> bool:
    """Return whether the proof fits the request; its nonce's validity is not judged."""
    if proof is None:
        return False
    return hmac.compare_digest(_mac(key, kind, robot, proof.nonce, request_id), proof.mac)


def sign_fence(key: bytes, robot: str, nonce: str, request_id: str, text: str) -> Proof:
    """Make the proof for one text of a fence, and no other, under one nonce."""
    return Proof(nonce=nonce, mac=_mac(key, "fence", robot, nonce, request_id, text_sha256(text)))


def authentic_fence(key: bytes, robot: str, request: FenceRequest) -> bool:
    """Return whether the proof fits the request and the very text that came with it."""
    return _fits_text(key, "fence", robot, request, request.fence)


def sign_marks(key: bytes, robot: str, nonce: str, request_id: str, text: str) -> Proof:
    """Make the proof for one text of marks, and no other, under one nonce."""
    return Proof(nonce=nonce, mac=_mac(key, "marks", robot, nonce, request_id, text_sha256(text)))


def authentic_marks(key: bytes, robot: str, request: MarksRequest) -> bool:
    """Return whether the proof fits the request and the very text that came with it."""
    return _fits_text(key, "marks", robot, request, request.marks)


def _fits_text(
    key: bytes, kind: str, robot: str, request: FenceRequest | MarksRequest, text: str
) -> bool:
    proof = request.proof
    if proof is None:
        return False
    expected = _mac(key, kind, robot, proof.nonce, request.id, text_sha256(text))
    return hmac.compare_digest(expected, proof.mac)


def _mac(key: bytes, *parts: str) -> str:
    fields = [part.encode() for part in parts]
    body = b"".join(len(field).to_bytes(4, "big") + field for field in fields)
    return hmac.new(key, body, hashlib.sha256).hexdigest()
