"""The table of the chaos counts what was judged, and says how many it was counted among."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from planner.mission import MissionJournal
from tools.bench.chaos.draw import draw
from tools.bench.measure.chaos import lost_records, rows

PLAIN: dict[str, Any] = {
    "goals": ["g1"], "contacts": 0, "said_twice": [], "said": 0, "lost": [], "unrecovered": [],
    "stop_broken": "", "ready_s": 1.5,
}  # fmt: skip
STOPPED: dict[str, Any] = {
    "ready_s": None, "confirmed_s": 0.1, "stop_trouble": "",
    "stopped": {"moving": True, "stood_s": 0.5},
}  # fmt: skip


def told(number: int, **more: Any) -> dict[str, Any]:
    episode = draw(number)
    return {**episode.record(), **PLAIN, **(STOPPED if episode.stop else {}), **more}


def cells(played: list[dict[str, Any]]) -> dict[str, tuple[str, str]]:
    life = {"goals": 1, "lost": [], "files": 2, "unreadable": []}
    return {row.what: (row.value, row.note) for row in rows(played, [life], "")}


def numbers(*, stopped: bool) -> list[int]:
    return [n for n in range(100) if (draw(n).stop is not None) == stopped]


def test_zeros_say_among_how_many() -> None:
    played = [told(number) for number in range(60)]
    table = cells(played)
    stops = sum(one["stop"] is not None for one in played)
    assert table["contacts"][0].startswith("0 of 60 (< 5.00%")
    assert table["motion after a confirmed stop"][0].startswith(f"0 of {stops} ")
    assert table["stops never confirmed"][0] == f"0 of {stops}"
    assert table["clock jump"][0] == "skipped"


def test_what_went_wrong_is_counted_and_named() -> None:
    bad, stop = numbers(stopped=False)[0], numbers(stopped=True)[0]
    table = cells(
        [
            told(
                bad, contacts=2, lost=["g1: unknown_goal"], unrecovered=["rc 1"], said_twice=["a"]
            ),
            told(stop, stop_broken="0.30 m/s"),
            told(numbers(stopped=True)[1], confirmed_s=None, stop_trouble="no_bridge"),
        ]
    )
    assert table["contacts"] == ("2 of 3", f"episodes [{bad}]")
    assert table["lost goals"] == ("1 of 3", "g1: unknown_goal")
    assert table["unrecovered"][0] == "1 of 3"
    assert f"#{bad} " in table["unrecovered"][1]
    assert table["motion after a confirmed stop"][0] == "1 of 1"
    assert "no_bridge" in table["stops never confirmed"][1]


def test_a_goal_that_the_journal_lacks_is_lost(tmp_path: Path) -> None:
    MissionJournal.in_home(tmp_path).close()
    assert lost_records(tmp_path, ["g1"]) == {
        "goals": 1,
        "lost": ["g1"],
        "files": 0,
        "unreadable": [],
    }
