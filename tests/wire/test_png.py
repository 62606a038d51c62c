"""A PNG whose chunks speak of more bytes than came is told before any library allots them."""

from __future__ import annotations

from zlib import crc32

import pytest

from wire.png import SIGNATURE, chunks_fit


def chunk(kind: bytes, body: bytes = b"", claimed: int | None = None) -> bytes:
    size = len(body) if claimed is None else claimed
    return size.to_bytes(4, "big") + kind + body + crc32(kind + body).to_bytes(4, "big")


HEAD = SIGNATURE + chunk(b"IHDR", bytes(13))
END = chunk(b"IEND")


def test_whole_chunks_up_to_the_end_fit() -> None:
    assert chunks_fit(HEAD + chunk(b"IDAT", b"x" * 9) + END)


def test_what_follows_the_end_is_nobodys_business() -> None:
    assert chunks_fit(HEAD + END + b"more")


@pytest.mark.parametrize("claimed", [1, 9, 0x3FFFFFFF, 0x7FFFFFFF, 0xFFFFFFFF])
def test_a_chunk_that_claims_more_than_came_does_not_fit(claimed: int) -> None:
    assert not chunks_fit(HEAD + chunk(b"tEXt", claimed=claimed))


@pytest.mark.parametrize("kind", [b"ID\x00\x00", b"IDA1", b"    "])
def test_a_kind_that_is_no_four_letters_does_not_fit(kind: bytes) -> None:
    assert not chunks_fit(HEAD + chunk(kind, b"x") + END)


def test_one_changed_bit_does_not_fit() -> None:
    whole = HEAD + chunk(b"IDAT", b"x" * 9) + END
    for bit in range(8 * len(SIGNATURE), 8 * len(whole)):
        spoilt = bytearray(whole)
        spoilt[bit // 8] ^= 1 << bit % 8
        assert not chunks_fit(bytes(spoilt))


def test_without_its_end_or_its_signature_it_does_not_fit() -> None:
    assert not chunks_fit(HEAD + chunk(b"IDAT", b"x"))
    assert not chunks_fit(HEAD)
    assert not chunks_fit(HEAD + b"\x00\x00")
    assert not chunks_fit(b"")
    assert not chunks_fit(b"GIF89a")
