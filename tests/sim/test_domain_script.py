"""A domain changes the simulated world as it says, the same way each time, and breaks nothing."""

from __future__ import annotations

from math import hypot
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim import Domain, Hardware, Report, SimRobot, draw_domain
from sim.site import load_home
from sim.site.classes import PERSON_RADIUS_M
from sim.site.plan import furniture_shape, walls
from sim.staging import staged_home, walker_names
from sim.walkers import PASSES_M, STOPS_M, TOUCHES_M
from tests.known import known
from wire import ConfigError, DriveCommand, Pose2

pytestmark = pytest.mark.nightly(keep=12)


SITE = Path(__file__).resolve().parents[2] / "sites" / "home"
TICK_S = 0.01
ROBOT_M = 0.30
HALLWAY = Pose2(6.0, 4.75, 0.0)


def robot_in(domain: Domain | None, start: Pose2 | None = None, site: Path = SITE) -> SimRobot:
    return SimRobot(site, seed=3, start=start, domain=domain)


def drive(robot: SimRobot, seconds: float, wheel_radps: float = 3.0) -> list[Report]:
    """Drive ahead, turning a little."""
    reports = []
    for _ in range(round(seconds / TICK_S)):
        now_s = robot.time_s
        reports.append(robot.tick(now_s + TICK_S))
        seq = len(reports)
        command = DriveCommand(
            boot="b", seq=seq, enable=True, left_radps=wheel_radps, right_radps=1.1 * wheel_radps
        )
        robot.command(command, now_s + TICK_S)
    return reports


@pytest.fixture(scope="module")
def plain() -> list[Report]:
    """Drive a second in the home as it is declared, without a domain."""
    return drive(robot_in(None), 1.0)


@pytest.mark.parametrize(
    "idle",
    [
        Domain(seed=5),
        Domain(ice_for_s=9.0, push_n=300.0, door_shut_s=2.0, walker_speed_mps=0.7),
        Domain(push_every_s=3600.0, ice_every_s=3600.0),  # plays, and nothing is due yet
        Domain(lidar_sweep_s=0.0, lidar_noise_m=0.01, lidar_lost_share=0.002),
        Domain(scan_delay_s=0.004, drive_delay_s=0.004),  # less than half a tick
    ],
)
def test_neutral_knobs_change_no_byte(idle: Domain, plain: list[Report]) -> None:
    assert drive(robot_in(idle), 1.0) == plain


@pytest.mark.parametrize(
    "turned",
    [
        Domain(lidar_sweep_s=0.1),
        Domain(lidar_noise_m=0.05),
        Domain(lidar_lost_share=0.5),
        Domain(lidar_null_patches=40),
        Domain(lidar_range_scale=1.02),
        Domain(lidar_x_error_m=0.05),
        Domain(lidar_yaw_error_rad=0.1),
        Domain(scan_delay_s=0.02),
        Domain(scan_loss_share=0.5),
        Domain(furniture_moved_share=1.0),
        Domain(polite_walkers=8),
    ],
)
def test_a_turned_knob_changes_the_scan_and_nothing_else(
    turned: Domain, plain: list[Report]
) -> None:
    stream = drive(robot_in(turned), 1.0)
    assert [(one.drive, one.imu, one.truth) for one in stream] == [
        (one.drive, one.imu, one.truth) for one in plain
    ]
    assert [one.scan for one in stream] != [one.scan for one in plain]


@given(st.integers(0, 10**6))
@settings(max_examples=3, deadline=None)
def test_a_seed_gives_one_world_bit_for_bit(seed: int) -> None:
    domain = draw_domain(seed)
    one, other = robot_in(domain), robot_in(domain)
    assert drive(one, 2.0) == drive(other, 2.0)
    assert one.things.elsewhere == other.things.elsewhere
    assert one.home == other.home


@pytest.mark.parametrize(
    ("knob", "reach_m"),
    [("polite_walkers", STOPS_M), ("blind_walkers", TOUCHES_M)],
)
@pytest.mark.parametrize("seed", range(2))
def test_walkers_keep_their_distance_from_a_standing_robot(
    knob: str, reach_m: float, seed: int
) -> None:
    robot = robot_in(Domain(seed=seed, **{knob: 4}), HALLWAY)
    assert robot.script is not None
    least_m, began = 9.0, [(one.x_m, one.y_m) for one in robot.script.walkers]
    before = [(one.x_m, one.y_m) for one in robot.script.walkers]
    for _ in range(2000):
        robot.tick(robot.time_s + TICK_S)
        for index, walker in enumerate(robot.script.walkers):
            gap_m = walker.gap_m(robot.base_in_map, ROBOT_M)
            allowed_m = PASSES_M if walker.passes else reach_m
            assert gap_m >= allowed_m - 1e-3 or (walker.x_m, walker.y_m) == before[index]
            least_m = min(least_m, gap_m)
            before[index] = (walker.x_m, walker.y_m)
    assert least_m >= min(reach_m, PASSES_M) - 1e-3
    assert robot.contacts_total == 0
    gone_m = [hypot(x - one[0], y - one[1]) for (x, y), one in zip(before, began, strict=True)]
    assert max(gone_m) > 0.5, "they walk"


