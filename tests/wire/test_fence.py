"""What outlines may be, and that a proof binds one text of a fence and no other."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from wire import FenceRequest, Proof, authentic, authentic_fence, sign, sign_fence
from wire.fence import (
    MAX_MARK_CORNERS,
    MAX_TEXT,
    FenceFile,
    MarksFile,
    area_m2,
    crosses_itself,
    fence_text,
    flaw,
    marks_flaw,
    text_sha256,
)
from wire.fingerprint import fingerprint

KEY = b"k" * 32
TEXT = '{"version":1}\n'
Corners = tuple[tuple[float, float], ...]


def request(text: str = TEXT, proof: Proof | None = None) -> FenceRequest:
    return FenceRequest(id="f1", source="cli", fence=text, proof=proof)


def test_a_proof_binds_the_text() -> None:
    proof = sign_fence(KEY, "r1", "b.1", "f1", TEXT)
    assert authentic_fence(KEY, "r1", request(proof=proof))
    assert not authentic_fence(KEY, "r1", request(TEXT + " ", proof)), "swapped by a planner"
    assert not authentic_fence(KEY, "r2", request(proof=proof))
    assert not authentic_fence(b"x" * 32, "r1", request(proof=proof))
    assert not authentic_fence(KEY, "r1", request())
    other = FenceRequest(id="f2", source="cli", fence=TEXT, proof=proof)
    assert not authentic_fence(KEY, "r1", other)


def test_a_proof_of_another_kind_is_none_for_a_fence_nor_the_other_way() -> None:
    armed = sign(KEY, "arm", "r1", "b.1", "f1")
    assert not authentic_fence(KEY, "r1", request(proof=armed))
    fenced = sign_fence(KEY, "r1", "b.1", "f1", TEXT)
    assert not authentic(KEY, "arm", "r1", fenced, "f1")


def test_the_hash_in_status_is_the_beginning_of_what_is_signed() -> None:
    assert text_sha256(TEXT).startswith(fingerprint(TEXT.encode()))


def test_a_text_too_long_is_no_request() -> None:
    with pytest.raises(ValidationError):
        request("x" * (MAX_TEXT + 1))


@pytest.mark.parametrize(
    ("outline", "simple"),
    [
        (((0, 0), (1, 0), (1, 1), (0, 1)), True),
        (((0, 0), (1, 0), (1, 0), (1, 1), (0, 1), (0, 0)), True),
        (((0, 0), (2, 0), (1, 0.5), (2, 1), (0, 1)), True),
        (((0, 0), (1, 1), (1, 0), (0, 1)), False),
        (((0, 0), (2, 0), (2, 2), (1, 0), (0, 2)), False),
        (((0, 0), (4, 0), (2, 0), (2, 2)), False),
        (((0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)), False),
    ],
    ids=["square", "corner twice", "notch", "bow tie", "touches a side", "folds back", "pinched"],
)
def test_an_outline_meets_itself_nowhere(outline: Corners, *, simple: bool) -> None:
    assert (crosses_itself(outline) is None) is simple


@settings(max_examples=60, deadline=None)
@given(st.lists(st.tuples(st.integers(0, 6), st.integers(0, 6)), min_size=3, max_size=7))
def test_turning_an_outline_round_or_starting_elsewhere_changes_no_verdict(
    corners: list[tuple[int, int]],
) -> None:
    outline = tuple((float(x), float(y)) for x, y in corners)
    verdict = crosses_itself(outline) is None
    assert (crosses_itself(outline[::-1]) is None) is verdict
    assert (crosses_itself(outline[2:] + outline[:2]) is None) is verdict


def fence(**changes: object) -> FenceFile:
    base = {"version": 1, "map_id": "0" * 16, "allowed": [[[0, 0], [1, 0], [0, 1]]]}
    return FenceFile.model_validate({**base, **changes}, strict=False)


def test_every_kind_of_outline_is_looked_at() -> None:
    bow = [[0, 0], [2, 2], [2, 0], [0, 2], [-1, 1]]
    line = [[0, 0], [1, 1], [2, 2]]
    assert flaw(fence()) is None
    for changes in (
        {"allowed": [bow]},
        {"keep_outs": [bow]},
        {"speed_zones": [{"polygon": bow, "max_speed_mps": 0.2}]},
    ):
        found = flaw(fence(**changes))
        assert found is not None
        assert found[0] == "fence_crosses_itself"
    found = flaw(fence(keep_outs=[line]))
    assert found is not None
    assert found[0] == "fence_degenerate"


def test_the_text_says_what_the_record_says() -> None:
    record = fence(speed_zones=[{"polygon": [[0, 0], [1, 0], [0, 1]], "max_speed_mps": 0.3}])
    assert FenceFile.model_validate_json(fence_text(record), strict=False) == record
    assert area_m2(record.allowed[0]) == pytest.approx(0.5)


def test_every_mark_is_looked_at_and_each_flaw_has_its_code() -> None:
    square, bow = [[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 0], [2, 2], [2, 0], [0, 2], [-1, 1]]
    ring = [[float(n), float(n * n)] for n in range(60)]
    for outlines, code in (
        ([square], None),
        ([square, bow], "mark_crosses_itself"),
        ([[[0, 0], [0.1, 0], [0, 0.1]]], "mark_too_small"),
        ([ring] * (MAX_MARK_CORNERS // len(ring) + 1), "marks_too_many"),
    ):
        drawn = [{"polygon": outline, "max_speed_mps": 0.2} for outline in outlines]
        for marks in ({"keep_outs": outlines}, {"speed_zones": drawn}):
            record = MarksFile.model_validate(
                {"version": 1, "map_id": "0" * 16, **marks}, strict=False
            )
            found = marks_flaw(record)
            assert (found and found[0]) == code
