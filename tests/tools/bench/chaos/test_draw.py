"""An episode is its number: drawn alike every time, and all kinds of faults come."""

from __future__ import annotations

from tools.bench.chaos.draw import (
    FREEZE_S,
    LIDAR,
    OF_A_PROCESS,
    OWNER_OF,
    PROCESSES,
    STALL_S,
    Episode,
    FaultKind,
    draw,
)
from wire import SimFault

ALL = [draw(number) for number in range(500)]


def test_a_number_means_one_episode() -> None:
    assert [draw(number) for number in range(50)] == ALL[:50]
    assert len({episode.mission + str(episode.faults) for episode in ALL}) == len(ALL)


def test_sockets_keep_their_order_so_that_old_numbers_mean_what_they_meant() -> None:
    assert list(OWNER_OF.items()) == [
        ("bridge", "bridge"),
        ("senses", "bridge"),
        ("drive", "sim"),
        ("robot", "sim"),
        ("localization", "localization"),
        ("camera", "camera"),
        ("hint", "localization"),
    ]


def test_every_kind_strikes_every_target() -> None:
    struck = {(fault.kind, fault.target) for episode in ALL for fault in episode.faults}
    wanted = {(kind, name) for kind in OF_A_PROCESS for name in PROCESSES}
    wanted |= {(FaultKind.LIDAR, name) for name in LIDAR}
    wanted |= {(FaultKind.SOCKET, name) for name in OWNER_OF}
    wanted |= {(kind, "") for kind in FaultKind if kind not in {kind for kind, _ in wanted}}
    assert struck == wanted


def test_two_come_at_once_and_stops_are_said_about_as_often_as_meant() -> None:
    assert 90 <= sum(len(episode.faults) == 2 for episode in ALL) <= 160
    assert 130 <= sum(episode.stop is not None for episode in ALL) <= 205
    assert {episode.stop.way for episode in ALL if episode.stop} == {"http", "cli"}


def test_spans_are_within_what_the_kind_allows() -> None:
    spans = {FaultKind.FREEZE: FREEZE_S, FaultKind.STALL: STALL_S}
    for fault in (fault for episode in ALL for fault in episode.faults):
        if fault.kind in spans:
            low_s, high_s = spans[fault.kind]
            assert low_s <= fault.for_s <= high_s
        elif fault.kind in (FaultKind.KILL, FaultKind.SOCKET):
            assert fault.for_s == 0.0


def test_the_lidars_faults_are_known_to_the_simulator() -> None:
    assert {SimFault(name) for name in LIDAR}


def test_what_is_to_be_said_stands_in_the_mission_and_is_resumed() -> None:
    speaking: list[Episode] = [episode for episode in ALL if episode.says]
    assert speaking
    for episode in speaking:
        assert episode.goes_on
        assert all(episode.mission.count(words) == 1 for words in episode.says)