@pytest.mark.parametrize("seed", range(2))
def test_walkers_go_through_no_wall_no_furniture_and_no_shut_leaf(seed: int) -> None:
    domain = Domain(seed=seed, polite_walkers=3, blind_walkers=3, doors=16, door_open_s=5.0)
    robot = robot_in(domain, HALLWAY)
    solids = [wall.shape for wall in walls(robot.home)]
    solids += [furniture_shape(item) for item in robot.home.furniture.values()]
    for _ in range(1200):
        robot.tick(robot.time_s + TICK_S)
        shut = [
            leaf
            for name, leaf in known(robot.script).leaves.items()
            if robot.things.pose_of(name) is not None
        ]
        for walker in known(robot.script).walkers:
            away_m = min(shape.distance(walker.x_m, walker.y_m) for shape in [*solids, *shut])
            assert away_m >= PERSON_RADIUS_M - 0.01
    assert robot.contacts_total == 0


def test_leaves_open_and_shut_but_not_onto_the_robot() -> None:
    inside = Pose2(2.0, 4.0, 1.57)  # in the kitchen's doorway
    robot = robot_in(Domain(doors=16, door_open_s=2.0, door_shut_s=1.0), inside)
    names = [name for name in robot.things.declared if name.startswith("leaf_")]
    assert len(names) == len(robot.home.doors)
    states: dict[str, set[bool]] = {name: set() for name in names}
    for _ in range(1000):
        robot.tick(robot.time_s + TICK_S)
        for name in names:
            states[name].add(robot.things.pose_of(name) is not None)
    assert [name for name in names if states[name] != {True, False}] == ["leaf_4"]
    assert robot.contacts_total == 0


def test_a_leaf_without_a_script_stays_open() -> None:
    robot = robot_in(Domain(doors=3, door_open_s=0.0))
    drive(robot, 2.0, 0.0)
    names = [name for name in robot.things.declared if name.startswith("leaf_")]
    assert len(names) == 3
    assert all(robot.things.pose_of(name) is None for name in names)


def test_the_lidar_sees_a_shut_leaf() -> None:
    before_door = Pose2(2.0, 4.75, -1.5708)
    robot = robot_in(Domain(doors=16, door_open_s=0.0), before_door)
    ahead = [scan_ahead_m(robot)]
    robot.place_thing("leaf_4", robot.things.declared["leaf_4"])
    ahead.append(scan_ahead_m(robot))
    assert ahead[0] > 1.5
    assert ahead[1] == pytest.approx(0.75 - 0.03, abs=0.05)


def scan_ahead_m(robot: SimRobot) -> float:
    scan = next(one.scan for one in reversed(drive(robot, 0.3, 0.0)) if one.scan is not None)
    ahead = scan.ranges_m[round(-scan.angle_min_rad / scan.angle_increment_rad)]
    return 99.0 if ahead is None else ahead


def test_furniture_moves_where_it_may_and_the_map_does_not_know() -> None:
    home = load_home(SITE)
    moved = staged_home(home, Domain(furniture_moved_share=1.0))
    changed = [name for name in home.furniture if moved.furniture[name] != home.furniture[name]]
    assert len(changed) >= 5
    for name in changed:
        one, other = (furniture_shape(each.furniture[name]).bounds for each in (home, moved))
        assert abs(one.x0 - other.x0) <= 0.5
        assert abs(one.y0 - other.y0) <= 0.5
    assert moved.rooms == home.rooms
    assert staged_home(home, Domain(furniture_moved_share=1.0)) == moved


def test_ice_takes_the_grip_and_gives_it_back() -> None:
    robot = robot_in(Domain(ice_every_s=1.0, ice_for_s=1.0), Pose2(3.0, 4.75, 0.0))
    plain = robot_in(None, Pose2(3.0, 4.75, 0.0))
    drive(robot, 3.0, 5.0)
    drive(plain, 3.0, 5.0)
    assert robot.base_in_map != plain.base_in_map


