"""The bench of the knobs names each, judges by the truth, and sums up what it was handed."""

from __future__ import annotations

from dataclasses import fields

import pytest

from sim import Domain, draw_domain
from sim.domain import KNOWN
from tools.bench.drive_record import RecordedDrive, TourRecord
from tools.bench.measure.domain import ALL_DRAWN, ALONE, CASES, domain_of, row_of_drives
from tools.lockstep import LockstepWorld
from wire import ConfigError, Pose2, RobotDescription
from wire.robot import LocalizationConfig

AUXILIARY = {
    "seed", "ice_for_s", "push_n", "door_open_s", "door_shut_s", "walker_speed_mps",
    "drive_delay_s", "imu_delay_s",
}  # fmt: skip
"""These mean nothing alone, or are a tick at most where they are drawn."""


def test_every_knob_is_turned_alone_somewhere() -> None:
    neutral = Domain()
    turned = {
        field.name
        for domain in ALONE.values()
        for field in fields(Domain)
        if getattr(domain, field.name) != getattr(neutral, field.name)
    }
    assert turned | AUXILIARY == set(KNOWN)


def test_cases_get_their_seed() -> None:
    assert domain_of(ALL_DRAWN, 4) == draw_domain(4)
    assert domain_of("neutral", 4) == Domain(seed=4)
    assert len(set(CASES)) == len(CASES)


def test_a_drive_is_recorded_with_its_path_and_its_errors() -> None:
    robot = RobotDescription(localization=LocalizationConfig(kind="scans"))
    world = LockstepWorld(site="home", seed=2, robot=robot)
    record = RecordedDrive(world, "test").run(goals=1)
    assert (record.tried, record.reached, record.contacts) == (1, 1, {})
    assert record.spl == [pytest.approx(1.0, abs=0.1)]
    assert 1.0 < record.time_ratios[0] < 3.0
    assert 0.0 < max(record.errors_m) < 0.1


def test_a_contact_is_named_by_who_moved_into_what() -> None:
    world = LockstepWorld(site="home", seed=2, start=Pose2(9.0, 4.75, 3.14))
    drive = RecordedDrive(world, "test")
    here = world.truth
    world.put("person_0", Pose2(here.x_m - 0.54, here.y_m, 0.0))
    record = drive.run(seconds=1.0)
    assert set(record.contacts) <= {"robot stood"}
    assert drive._cause(0.3) == "robot into person"
    assert drive._cause(0.0) == "robot stood"
    world.put("person_0", None)
    assert drive._cause(0.3) == "robot into home"


def test_a_row_says_what_was_reached_and_what_was_touched() -> None:
    one = TourRecord(
        errors_m=[0.01] * 99 + [9.0], errors_deg=[0.5] * 100, reached=1, tried=2,
        spl=[1.0, 0.0], time_ratios=[1.5], contacts={"robot into home": 2},
        pose_rows={"POSE_LOST": 1}, reasons={"failed blocked": 1},
    )  # fmt: skip
    row = row_of_drives("neutral", [one, one], "seeds of 600 s")
    assert row.value == "p95 0.010 m, 0.500 deg"
    for words in (
        "goals 2/4", "SPL 0.500", "time x1.50", "4 robot into home", "2 POSE_LOST",
        "2 seeds of 600 s", "failed: 2 failed blocked",
    ):  # fmt: skip
        assert words in row.note
    assert not row_of_drives("neutral", [], "seeds").valid


def test_lockstep_shuts_doors_and_puts_people_onto_places() -> None:
    domain = Domain(doors=16, door_open_s=0.0)
    world = LockstepWorld(site="home", seed=2, domain=domain, ready=False)
    names = [name for name in world.sim.things.declared if name.startswith("leaf_")]
    world.shut_door("hallway", "kitchen")
    assert [name for name in names if world.sim.things.pose_of(name)] == ["leaf_4"]
    world.shut_door("kitchen", "hallway", shut=False)
    assert not any(world.sim.things.pose_of(name) for name in names)
    world.stand_on("kitchen")
    at = world.sim.things.pose_of("person_0")
    assert at is not None
    assert (at.x_m, at.y_m) == world.sim.home.rooms["kitchen"].pose[:2]
    with pytest.raises(ConfigError, match="no thing"):
        world.shut_door("kitchen", "bedroom")
