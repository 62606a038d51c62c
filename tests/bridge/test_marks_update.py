"""Marks are read, prepared and written beside the loop; what the core refuses is written back."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from bridge.core.geometry.fence import build_fence
from bridge.core.inbox import FenceDone
from bridge.core.state_orders import Marks, PendingMarks
from bridge.marks_update import MarksDesk, Paper, load_marks, marks_path, prepare
from tests.waiting import until
from wire.errors import ConfigError

MAP = "0123456789abcdef"
FENCE = build_fence(MAP, (((0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)),))
BOX = [[1, 1], [2, 1], [2, 2], [1, 2]]
WHOLE = [[-1, -1], [5, -1], [5, 5], [-1, 5]]


def text(*keep_outs: Any, **more: Any) -> str:
    return json.dumps({"version": 1, "map_id": MAP, "keep_outs": list(keep_outs), **more})


@pytest.fixture
def paper(tmp_path: Path) -> Paper:
    return Paper(marks_path(tmp_path, MAP), MAP, FENCE)


def test_good_marks_are_written_and_read_again(paper: Paper) -> None:
    assert load_marks(paper.path, MAP) == ""
    done = prepare(paper, PendingMarks("m1", "cli", text(BOX)))
    assert done.code == "ok"
    assert load_marks(paper.path, MAP) == text(BOX)


@pytest.mark.parametrize(
    ("content", "code"),
    [
        ("no json", "marks_invalid"),
        (text(BOX).replace('"version": 1', '"version": 2'), "marks_invalid"),
        (text(BOX).replace("[1, 1]", "[NaN, 1]"), "marks_invalid"),
        (text(BOX, allowed=[BOX]), "marks_invalid"),
        (text([[0, 0], [1, 1]]), "marks_invalid"),
        (text([[1, 1], [2, 2], [2, 1], [1, 2]]), "mark_crosses_itself"),
        (text([[1, 1], [1.05, 1], [1.05, 1.05]]), "mark_too_small"),
        (text(*[[[k, 0], [k + 1, 0], [k, 1]] * 3 for k in range(50)]), "marks_too_many"),
        (text(BOX).replace(MAP, "1" * 16), "marks_of_another_map"),
        (text(WHOLE), "marks_leave_nothing"),
    ],
)
def test_bad_marks_are_written_nowhere(paper: Paper, content: str, code: str) -> None:
    assert prepare(paper, PendingMarks("m1", "cli", content)).code == code
    assert not paper.path.exists()


def test_a_disk_that_refuses_is_told(paper: Paper) -> None:
    paper.path.parent.parent.joinpath("fence").write_text("in the way")
    assert prepare(paper, PendingMarks("m1", "cli", text(BOX))).code == "marks_unwritable"


@pytest.mark.parametrize("content", [b"no json", b"\xff\xfe", text(BOX).encode()[:-4]])
def test_marks_that_can_not_be_read_refuse_the_start(paper: Paper, content: bytes) -> None:
    paper.path.parent.mkdir(parents=True)
    paper.path.write_bytes(content)
    with pytest.raises(ConfigError, match="marks_invalid"):
        load_marks(paper.path, MAP)


def test_a_file_that_can_not_be_read_now_is_tried_again_and_a_home_that_is_none_has_no_marks(
    tmp_path: Path,
) -> None:
    file = tmp_path / "file"
    file.write_text("")
    assert load_marks(file / "fence" / "marks.json", MAP) == ""
    with pytest.raises(ConfigError, match="marks_unreadable") as refused:
        load_marks(tmp_path, MAP)
    assert refused.value.exit_status == 1


def test_the_desk_answers_once_and_writes_back_what_the_core_refused(paper: Paper) -> None:
    desk = MarksDesk(paper)
    before, asked = Marks(), PendingMarks("m1", "cli", text(BOX))
    desk.note(before)
    assert desk.take() is None
    desk.note(Marks(asked=asked))
    found: list[FenceDone] = []

    def answered() -> bool:
        found.extend(filter(None, [desk.take()]))
        return bool(found)

    until(answered)
    assert [done.code for done in found] == ["ok"]
    assert load_marks(paper.path, MAP) == text(BOX)
    desk.note(before)  # the robot could not stop before them
    until(lambda: load_marks(paper.path, MAP) == "")
    desk.note(Marks(asked=PendingMarks("m2", "cli", text(BOX))))
    until(lambda: desk.take() is not None)
    desk.note(Marks(text=text(BOX), hash="a" * 16))
    assert desk.close()
    assert load_marks(paper.path, MAP) == text(BOX)