def test_a_push_moves_a_robot_that_stands() -> None:
    robot = robot_in(Domain(push_every_s=1.0, push_n=400.0), HALLWAY)
    drive(robot, 3.0, 0.0)
    at = robot.base_in_map
    assert hypot(at.x_m - HALLWAY.x_m, at.y_m - HALLWAY.y_m) > 0.01


def test_nobody_leans_on_a_robot_on_ice() -> None:
    domain = Domain(ice_every_s=1.0, ice_for_s=3.0, push_every_s=1.0, push_n=400.0)
    script = known(robot_in(domain, HALLWAY).script)
    acts = [script.turn(tick, HALLWAY) for tick in range(1, 3000)]
    assert any(any(one.ice) for one in acts)
    assert any(any(one.force_n) for one in acts)
    assert not any(any(one.ice) and any(one.force_n) for one in acts)


def test_a_robot_is_carried_and_its_wheels_notice_nothing() -> None:
    robot = robot_in(Domain(carry_every_s=1.0), HALLWAY)
    reports = drive(robot, 2.0, 0.0)
    at = robot.base_in_map
    assert hypot(at.x_m - HALLWAY.x_m, at.y_m - HALLWAY.y_m) > 0.3
    drives = [one.drive for one in reports if one.drive is not None]
    assert abs(drives[-1].left_rad - drives[0].left_rad) < 0.01


def test_scans_come_late_and_say_so() -> None:
    late = drive(robot_in(Domain(scan_delay_s=0.04)), 1.0, 0.0)
    soon = drive(robot_in(None), 1.0, 0.0)
    stamps = [[r.scan.stamp_s for r in reports if r.scan] for reports in (late, soon)]
    arrivals = [[i for i, r in enumerate(reports) if r.scan] for reports in (late, soon)]
    assert stamps[0] == stamps[1][: len(stamps[0])]
    assert arrivals[0] == [at + 4 for at in arrivals[1]][: len(arrivals[0])]


def test_messages_are_lost_at_the_share_that_is_said() -> None:
    reports = drive(robot_in(Domain(drive_loss_share=0.3)), 10.0, 0.0)
    assert 0.6 < sum(one.drive is not None for one in reports) / len(reports) < 0.8


def test_ranges_are_scaled_and_patches_return_nothing() -> None:
    long, plain, patched = (
        nulls_and_mean(domain)
        for domain in (Domain(lidar_range_scale=1.05), None, Domain(lidar_null_patches=40))
    )
    assert long[1] == pytest.approx(1.05 * plain[1], rel=0.01)
    assert patched[0] > plain[0] + 5


def nulls_and_mean(domain: Domain | None) -> tuple[int, float]:
    reports = drive(SimRobot(SITE, seed=3, domain=domain, start=Pose2(9.3, 6.6, 0.0),
                             hardware=Hardware(lidar_dropout=0.0)), 0.3, 0.0)  # fmt: skip
    ranges = next(one.scan for one in reversed(reports) if one.scan is not None).ranges_m
    there = [one for one in ranges if one is not None]
    return len(ranges) - len(there), sum(there) / len(there)


def test_walkers_have_names_and_keep_off_the_start() -> None:
    domain = Domain(polite_walkers=2, blind_walkers=1)
    assert walker_names(domain) == ("polite_0", "polite_1", "blind_0")
    first = robot_in(domain)
    at = known(first.script).walkers[0]
    again = robot_in(domain, Pose2(at.x_m, at.y_m, 0.0))
    assert again.contacts_total == 0
    assert all(one.gap_m(again.base_in_map, ROBOT_M) >= 1.0 for one in known(again.script).walkers)


def test_a_map_alone_refuses_furniture_and_doors_and_lets_people_walk(tmp_path: Path) -> None:
    for name in ("map.yaml", "map.pgm", "places.yaml"):
        (tmp_path / name).write_bytes((SITE / name).read_bytes())
    for domain in (Domain(doors=1), Domain(furniture_moved_share=0.1)):
        with pytest.raises(ConfigError, match=r"home\.yaml") as refused:
            robot_in(domain, site=tmp_path)
        assert refused.value.code == "domain_needs_home"
    robot = robot_in(draw_domain(7, declared=False), site=tmp_path)
    drive(robot, 1.0, 0.0)
    walking = robot_in(Domain(polite_walkers=2), site=tmp_path)
    drive(walking, 3.0, 0.0)
    assert walking.things.elsewhere


def test_too_many_things_are_refused() -> None:
    home = load_home(SITE)
    objects = {f"o{i}": next(iter(home.objects.values())) for i in range(48)}
    with pytest.raises(ConfigError, match="at most 64"):
        staged_home(home.model_copy(update={"objects": objects}), Domain(polite_walkers=8, doors=7))
