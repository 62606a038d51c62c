"""A domain is drawn by seed, read from a file, and refused where it can't be."""

from __future__ import annotations

from dataclasses import fields, replace
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sim.domain import DECLARED_ALONE, DRAWN, KNOWN, Domain, draw_domain, load_domain
from sim.hardware import Hardware
from wire import ConfigError
from wire.robot import Base

BASE = Base()


def written(folder: Path, text: str) -> Path:
    path = folder / "domain.toml"
    path.write_text(text, "utf-8")
    return path


@given(st.integers(0, 2**53))
def test_a_seed_draws_one_domain_within_what_may_be_drawn(seed: int) -> None:
    drawn = draw_domain(seed)
    assert drawn == draw_domain(seed)
    assert drawn.seed == seed
    for name, (low, high) in DRAWN.items():
        assert low <= getattr(drawn, name) <= high


def test_seeds_differ() -> None:
    assert len({draw_domain(seed).lidar_noise_m for seed in range(50)}) > 40


@given(st.integers(0, 1000))
def test_a_map_alone_draws_neither_furniture_nor_doors(seed: int) -> None:
    bare, full = draw_domain(seed, declared=False), draw_domain(seed)
    neutral = {name: getattr(Domain(), name) for name in DECLARED_ALONE}
    assert bare == replace(full, **neutral)


def test_a_file_holds_what_was_drawn(tmp_path: Path) -> None:
    for seed in range(20):
        drawn = draw_domain(seed)
        assert load_domain(written(tmp_path, drawn.as_toml())) == drawn


def test_what_a_file_leaves_out_is_neutral(tmp_path: Path) -> None:
    assert load_domain(written(tmp_path, "")) == Domain()
    assert load_domain(written(tmp_path, "doors = 2")) == Domain(doors=2)
    assert Domain(seed=7).is_neutral
    assert not Domain(doors=1).is_neutral


@pytest.mark.parametrize(
    ("text", "code", "said"),
    [
        ("polite_walker = 1", "domain_invalid", "known: seed, lidar_sweep_s"),
        ("polite_walkers = 9", "domain_invalid", "less than or equal to 8"),
        ("polite_walkers = 1.5", "domain_invalid", "polite_walkers"),
        ("polite_walkers = -1", "domain_invalid", "polite_walkers"),
        ("lidar_sweep_s = 0.21", "domain_invalid", "less than or equal to 0.2"),
        ("wheel_radius_scale = 1.2", "domain_invalid", "wheel_radius_scale"),
        ("lidar_yaw_error_rad = nan", "domain_invalid", "lidar_yaw_error_rad"),
        ("push_n = inf", "domain_invalid", "push_n"),
        ('doors = "all"', "domain_invalid", "doors"),
        ("doors = 2020-01-01", "domain_invalid", "date"),
        ("doors = [", "domain_syntax", "domain.toml"),
    ],
)
def test_what_cannot_be_is_refused(tmp_path: Path, text: str, code: str, said: str) -> None:
    with pytest.raises(ConfigError, match=said) as refused:
        load_domain(written(tmp_path, text))
    assert refused.value.code == code


def test_no_seed_is_negative() -> None:
    with pytest.raises(ConfigError, match="seed"):
        draw_domain(-1)


def test_a_missing_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match="No such file"):
        load_domain(tmp_path / "none.toml")


def test_the_hardware_keeps_what_the_domain_does_not_say() -> None:
    metal = Hardware(lidar_noise_m=0.03, wheel_radius_m=0.08, lidar_sweep_s=0.05)
    same = Domain().hardware(BASE, metal)
    assert same == replace(metal, wheel_separation_m=BASE.wheel_separation_m)
    worse = Domain(lidar_noise_m=0.05, wheel_radius_scale=1.05).hardware(BASE, metal)
    assert worse.lidar_noise_m == 0.05
    assert worse.lidar_sweep_s == 0.05
    assert worse.wheel_radius_m == pytest.approx(0.084)


def test_every_drawn_knob_exists() -> None:
    assert set(DRAWN) < set(KNOWN) == {field.name for field in fields(Domain)}
