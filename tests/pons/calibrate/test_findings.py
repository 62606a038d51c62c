"""Values lie together or are refused; safety values are never better than the worst run."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pons.calibrate.errors import WORDS, CalibrationRefusal
from pons.calibrate.findings import CalibrationFinding, StraightRun, findings, gains
from wire import RobotDescription

ROBOT = RobotDescription()
RUN = StraightRun(0.1, 0.05, (1.0, 1.0), 0.05, 0.07, 0.01, 9.8)


def found(
    runs: list[StraightRun], apart: tuple[float, ...] = (0.5, 0.5)
) -> dict[str, CalibrationFinding]:
    return {one.key: one for one in findings(runs, apart, ROBOT, "the truth", "now")}


@settings(max_examples=40)
@given(st.lists(st.tuples(st.floats(0.06, 0.09), st.floats(9.2, 10.5)), min_size=2, max_size=8))
def test_the_longest_lag_and_the_weakest_stop_count(seen: list[tuple[float, float]]) -> None:
    values = found([replace(RUN, lag_s=lag, braking_radps2=braking) for lag, braking in seen])
    assert values["lag_s"].value >= max(lag for lag, _ in seen) - 1e-9
    weakest = min(braking for _, braking in seen) * 0.1
    assert values["max_decel_mps2"].value <= min(weakest, ROBOT.limits.max_decel_mps2) + 1e-9


def test_the_shortest_response_is_fed_forward() -> None:
    values = found([RUN, replace(RUN, response_s=0.043)])
    assert values["response_s"].value == 0.043


@pytest.mark.parametrize(
    ("run", "apart", "name"),
    [
        (replace(RUN, radius_m=0.102), (0.5, 0.5), "wheel_radius_m"),
        (RUN, (0.5, 0.52), "wheel_separation_m"),
        (replace(RUN, dead_zone_radps=0.1), (0.5, 0.5), "dead_zone_radps"),
        (replace(RUN, response_s=0.1), (0.5, 0.5), "response_s"),
        (replace(RUN, lag_s=0.2), (0.5, 0.5), "lag_s"),
        (replace(RUN, braking_radps2=5.0), (0.5, 0.5), "max_decel_mps2"),
        (replace(RUN, radius_m=float("nan")), (0.5, 0.5), "wheel_radius_m"),
    ],
)
def test_runs_that_disagree_are_refused(
    run: StraightRun, apart: tuple[float, ...], name: str
) -> None:
    with pytest.raises(CalibrationRefusal, match=name) as refused:
        found([RUN, RUN, run], apart)
    assert refused.value.code == "spread_too_wide"


@pytest.mark.parametrize(
    ("run", "apart"),
    [
        (replace(RUN, radius_m=0.2), (0.5, 0.5)),
        (RUN, (0.9, 0.9)),
        (replace(RUN, lag_s=0.7), (0.5, 0.5)),
        (replace(RUN, braking_radps2=1.0), (0.5, 0.5)),
    ],
)
def test_what_robot_toml_may_not_hold_is_refused(
    run: StraightRun, apart: tuple[float, ...]
) -> None:
    with pytest.raises(CalibrationRefusal) as refused:
        found([run, run], apart)
    assert refused.value.code == "out_of_bounds"


@given(st.floats(0.002, 0.5), st.floats(0.0, 0.1))
def test_gains_are_within_their_bounds(response_s: float, transport_s: float) -> None:
    kp, ki_per_s = gains(response_s, transport_s)
    assert 0.0 <= kp <= 2.0
    assert 0.0 <= ki_per_s <= 40.0


def test_the_defaults_are_what_the_rule_gives_for_the_simulated_motor() -> None:
    drive = ROBOT.drive
    assert (drive.kp, drive.ki_per_s) == gains(drive.response_s, 0.01)


@pytest.mark.parametrize("code", WORDS)
def test_every_refusal_speaks_both_languages(code: str, monkeypatch: pytest.MonkeyPatch) -> None:
    head, english = CalibrationRefusal(code, "why").lines()
    monkeypatch.setenv("LC_ALL", "zh_CN.UTF-8")
    _, chinese = CalibrationRefusal(code, "why").lines()
    assert head == f"{code}: why"
    assert english.isascii()
    assert any("一" <= character <= "鿿" for character in chinese)
