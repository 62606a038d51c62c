"""Hold frames and failures to their shapes, and the child's end to its pipes, in one process."""

from __future__ import annotations

import socket
from collections.abc import Iterator
from math import inf, nan

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from processes.worker_main import ParentPipes
from processes.worker_protocol import (
    HEADER,
    MAX_BODY_BYTES,
    MAX_HEAD_BYTES,
    pack,
    read_lengths,
    unpack,
)
from tests.processes.small_worker_main import CODES, Trouble


@settings(max_examples=25)
@given(st.dictionaries(st.text(), st.integers() | st.text()), st.lists(st.binary(), max_size=3))
def test_a_frame_comes_back_as_it_was(head: dict[str, object], bodies: list[bytes]) -> None:
    frame = pack(head, *bodies)
    text, body = read_lengths(frame[: HEADER.size])
    assert unpack(frame[HEADER.size : HEADER.size + text]) == head
    assert frame[HEADER.size + text :] == b"".join(bodies)
    assert len(frame) == HEADER.size + text + body


def test_what_is_no_frame_of_ours_is_refused() -> None:
    assert read_lengths(HEADER.pack(MAX_HEAD_BYTES, MAX_BODY_BYTES)) == (
        MAX_HEAD_BYTES,
        MAX_BODY_BYTES,
    )
    for head, body in ((MAX_HEAD_BYTES + 1, 0), (0, MAX_BODY_BYTES + 1), (2**32 - 1, 2**32 - 1)):
        with pytest.raises(ValueError, match=f"a frame of {head} \\+ {body} bytes; at most"):
            read_lengths(HEADER.pack(head, body))
    with pytest.raises(ValueError, match="list"):
        unpack(b"[]")
    for bad in (nan, inf, -inf):
        with pytest.raises(ValueError, match="JSON"):
            pack({"x": bad})


@pytest.mark.parametrize("code", Trouble.reasons)
def test_a_failure_says_its_sentence_in_both_languages(code: str) -> None:
    en, zh = Trouble.reasons[code]
    plain, full = CODES.to_failure(code), CODES.to_failure(code, "a detail")
    assert plain.message == {"en": en, "zh": zh}
    assert full.message == {"en": f"{en} (a detail)", "zh": f"{zh}（a detail）"}
    assert (str(full), full.code, full.detail) == (f"{code}: {en} (a detail)", code, "a detail")


@pytest.mark.parametrize("code", ["unheard of", None, ["late"], 7])
def test_a_code_that_is_none_of_ours_means_down(code: object) -> None:
    assert CODES.to_failure(code).code == "down"


def test_idle_work_is_done_while_nobody_asks_and_waits_while_somebody_does() -> None:
    ours, its = socket.socketpair()
    done: list[int] = []

    def idle() -> Iterator[None]:
        for piece in range(5):
            done.append(piece)
            if piece == 1:
                ours.sendall(pack({"number": 7}, b"abc") + pack({"number": 8}))
            yield
        ours.sendall(HEADER.pack(9, 9) + b"cut off")
        ours.shutdown(socket.SHUT_WR)

    with ours, its:
        parent = ParentPipes(its.fileno(), its.fileno())
        assert parent.serve(lambda asked: ({"after": len(done)}, asked[1]), idle()) == 0
        expected = pack({"number": 7, "after": 2}, b"abc") + pack({"number": 8, "after": 2})
        assert ours.recv(1000) == expected
    assert done == [0, 1, 2, 3, 4]
