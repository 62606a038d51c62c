"""``pons fence`` reads a proposal for itself, signs its text, and speaks to the bridge directly."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from pons import fence
from pons.bridge_client import NoBridge
from pons.http import PlannerDown, PlannerProblem
from pons.settings import CHECKOUT, LaunchSettings
from wire import Answer, FenceFile, fingerprint
from wire.fence import fence_text

SITE = CHECKOUT / "sites" / "two_room"
CHANGED = {
    **json.loads((SITE / "fence.json").read_text()),
    "keep_outs": [[[0.4, 3.4], [0.9, 3.4], [0.9, 3.9], [0.4, 3.9]]],
}
TEXT = fence_text(FenceFile.model_validate(CHANGED, strict=False))
NAME = fingerprint(TEXT.encode())
LYING = {"added_m2": 0.0, "removed_m2": 0.0, "allowed_m2": 0.0, "rooms": [], "zones_before": 0,
         "zones_after": 0}  # fmt: skip

Call = tuple[str, str, Any]


class Planner:
    """Answer the command's calls and remember them."""

    def __init__(self) -> None:
        self.calls: list[Call] = []
        self.item = {"id": NAME, "text": TEXT, "state": "proposed", "by": "api", "reason": None,
                     "diff": LYING}  # fmt: skip
        self.trouble: Exception | None = None

    def call(self, _: LaunchSettings, method: str, path: str, body: Any = None) -> Any:
        self.calls.append((method, path, body))
        if self.trouble is not None:
            raise self.trouble
        if path == "/v1/fence":
            return {"fence_hash": "a" * 16, "bridge_fence_hash": "b" * 16, "agreed": False}
        if path == "/v1/fence/proposals" and method == "GET":
            return {"proposals": [self.item]}
        return self.item


@pytest.fixture
def planner(monkeypatch: pytest.MonkeyPatch) -> Planner:
    made = Planner()
    monkeypatch.setattr(fence, "call", made.call)
    return made


@pytest.fixture
def offered(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    sent: list[str] = []

    def offer(_: LaunchSettings, text: str) -> Answer:
        sent.append(text)
        return Answer(id="x", kind="fence", accepted=True, code="ok", detail="a -> b")

    monkeypatch.setattr(fence, "fence_direct", offer)
    return sent


@pytest.fixture
def settings(tmp_path: Path) -> LaunchSettings:
    return LaunchSettings(tmp_path, CHECKOUT / "robot.toml", SITE, "127.0.0.1", 1)


def test_accepting_signs_the_text_read_and_shows_what_it_changes(
    planner: Planner,
    offered: list[str],
    settings: LaunchSettings,
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert fence.run(settings, "accept", NAME) == 0
    assert offered == [TEXT]
    shown = capsys.readouterr()
    assert "forbidden 0.25 m2" in shown.err, "worked out here, whatever the planner says"
    assert "living_room" in shown.err
    assert "a -> b" in shown.out
    assert planner.calls == [("GET", f"/v1/fence/proposals/{NAME}", None)]


def test_a_planner_that_changed_the_text_after_review_is_found_out(
    planner: Planner,
    offered: list[str],
    settings: LaunchSettings,
    capsys: pytest.CaptureFixture[str],
) -> None:
    planner.item["text"] = TEXT.replace("0.4", "0.3")
    assert fence.run(settings, "accept", NAME) == 3
    assert offered == []
    assert "fence_proposal_changed" in capsys.readouterr().err


def test_a_text_that_is_no_fence_is_not_signed(
    planner: Planner, offered: list[str], settings: LaunchSettings
) -> None:
    planner.item["text"] = "{}"
    assert fence.run(settings, "accept", fingerprint(b"{}")) == 3
    assert offered == []


def test_the_bridge_s_refusal_is_shown(
    planner: Planner,
    settings: LaunchSettings,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert planner.calls == []
    no = Answer(id="x", kind="fence", accepted=False, code="not_disarmed", detail="mode is HOLD")
    monkeypatch.setattr(fence, "fence_direct", lambda *_: no)
    assert fence.run(settings, "accept", NAME) == 3
    assert "not_disarmed: mode is HOLD" in capsys.readouterr().err


def test_a_file_is_proposed(planner: Planner, settings: LaunchSettings, tmp_path: Path) -> None:
    file = tmp_path / "new.json"
    file.write_text(json.dumps(CHANGED))
    assert fence.run(settings, "propose", str(file)) == 0
    assert planner.calls == [("POST", "/v1/fence/proposals", {"fence": CHANGED, "source": "cli"})]


@pytest.mark.parametrize(
    ("write", "code"),
    [
        (lambda path: None, "fence_file_unreadable"),
        (lambda path: path.write_text("{"), "fence_file_no_json"),
        (lambda path: path.write_bytes(b"\xff\xfe"), "fence_file_no_json"),
    ],
    ids=["missing", "no json", "no text"],
)
def test_a_file_that_is_no_fence_is_named(
    planner: Planner,
    settings: LaunchSettings,
    tmp_path: Path,
    write: Callable[[Path], object],
    code: str,
    capsys: pytest.CaptureFixture[str],
) -> None:
    file = tmp_path / "new.json"
    write(file)
    assert fence.run(settings, "propose", str(file)) == 2
    assert code in capsys.readouterr().err
    assert planner.calls == []


def test_showing_lists_what_waits_and_one_proposal_s_text(
    planner: Planner, settings: LaunchSettings, capsys: pytest.CaptureFixture[str]
) -> None:
    assert fence.run(settings, "show", None) == 0
    shown = capsys.readouterr().out
    assert f"fence {'a' * 16} (bridge: {'b' * 16})" in shown
    assert NAME in shown
    assert fence.run(settings, "show", NAME) == 0
    assert capsys.readouterr().out == TEXT
    assert planner.calls[-1][1].endswith(NAME)


def test_rejecting_is_the_planner_s_business(planner: Planner, settings: LaunchSettings) -> None:
    assert fence.run(settings, "reject", NAME) == 0
    assert planner.calls == [("POST", f"/v1/fence/proposals/{NAME}/reject", {"source": "cli"})]


@pytest.mark.parametrize("act", ["propose", "accept", "reject"])
def test_an_order_without_its_object_is_said(
    planner: Planner, settings: LaunchSettings, act: str
) -> None:
    assert fence.run(settings, act, None) == 2
    assert planner.calls == []


@pytest.mark.parametrize(
    ("trouble", "status"),
    [(PlannerDown("no planner."), 6), (PlannerProblem(404, "unknown_fence_proposal", "none"), 3),
     (NoBridge("no_bridge: none."), 6)],
)  # fmt: skip
def test_who_does_not_answer_is_said(
    planner: Planner, settings: LaunchSettings, trouble: Exception, status: int
) -> None:
    planner.trouble = trouble
    assert fence.run(settings, "accept", NAME) == status
