"""Take the corners of the wire that no story passes: closed sessions, stale pages, deep nesting."""

from __future__ import annotations

from pathlib import Path

import pytest
import zenoh

from tests.wire.examples import EXAMPLES
from wire import Misconfigured, Rejected, Stop, decode, docs, map_id
from wire.keys import STOP, Party
from wire.robot import DriveConfig
from wire.session import open_session


def test_a_closed_session_brings_nothing_and_raises_nothing(tmp_path: Path) -> None:
    with open_session(Party.BRIDGE, "r1", tmp_path) as bridge:
        ears = bridge.subscriber(STOP)
    assert ears.drain_bytes() == []
    assert ears.newest() is None


def test_the_newest_that_is_a_message_counts(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    good = EXAMPLES[Stop].model_dump_json().encode()
    with open_session(Party.BRIDGE, "r1", tmp_path) as bridge:
        ears = bridge.subscriber(STOP)
        monkeypatch.setattr(ears, "drain_bytes", lambda: [good, b"no message"])
        assert ears.newest() == EXAMPLES[Stop]
        monkeypatch.setattr(ears, "drain_bytes", lambda: [b"no message"])
        assert ears.newest() is None


def test_what_zenoh_refuses_is_named_and_the_claim_let_go(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(_config: object) -> object:
        raise zenoh.ZError("address in use")

    with monkeypatch.context() as patch:
        patch.setattr(zenoh, "open", refuse)
        with pytest.raises(Misconfigured) as refused:
            open_session(Party.BRIDGE, "r1", tmp_path)
    assert refused.value.code == "socket_in_use"
    open_session(Party.BRIDGE, "r1", tmp_path).close()


def test_a_path_too_long_lets_the_claim_go(tmp_path: Path) -> None:
    far = tmp_path / ("x" * 120)
    far.mkdir()
    for _ in range(2):
        with pytest.raises(Misconfigured) as refused:
            open_session(Party.BRIDGE, "r1", far)
        assert refused.value.code != "already_running"


def test_nesting_too_deep_for_the_parser_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    class Deep:
        def validate_json(self, _payload: bytes, *, strict: bool) -> object:
            raise RecursionError(strict)

    monkeypatch.setattr(Stop, "__pydantic_validator__", Deep())
    answer = decode(STOP, b"{}")
    assert isinstance(answer, Rejected)
    assert "nested" in answer.detail


def test_the_page_is_written_and_a_stale_one_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    page = tmp_path / "docs" / "wire.md"
    monkeypatch.setattr(docs, "TARGET", page)
    assert docs.main(["--check"]) == 1
    assert "stale" in capsys.readouterr().err
    assert docs.main([]) == 0
    assert page.read_text("utf-8") == docs.render()
    assert docs.main(["--check"]) == 0


def test_a_map_is_named_by_both_its_files() -> None:
    assert map_id(b"a", b"b") != map_id(b"a", b"c") != map_id(b"b", b"c")
    assert map_id(b"a", b"b") != map_id(b"ab", b"")
    assert len(map_id(b"a", b"b")) == 16


def test_a_peak_current_below_the_continuous_one_is_refused() -> None:
    with pytest.raises(ValueError, match="must be less than"):
        DriveConfig(peak_current_a=10.0, continuous_current_a=10.0)
