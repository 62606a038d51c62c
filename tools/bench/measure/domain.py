"""Measure what each knob of the simulator does to drives at home, alone and all together.

In lockstep with the simulator's physics and the real bridge core; localization is by scans.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import asdict, replace
from statistics import median
from typing import TYPE_CHECKING, Any

from sim import Domain, draw_domain
from tools.bench.drive_record import RecordedDrive, TourRecord
from tools.bench.figures import percentile
from tools.bench.report import ReportRow, number
from tools.lockstep import LockstepWorld
from wire import RobotDescription
from wire.robot import LocalizationConfig

if TYPE_CHECKING:
    from tools.bench.context import BenchLab

NAME = "domain"
TITLE = "drives at home with the simulator's knobs turned"
LONG_ONLY = True
GOAL = "p95 <= 0.05 m, 1.0 deg; lost 0"
ALL_DRAWN = "all drawn"
ALONE: dict[str, Domain] = {
    "neutral": Domain(),
    "sweep 0.1 s": Domain(lidar_sweep_s=0.1),
    "noise 0.05 m": Domain(lidar_noise_m=0.05),
    "30 % of beams lost": Domain(lidar_lost_share=0.3),
    "12 spots without return": Domain(lidar_null_patches=12),
    "ranges 2 % long": Domain(lidar_range_scale=1.02),
    "lidar 0.02 m and 0.5 deg off": Domain(lidar_x_error_m=0.02, lidar_yaw_error_rad=0.0087),
    "wheels +5 %, track -5 %": Domain(wheel_radius_scale=1.05, wheel_track_scale=0.95),
    "ice 2 s every 30 s": Domain(ice_every_s=30.0),
    "leant on, 120 N every 60 s": Domain(push_every_s=60.0, push_n=120.0),
    "scans 40 ms late": Domain(scan_delay_s=0.04),
    "5 % of scans lost": Domain(scan_loss_share=0.05),
    "1 % of drive and imu lost": Domain(drive_loss_share=0.01, imu_loss_share=0.01),
    "30 % of furniture moved": Domain(furniture_moved_share=0.3),
    "3 doors that move": Domain(doors=3),
    "3 polite walkers": Domain(polite_walkers=3),
    "4 blind walkers": Domain(blind_walkers=4),
    "carried every 120 s": Domain(carry_every_s=120.0),
}
CASES = (*ALONE, ALL_DRAWN)
LONG_S, QUICK_S = 600.0, 120.0
LONG_SEEDS, QUICK_SEEDS = 10, 1


def measure(lab: BenchLab) -> list[ReportRow]:
    """Drive each case with each seed; one processor a drive."""
    seeds, seconds = lab.count(QUICK_SEEDS, LONG_SEEDS), lab.count(int(QUICK_S), int(LONG_S))
    take = take_long if lab.long else take_quick
    drives: dict[str, list[TourRecord]] = {case: [] for case in CASES}
    for taken in lab.side_by_side("drive", len(CASES) * seeds, take):
        drives[taken["case"]].append(TourRecord(**taken["record"]))
    return [row_of_drives(case, drives[case], f"seeds of {seconds} s") for case in CASES]


def take_long(index: int) -> dict[str, Any]:
    """Drive ten minutes; the index says which case with which seed."""
    return _take(index, LONG_S)


def take_quick(index: int) -> dict[str, Any]:
    """Drive two minutes."""
    return _take(index, QUICK_S)


def domain_of(case: str, seed: int) -> Domain:
    """Return a case's domain with a seed."""
    return draw_domain(seed) if case == ALL_DRAWN else replace(ALONE[case], seed=seed)


def _take(index: int, seconds: float) -> dict[str, Any]:
    case, seed = CASES[index % len(CASES)], index // len(CASES) + 1
    robot = RobotDescription(localization=LocalizationConfig(kind="scans"))
    world = LockstepWorld(site="home", seed=seed, robot=robot, domain=domain_of(case, seed))
    return {"case": case, "record": asdict(RecordedDrive(world, f"{case} {seed}").run(seconds))}


def row_of_drives(case: str, drives: list[TourRecord], each: str, goal: str = GOAL) -> ReportRow:
    """Sum the drives of a case up in one row."""
    if not drives:
        return ReportRow(case, "", goal, value="none", note="nothing was measured", valid=False)
    errors_m = sorted(error for one in drives for error in one.errors_m)
    errors_deg = sorted(error for one in drives for error in one.errors_deg)
    spl = [share for one in drives for share in one.spl]
    ratios = [ratio for one in drives for ratio in one.time_ratios]
    reached, tried = (sum(getattr(one, name) for one in drives) for name in ("reached", "tried"))
    far_m, far_deg = percentile(errors_m, 0.95), percentile(errors_deg, 0.95)
    notes = [
        f"goals {reached}/{tried}",
        f"SPL {number(sum(spl) / len(spl)) if spl else '-'}",
        f"time x{number(median(ratios)) if ratios else '-'}",
        f"contacts {_words([one.contacts for one in drives])}",
        f"rows {_words([one.pose_rows for one in drives])}",
        f"{len(drives)} {each}",
    ]
    failed = _words([one.reasons for one in drives])
    notes += [f"failed: {failed}"] if failed != "0" else []
    value = f"p95 {number(far_m)} m, {number(far_deg)} deg"
    return ReportRow(case, "", goal, value=value, note="; ".join(notes))


def _words(counts: list[dict[str, int]]) -> str:
    total: Counter[str] = Counter()
    for one in counts:
        total.update(one)
    return ", ".join(f"{count} {name}" for name, count in sorted(total.items())) or "0"
