"""A drive's windows follow from how often it reports, and only ever make the robot stop earlier."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from wire.drive_config import DRIVE_KINDS, DriveConfig, DriveKind

ENC_LONG_S = 0.25
"""Of the core: a window as long as this would never hold before it stops."""


def config_of(kind: str) -> DriveConfig:
    needed = {"port": "/dev/ttyACM0", "ticks_per_turn": 4096}
    keys = {key: needed[key] for key in DRIVE_KINDS[kind].needed}
    return DriveConfig.model_validate({"kind": kind, **keys})


@pytest.mark.parametrize("kind", ["sim", "pons_mcu"])
def test_a_drive_that_reports_each_tick_has_the_shortest_windows(kind: str) -> None:
    config = config_of(kind)
    assert (config.encoder_window_s, config.answer_window_s) == (0.08, 0.1)
    assert config.unseen_s == 0.0
    assert config.late_s == config.lag_s


@pytest.mark.parametrize("kind", sorted(DRIVE_KINDS))
def test_no_kind_reports_so_seldom_that_its_window_hides_the_longer_one(kind: str) -> None:
    config = config_of(kind)
    assert config.encoder_window_s < ENC_LONG_S
    assert config.answer_window_s < ENC_LONG_S


@pytest.mark.parametrize("kind", sorted(DRIVE_KINDS))
def test_a_dead_man_that_nothing_can_set_is_the_firmwares_own(kind: str) -> None:
    config = config_of(kind)
    fixed_s = DRIVE_KINDS[kind].dead_man_s
    assert config.dead_man_s == (config.timeout_s if fixed_s is None else fixed_s)
    given_keys = config.model_dump(exclude_unset=True)
    if fixed_s is None:
        assert DriveConfig.model_validate({**given_keys, "timeout_s": 0.3}).dead_man_s == 0.3
    else:
        with pytest.raises(ValueError, match="whatever it is told"):
            DriveConfig.model_validate({**given_keys, "timeout_s": 0.3})


@pytest.mark.parametrize("kind", sorted(DRIVE_KINDS))
def test_only_a_drive_that_reports_its_dead_man_needs_no_trial(kind: str) -> None:
    assert config_of(kind).reports_dead_man is (kind in {"sim", "pons_mcu", "ros2"})


@given(st.floats(0.001, 0.1))
def test_longer_windows_are_paid_for_in_lag(report_s: float) -> None:
    with pytest.MonkeyPatch.context() as patch:
        assert isinstance(DRIVE_KINDS, dict)
        patch.setitem(DRIVE_KINDS, "sim", DriveKind((), (), report_s))
        config = DriveConfig()
        assert config.encoder_window_s >= max(0.08, 2.5 * report_s)
        assert config.answer_window_s >= max(0.1, 2.5 * report_s)
        assert config.late_s - config.lag_s >= config.encoder_window_s - 0.08 - 1e-12
        assert config.late_s - config.lag_s >= config.answer_window_s - 0.1 - 1e-12
