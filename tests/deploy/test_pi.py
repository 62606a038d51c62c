"""The one command of a small computer puts everything in its place, or refuses and says why."""

from __future__ import annotations

import os
import shutil
import subprocess
import venv
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.deploy.installed import ROOT, UNITS

INSTALL = ROOT / "deploy" / "pi" / "install.sh"
PRESET = ROOT / "robots" / "pons_mcu_ld19.toml"
REFUSED = 3
AARCH64 = ("manylinux_2_17_aarch64", "manylinux2014_aarch64", "manylinux_2_28_aarch64")


def install(*words: str, path: str | None = None) -> subprocess.CompletedProcess[str]:
    """Run the installer as a person does."""
    environment = dict(os.environ) | ({"PATH": path} if path else {})
    return subprocess.run(
        ["bash", str(INSTALL), *words],
        capture_output=True,
        text=True,
        check=False,
        timeout=150,
        env=environment,
    )


@pytest.fixture(scope="module")
def staged(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with all files of a robot that is a preset in the two-room site."""
    folder = tmp_path_factory.mktemp("staged")
    site = ROOT / "sites" / "two_room"
    done = install("--stage", str(folder), "--robot", str(PRESET), "--site", str(site))
    assert done.returncode == 0, done.stderr
    return folder


def test_every_unit_is_installed_and_names_the_robots_own_site(staged: Path) -> None:
    units = staged / "etc" / "systemd" / "system"
    ours = {path.name for path in UNITS.iterdir() if path.suffix in (".service", ".target")}
    assert {path.name for path in units.iterdir()} == ours
    for path in units.glob("*.service"):
        text = path.read_text()
        assert "/etc/pons/sites/home" not in text, path.name
        assert ("--site /etc/pons/sites/two_room" in text) == ("--site" in text)


def test_users_folders_rights_and_port_rules_are_installed(staged: Path) -> None:
    etc = staged / "etc"
    assert (etc / "sysusers.d/pons.conf").read_text() == (UNITS / "pons.sysusers.conf").read_text()
    assert (etc / "tmpfiles.d/pons.conf").read_text() == (UNITS / "pons.tmpfiles.conf").read_text()
    assert "@pons - rtprio 70" in (etc / "security/limits.d/pons.conf").read_text()
    rules = (etc / "udev/rules.d/70-pons.rules").read_text()
    assert rules == (ROOT / "deploy/pi/70-pons.rules").read_text()


def test_the_program_is_copied_as_it_is_tracked(staged: Path) -> None:
    program = staged / "opt" / "pons"
    assert (program / "bridge" / "__main__.py").is_file()
    assert (program / "requirements.lock").is_file()
    assert not (program / ".venv").exists()
    assert not (program / ".pons").exists()
    assert not (program / ".git").exists()


def test_robot_and_site_are_kept_unless_another_is_named(tmp_path: Path) -> None:
    robot = tmp_path / "etc" / "pons" / "robot.toml"
    robot.parent.mkdir(parents=True)
    robot.write_text("# mine\n")
    assert install("--stage", str(tmp_path)).returncode == 0
    assert robot.read_text() == "# mine\n"
    assert (robot.parent / "sites" / "home" / "map.yaml").is_file()
    assert install("--stage", str(tmp_path), "--robot", str(PRESET)).returncode == 0
    assert robot.read_text() == PRESET.read_text()
    (old,) = robot.parent.glob("robot.toml.before-*")
    assert old.read_text() == "# mine\n"


def test_an_update_keeps_the_site_that_the_units_name(tmp_path: Path) -> None:
    attic = tmp_path / "attic"
    shutil.copytree(ROOT / "sites" / "two_room", attic)
    stage = tmp_path / "stage"
    assert install("--stage", str(stage), "--site", str(attic)).returncode == 0
    units = stage / "etc" / "systemd" / "system"
    before = {path.name: path.read_text() for path in units.iterdir()}
    assert "/etc/pons/sites/attic" in before["pons-bridge.service"]
    assert install("--stage", str(stage)).returncode == 0
    assert {path.name: path.read_text() for path in units.iterdir()} == before


@pytest.mark.parametrize(
    ("words", "code", "says"),
    [
        (("--robot", "/nowhere.toml"), "robot_missing", "pons_mcu.toml"),
        (("--site", "/nowhere"), "site_missing", "two_room"),
        (("--robot",), "value_missing", "--robot"),
        (("--fast",), "option_unknown", "--fast"),
    ],
)
def test_a_wrong_word_is_refused_in_both_languages(
    words: tuple[str, ...], code: str, says: str, tmp_path: Path
) -> None:
    done = install("--stage", str(tmp_path), *words)
    assert done.returncode == REFUSED
    first, second, *_ = done.stderr.splitlines()
    assert first.startswith(f"refused: {code}: ")
    assert says in done.stderr
    assert any(ord(letter) > 0x2E80 for letter in second)
    assert not (tmp_path / "etc").exists(), "nothing is put anywhere"


@pytest.mark.parametrize(
    ("command", "answer", "code"),
    [
        ("uname", "armv7l", "machine_unsupported"),
        ("getconf", "32", "system_32_bit"),
        ("df", "Filesystem 1M-blocks Used Available\n/dev/x 100 90 10 90% /", "disk_full"),
    ],
)
def test_a_computer_that_cannot_is_refused(
    command: str, answer: str, code: str, tmp_path: Path
) -> None:
    fake = tmp_path / "bin" / command
    fake.parent.mkdir()
    shown = answer.replace("1M-blocks Used Available", "1M-blocks Used Avail")
    fake.write_text(f"#!/bin/sh\ncat <<'E'\n{shown}\nE\n")
    fake.chmod(0o755)
    done = install("--stage", str(tmp_path / "s"), path=f"{fake.parent}:{os.environ['PATH']}")
    assert done.returncode == REFUSED
    assert done.stderr.startswith(f"refused: {code}: ")


def test_the_bridge_may_open_a_base_at_a_serial_port() -> None:
    assert "SupplementaryGroups=dialout" in (UNITS / "pons-bridge.service").read_text()


def test_udev_takes_the_rules() -> None:
    found = shutil.which("udevadm")
    if found is None:
        pytest.skip("no udevadm here")
    rules = ROOT / "deploy" / "pi" / "70-pons.rules"
    done = subprocess.run(
        [found, "verify", str(rules)], capture_output=True, text=True, check=False, timeout=30
    )
    if "Unknown" in done.stderr or "unrecognized" in done.stderr:
        pytest.skip("this udevadm can't verify")
    assert done.returncode == 0, done.stdout + done.stderr


PYTHONS = ("3.11", "3.13")
"""Raspberry Pi OS 12 brings Python 3.11, 13 brings 3.13."""
LACKS = ("No matching distribution", "DO NOT MATCH THE HASHES")
"""What pip says where the index answers, and has no such wheel or another than was locked."""


@pytest.fixture(scope="module")
def asked(
    tmp_path_factory: pytest.TempPathFactory,
) -> Iterator[dict[str, subprocess.Popen[str]]]:
    """Ask the index for the wheels of each Python at once: most of it is waiting for bytes."""
    folder = tmp_path_factory.mktemp("wheels")
    venv.create(folder / "v", with_pip=True)
    platforms = [word for name in AARCH64 for word in ("--platform", name)]
    asked = {
        version: subprocess.Popen(
            [
                str(folder / "v" / "bin" / "python"), "-m", "pip", "install", "--dry-run",
                "--no-deps", "--require-hashes", "--only-binary=:all:", "--implementation", "cp",
                "--python-version", version, "--target", str(folder / version), *platforms,
                "-r", str(ROOT / "requirements.lock"),
            ],
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
        )
        for version in PYTHONS
    }  # fmt: skip
    yield asked
    for asking in asked.values():
        asking.kill()
        asking.communicate()


@pytest.mark.nightly
@pytest.mark.e2e
@pytest.mark.timeout(150)
@pytest.mark.parametrize("version", PYTHONS)
def test_every_locked_package_has_a_wheel_for_arm(
    version: str, asked: dict[str, subprocess.Popen[str]]
) -> None:
    """Nothing is compiled on a small computer."""
    asking = asked[version]
    _, said = asking.communicate(timeout=110)
    if asking.returncode and not any(lack in said for lack in LACKS):
        pytest.skip(f"no package index answers: {said.strip().splitlines()[-1][:200]}")
    assert asking.returncode == 0, said[-2000:]
