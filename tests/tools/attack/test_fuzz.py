"""A fuzzer counts what a decoder takes, refuses, crashes on and hangs on."""

from __future__ import annotations

from pathlib import Path

import pytest

from tools.attack import fuzz as fuzz_module
from tools.attack.decoders import BY_NAME, DECODERS, AttackedDecoder, Reader
from tools.attack.fuzz import fuzz

pytestmark = pytest.mark.nightly(keep=6)


class Refusal(Exception):
    def __init__(self, code: str) -> None:
        super().__init__(code)
        self.code = code


def decoder_of(read: object) -> AttackedDecoder:
    assert callable(read)
    return AttackedDecoder("made up", lambda: [b"good"], lambda _: Reader(read, (Refusal,)))


def home_of(tmp_path: Path) -> Path:
    (tmp_path / "own").mkdir()
    return tmp_path / "own"


def test_what_is_taken_and_refused_is_no_crash(tmp_path: Path) -> None:
    def read(data: bytes) -> None:
        if data != b"good" and len(data) % 2:
            raise Refusal("odd")

    told = fuzz(decoder_of(read), home_of(tmp_path), seed=1, count=100, seconds=60.0)
    assert (told.n, told.crashes, told.hangs) == (100, 0, 0)
    assert 0 < told.taken < 100


def test_another_exception_is_a_crash_and_its_input_is_kept(tmp_path: Path) -> None:
    def read(data: bytes) -> None:
        if data != b"good":
            raise KeyError(data)

    told = fuzz(decoder_of(read), home_of(tmp_path), seed=1, count=20, seconds=60.0)
    assert told.crashes >= 15
    (kind,) = told.kinds
    assert kind.startswith("KeyError at test_fuzz.py")
    assert len(list((tmp_path / "crashes").iterdir())) == 1


def test_a_refusal_without_a_code_is_a_crash(tmp_path: Path) -> None:
    def read(data: bytes) -> None:
        if data != b"good":
            raise Refusal("")

    assert fuzz(decoder_of(read), home_of(tmp_path), seed=1, count=9, seconds=60.0).crashes > 0


def test_an_input_that_never_ends_is_a_hang(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def read(data: bytes) -> None:
        while data != b"good":  # busily, for a hang is counted in processor time
            pass

    monkeypatch.setattr(fuzz_module, "HANG_S", 0.05)
    told = fuzz(decoder_of(read), home_of(tmp_path), seed=1, count=2, seconds=60.0)
    assert told.hangs > 0


def test_a_seed_that_is_refused_ends_the_run(tmp_path: Path) -> None:
    def read(_: bytes) -> None:
        raise Refusal("never")

    with pytest.raises(ValueError, match="a seed is refused"):
        fuzz(decoder_of(read), home_of(tmp_path), seed=1, count=1, seconds=60.0)


@pytest.mark.parametrize("name", sorted(BY_NAME))
def test_each_decoder_takes_its_seeds_and_bears_a_few_mutants(name: str, tmp_path: Path) -> None:
    told = fuzz(BY_NAME[name], home_of(tmp_path), seed=5, count=10, seconds=20.0)
    assert (told.crashes, told.hangs, told.kinds) == (0, 0, {})


def test_each_decoder_has_a_name_of_its_own() -> None:
    assert len(BY_NAME) == len(DECODERS)
