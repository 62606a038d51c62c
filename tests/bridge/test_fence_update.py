"""Beside the loop a fence is checked and written, the old one kept; what is wrong is refused."""

from __future__ import annotations

import json
from dataclasses import replace
from math import cos, sin, tau
from pathlib import Path
from typing import Any

import pytest

from bridge.core.state_orders import PendingFence
from bridge.fence_file import load_fence
from bridge.fence_update import LINGER_S, FenceDesk, Ground, put_in_force
from tests.waiting import until
from wire import Pose2, fingerprint

MAP = "0" * 16
SQUARE = [[0, 0], [4, 0], [4, 4], [0, 4]]


def text(allowed: Any = None, **more: Any) -> str:
    return json.dumps({"version": 1, "map_id": MAP, "allowed": allowed or [SQUARE], **more})


def asked(content: str, x_m: float = 1.0, y_m: float = 1.0) -> PendingFence:
    return PendingFence("f1", "cli", content, Pose2(x_m, y_m, 0.0))


@pytest.fixture
def ground(tmp_path: Path) -> Ground:
    site = tmp_path / "site"
    site.mkdir()
    old = text([[[0, 0], [3, 0], [3, 3], [0, 3]]])
    (site / "fence.json").write_text(old)
    return Ground(site, tmp_path / "home", MAP, fingerprint(old.encode()))


def test_a_good_fence_is_written_and_the_old_one_kept(ground: Ground) -> None:
    old = (ground.site / "fence.json").read_bytes()
    content = text()
    done = put_in_force(ground, asked(content))
    assert done.code == "ok"
    assert (ground.site / "fence.json").read_text() == content
    assert load_fence(ground.site / "fence.json")[1] == fingerprint(content.encode())
    assert (ground.site / f"fence-{ground.fence_hash}.json").read_bytes() == old
    line = json.loads((ground.home / "fence" / "accepted.jsonl").read_text())
    assert (line["by"], line["old"]) == ("cli", ground.fence_hash)
    assert line["new"] == fingerprint(content.encode())
    assert line["at"].endswith("+00:00")


_RING = [[3 + 2 * cos(k * tau / 501), 2 * sin(k * tau / 501)] for k in range(501)]


@pytest.mark.parametrize(
    ("content", "code"),
    [
        ("no json", "fence_invalid"),
        ("{}", "fence_invalid"),
        (text().replace('"version": 1', '"version": 2'), "fence_invalid"),
        (text().replace("4]", "NaN]"), "fence_invalid"),
        (text().replace("4]", "1e999]"), "fence_invalid"),
        (text(extra=1), "fence_invalid"),
        (text([[[0, 0], [1, 1]]]), "fence_invalid"),
        (text([[[0, 0], [1, 1], [2, 2]]]), "fence_degenerate"),
        (text([[[0, 0], [4, 4], [4, 0], [0, 4], [-1, 2]]]), "fence_crosses_itself"),
        (text(keep_outs=[[[2, 2], [3, 3], [3, 2], [2, 3], [1.5, 2.5]]]), "fence_crosses_itself"),
        (text([_RING, _RING]), "fence_too_large"),
        (text().replace(MAP, "1" * 16), "fence_of_another_map"),
        (text([[[2, 2], [4, 2], [4, 4]]]), "fence_excludes_robot"),
        (text(keep_outs=[[[0.5, 0.5], [2, 0.5], [2, 2], [0.5, 2]]]), "fence_excludes_robot"),
    ],
    ids=lambda value: value if len(value) < 25 else "",
)
def test_what_must_not_come_into_force_is_refused_and_nothing_is_written(
    ground: Ground, content: str, code: str
) -> None:
    before = {path: path.read_bytes() for path in ground.site.iterdir()}
    done = put_in_force(ground, asked(content))
    assert done.code == code
    assert done.detail
    assert {path: path.read_bytes() for path in ground.site.iterdir()} == before
    assert not ground.home.exists()


def test_the_fence_in_force_is_not_put_in_force_again(ground: Ground) -> None:
    same = (ground.site / "fence.json").read_text()
    assert put_in_force(ground, asked(same)).code == "fence_unchanged"


def test_a_place_that_is_no_number_is_outside(ground: Ground) -> None:
    nowhere = asked(text(), float("nan"))
    assert put_in_force(ground, nowhere).code == "fence_excludes_robot"


def test_a_folder_that_can_not_be_written_is_said(ground: Ground) -> None:
    (ground.site / "fence.json").unlink()
    ground.site.rmdir()
    ground.site.write_text("no folder")
    assert put_in_force(ground, asked(text())).code == "fence_unwritable"


def test_an_audit_that_can_not_be_written_is_said_and_the_fence_counts(
    ground: Ground, caplog: pytest.LogCaptureFixture
) -> None:
    ground.home.write_text("no folder")
    assert put_in_force(ground, asked(text())).code == "ok"
    assert "fence_audit_unwritable" in caplog.text


def test_a_disk_that_refuses_half_way_leaves_the_old_fence(
    ground: Ground, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(_: int) -> None:
        raise OSError(28, "No space left on device")

    before = (ground.site / "fence.json").read_bytes()
    monkeypatch.setattr("bridge.files.os.fsync", full)
    done = put_in_force(ground, asked(text()))
    assert (done.code, "No space left" in done.detail) == ("fence_unwritable", True)
    assert (ground.site / "fence.json").read_bytes() == before
    assert [path.name for path in ground.site.iterdir()] == ["fence.json"]


def test_the_desk_serves_one_request_once_and_then_the_bridge_may_leave(ground: Ground) -> None:
    desk = FenceDesk(ground)
    request = asked(text())
    desk.note(None, 0.0)
    assert desk.take() is None
    desk.note(request, 1.0)
    desk.note(request, 1.01)
    done = until(desk.take)
    assert (done.id, done.code) == ("f1", "ok")
    assert desk.take() is None
    assert not desk.is_over(50.0), "the core has not given its verdict yet"
    desk.note(replace(request, text="", written=True), 60.0)
    assert not desk.is_over(60.0 + LINGER_S / 2)
    assert desk.is_over(60.0 + LINGER_S)
    assert desk.close()


def test_after_a_refusal_the_next_request_is_served(ground: Ground) -> None:
    desk = FenceDesk(ground)
    desk.note(asked("{}"), 1.0)
    assert until(desk.take).code == "fence_invalid"
    desk.note(None, 2.0)
    assert not desk.is_over(100.0)
    desk.note(asked(text()), 3.0)
    assert until(desk.take).code == "ok"
    assert desk.close()
