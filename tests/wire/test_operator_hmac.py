"""A proof fits one request of one kind for one robot under one nonce."""

from __future__ import annotations

from typing import get_args

import pytest

from tests.wire.examples import STATUS
from wire import NEEDS_PROOF, VIRTUAL_KEY, OpKind, Proof, authentic, sign, signed_request

KEY = b"k" * 32


def test_the_signed_request_is_authentic() -> None:
    proof = sign(KEY, "arm", "r1", "boot.1", "op-1")
    assert authentic(KEY, "arm", "r1", proof, "op-1")


@pytest.mark.parametrize(
    ("key", "kind", "robot", "request_id"),
    [
        (VIRTUAL_KEY, "arm", "r1", "op-1"),
        (KEY, "reset", "r1", "op-1"),
        (KEY, "arm", "r2", "op-1"),
        (KEY, "arm", "r1", "op-2"),
    ],
)
def test_any_other_request_is_not(key: bytes, kind: OpKind, robot: str, request_id: str) -> None:
    proof = sign(KEY, "arm", "r1", "boot.1", "op-1")
    assert not authentic(key, kind, robot, proof, request_id)


def test_another_nonce_is_not_covered() -> None:
    proof = sign(KEY, "arm", "r1", "boot.1", "op-1")
    assert not authentic(KEY, "arm", "r1", Proof(nonce="boot.2", mac=proof.mac), "op-1")


def test_no_proof_proves_nothing() -> None:
    assert not authentic(KEY, "arm", "r1", None, "op-1")


def test_fields_cannot_be_shifted_into_each_other() -> None:
    assert sign(KEY, "arm", "r1", "ab", "c").mac != sign(KEY, "arm", "r1", "a", "bc").mac


def test_every_kind_has_its_own_mac() -> None:
    kinds = get_args(OpKind)
    assert len({sign(KEY, kind, "r1", "n", "i").mac for kind in kinds}) == len(kinds)


@pytest.mark.parametrize("kind", get_args(OpKind))
def test_a_request_is_signed_where_it_could_let_the_robot_move(kind: OpKind) -> None:
    request = signed_request(KEY, kind, STATUS, "cli", "op-1")
    assert (request.id, request.source) == ("op-1", "cli")
    assert authentic(KEY, kind, STATUS.robot, request.proof, "op-1") == (kind in NEEDS_PROOF)
    assert request.proof is None or request.proof.nonce == STATUS.nonce
