"""``pons up --domain`` draws or reads a domain, keeps it, and hands it to simulator and camera."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from pons.children import children
from pons.domain import DOMAIN_FILE, choose_domain, keep_domain
from pons.grammar import parser
from pons.settings import CHECKOUT, LaunchSettings
from sim.domain import Domain, draw_domain, load_domain
from tests.known import known
from wire import ConfigError, RobotDescription

SITE = CHECKOUT / "sites" / "two_room"


@pytest.fixture
def settings(tmp_path: Path) -> LaunchSettings:
    return LaunchSettings(tmp_path, CHECKOUT / "robot.toml", SITE, "127.0.0.1", 8420)


def test_a_draw_is_kept_and_can_be_repeated_from_its_file(settings: LaunchSettings) -> None:
    kept, words = keep_domain(replace(settings, domain="random", seed=7), RobotDescription())
    path = settings.home / DOMAIN_FILE
    assert load_domain(path) == draw_domain(7)
    assert kept.domain == str(path)
    assert kept.seed == 7
    assert f"pons up --domain {path}" in words
    assert "lidar_sweep_s = " in words
    again, _ = keep_domain(replace(settings, domain=str(path)), RobotDescription())
    assert again == kept
    assert load_domain(path) == draw_domain(7)


def test_a_draw_without_a_seed_gets_one_and_says_it(settings: LaunchSettings) -> None:
    kept, words = keep_domain(replace(settings, domain="random"), RobotDescription())
    assert f"seed = {known(kept.seed)}," in words
    assert load_domain(settings.home / DOMAIN_FILE) == draw_domain(known(kept.seed))


def test_a_seed_beside_a_file_is_the_files_new_seed(settings: LaunchSettings) -> None:
    file = settings.home / "mine.toml"
    file.write_text("polite_walkers = 2\nseed = 1\n", "utf-8")
    chosen = choose_domain(replace(settings, domain=str(file), seed=9))
    assert chosen == Domain(seed=9, polite_walkers=2)


def test_a_map_alone_is_drawn_no_doors(settings: LaunchSettings) -> None:
    bare = replace(settings, site=settings.home, domain="random", seed=7)
    assert choose_domain(bare) == draw_domain(7, declared=False)


def test_metal_has_no_domain(settings: LaunchSettings) -> None:
    robot = RobotDescription()
    drive = robot.drive.model_copy(update={"kind": "serial"})
    metal = robot.model_copy(update={"drive": drive})
    with pytest.raises(ConfigError, match="simulator alone") as refused:
        keep_domain(replace(settings, domain="random"), metal)
    assert refused.value.code == "domain_on_metal"


def test_simulator_and_camera_are_handed_the_same_file(settings: LaunchSettings) -> None:
    robot = RobotDescription.model_validate({"camera": {"kind": "sim"}})
    found = children(replace(settings, domain="d.toml", seed=7), robot)
    told = {child.name: " ".join(child.arguments) for child in found}
    assert told["sim"].endswith("--domain d.toml --seed 7")
    assert told["camera"].endswith("--domain d.toml")
    assert not any("--domain" in told[name] for name in ("bridge", "planner", "localization"))


def test_the_command_takes_both_words() -> None:
    given = parser().parse_args(["up", "--domain", "random", "--seed", "4"])
    assert (given.domain, given.seed) == ("random", 4)
