"""Proposals: what they change in figures, what is refused unread, and how they keep."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from math import cos, sin, tau
from pathlib import Path
from typing import Any

import pytest

from planner.site import FenceProposals, FenceRefusal, Site, check_fence, fence_diff
from planner.site.fence_store import MAX_OPEN
from wire import FenceFile, Pose2, fingerprint
from wire.fence import MAX_CORNERS, fence_text

SITE = Site.load(Path(__file__).resolve().parents[3] / "sites" / "two_room")
HERE = SITE.home.pose
Square = list[list[float]]


RING = [[0.5 + 0.1 * cos(k * tau / 250), 3.5 + 0.1 * sin(k * tau / 250)] for k in range(250)]


def fence(**changes: Any) -> FenceFile:
    base = SITE.fence.record.model_dump(mode="json")
    return FenceFile.model_validate({**base, **changes}, strict=False)


def square(x: float, y: float, side: float) -> Square:
    return [[x, y], [x + side, y], [x + side, y + side], [x, y + side]]


# Figures -----------------------------------------------------------------------------------------


def test_the_same_fence_changes_nothing() -> None:
    diff = fence_diff(fence(), fence(), SITE.rooms)
    assert (diff.added_m2, diff.removed_m2, diff.rooms) == (0.0, 0.0, ())
    assert diff.allowed_m2 == pytest.approx(2.6 * 2.6 * 2 + 0.7 * 0.4, rel=0.01)


def test_a_keep_out_forbids_its_area_in_its_room() -> None:
    diff = fence_diff(fence(), fence(keep_outs=[square(0.4, 3.4, 0.5)]), SITE.rooms)
    assert diff.removed_m2 == pytest.approx(0.25, rel=0.02)
    assert diff.added_m2 == 0.0
    assert [room.room for room in diff.rooms] == ["living_room"]
    assert diff.rooms[0].removed_m2 == pytest.approx(0.25, rel=0.02)


def test_what_is_gained_and_lost_do_not_cancel_out() -> None:
    before = fence(allowed=[square(0, 0, 2)])
    after = fence(allowed=[square(1, 0, 2)])
    diff = fence_diff(before, after, SITE.rooms)
    assert diff.added_m2 == pytest.approx(2.0, rel=0.01)
    assert diff.removed_m2 == pytest.approx(2.0, rel=0.01)


def test_outlines_that_overlap_count_once_and_zones_are_counted() -> None:
    zone = {"polygon": square(0, 0, 1), "max_speed_mps": 0.2}
    before = fence(allowed=[square(0, 0, 2)], keep_outs=[square(0, 0, 1)])
    after = fence(allowed=[square(0, 0, 2), square(1, 1, 1)], speed_zones=[zone])
    diff = fence_diff(before, after, ())
    assert diff.added_m2 == pytest.approx(1.0, rel=0.01)
    assert diff.allowed_m2 == pytest.approx(4.0, rel=0.01)
    assert (diff.zones_before, diff.zones_after) == (0, 1)


# What is refused ---------------------------------------------------------------------------------


def refused(proposal: FenceFile, pose: Pose2 | None = HERE) -> FenceRefusal:
    with pytest.raises(FenceRefusal) as caught:
        check_fence(proposal, SITE, pose)
    assert caught.value.detail
    return caught.value


def test_the_fence_of_the_site_would_be_accepted() -> None:
    check_fence(fence(), SITE, HERE)
    check_fence(fence(), SITE, None)


def test_a_fence_without_the_robot_is_refused_where_its_place_is_known() -> None:
    away = Pose2(9.0, 9.0, 0.0)
    assert refused(fence(), away).code == "fence_excludes_robot"
    check_fence(fence(), SITE, None)


@pytest.mark.parametrize(
    ("changes", "code", "word"),
    [
        ({"keep_outs": [square(0.6, 0.6, 0.6)]}, "fence_excludes_place", "charging_dock"),
        ({"keep_outs": [square(1.1, 0.6, 0.2)]}, "fence_near_place", "0.20 m from the fence"),
        ({"map_id": "1" * 16}, "fence_of_another_map", SITE.map_id),
        ({"keep_outs": [[[0, 0], [1, 1], [1, 0], [0, 1], [-1, 0.5]]]}, "fence_crosses_itself", ""),
        ({"keep_outs": [[[0, 0], [1, 1], [2, 2]]]}, "fence_degenerate", "no area"),
        ({"keep_outs": [RING] * (MAX_CORNERS // len(RING))}, "fence_too_large", "corners"),
    ],
    ids=["over a place", "near a place", "map", "crossing", "no area", "corners"],
)
def test_what_could_not_be_lived_with_is_refused(
    changes: dict[str, Any], code: str, word: str
) -> None:
    found = refused(fence(**changes))
    assert found.code == code
    assert word in found.detail


def test_a_text_that_no_request_could_carry_is_refused() -> None:
    long = [square(1 / 3 + k * 1e-9, 1 / 7, 1 / 9) for k in range(200)]
    assert len(fence_text(fence(keep_outs=long))) > 24_000
    assert refused(fence(keep_outs=long)).code == "fence_too_large"


# How they keep -----------------------------------------------------------------------------------


class Clock:
    def __init__(self) -> None:
        self.now = datetime(2026, 1, 1, tzinfo=UTC)

    def __call__(self) -> datetime:
        self.now += timedelta(seconds=1)
        return self.now


@pytest.fixture
def store(tmp_path: Path) -> FenceProposals:
    return FenceProposals.in_home(tmp_path, clock=Clock())


def small(number: int) -> FenceFile:
    return fence(keep_outs=[square(0.3 + 0.001 * number, 3.4, 0.2)])


def test_a_proposal_is_named_by_the_hash_that_status_will_show(store: FenceProposals) -> None:
    item = store.propose(small(1), "cli")
    assert item.id == fingerprint(item.text.encode())
    assert store.get(item.id) == item
    assert FenceFile.model_validate_json(item.text, strict=False) == small(1)


def test_proposals_outlive_a_restart_and_come_newest_first(store: FenceProposals) -> None:
    first, second = store.propose(small(1), "cli"), store.propose(small(2), "page")
    again = FenceProposals.in_home(store._database.path.parent)
    assert [item.id for item in again.list_all()] == [second.id, first.id]


def test_the_same_text_again_is_one_proposal_open_anew(store: FenceProposals) -> None:
    item = store.propose(small(1), "cli")
    store.decide(item.id, "rejected", "cli")
    assert store.get(item.id).state == "rejected"
    assert store.propose(small(1), "cli").state == "proposed"
    assert len(store.list_all()) == 1


def test_a_text_that_was_changed_on_the_disk_is_no_proposal(store: FenceProposals) -> None:
    item = store.propose(small(1), "cli")
    with store._database.change() as connection:
        connection.execute("UPDATE fence_proposals SET record = replace(record, '0.301', '0.001')")
    with pytest.raises(FenceRefusal, match="unknown_fence_proposal"):
        store.get(item.id)


def test_files_of_the_layout_before_are_taken_over_once_and_kept_beside(
    store: FenceProposals, tmp_path: Path
) -> None:
    item = store.propose(small(1), "cli")
    folder = tmp_path / "before" / "fence" / "proposals"
    folder.mkdir(parents=True)
    whole = item.model_dump_json(indent=1)
    (folder / f"{item.id}.json").write_text(whole)
    odd = {
        b"",
        b"{}",
        b"\xff",
        b"[1]",
        whole[:99].encode(),
        whole.replace("0.301", "0.001").encode(),
    }
    for number, data in enumerate(odd):
        (folder / f"{number:016x}.json").write_bytes(data)
    for _ in range(2):
        after = FenceProposals.in_home(tmp_path / "before")
        assert after.list_all() == [item]
    assert not folder.exists()
    beside = folder.with_name("proposals.old")
    assert {path.read_bytes() for path in beside.iterdir()} == odd | {whole.encode()}


def test_too_many_that_wait_are_refused_until_some_are_decided(store: FenceProposals) -> None:
    items = [store.propose(small(number), "cli") for number in range(MAX_OPEN)]
    with pytest.raises(FenceRefusal, match="fence_proposals_full"):
        store.propose(small(99), "cli")
    store.decide(items[0].id, "rejected", "cli")
    store.propose(small(99), "cli")


def test_an_unknown_one_is_told_which_there_are(store: FenceProposals) -> None:
    item = store.propose(small(1), "cli")
    with pytest.raises(FenceRefusal, match=item.id):
        store.decide("0" * 16, "accepted", "cli")
