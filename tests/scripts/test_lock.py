"""Hold the lock files to their promises: complete, hashed, and naming no place on the network."""

from __future__ import annotations

import re
import tomllib
from importlib.metadata import packages_distributions
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

LOCKS = ("requirements.lock", "requirements-dev.lock", "requirements-attack.lock")
PIN = re.compile(r"^(?P<name>[a-z0-9._-]+)==(?P<version>\S+)(?P<marker> ;.*?)? \\$")
IMPORT = re.compile(r"^\s*(?:import|from) ([a-zA-Z0-9_]+)", re.MULTILINE)
HASH = re.compile(r"^    --hash=sha256:[0-9a-f]{64}( \\)?$")


def pins(path: Path) -> dict[str, list[str]]:
    """Return each pinned name with its versions (one per Python range)."""
    found: dict[str, list[str]] = {}
    for line in path.read_text().splitlines():
        if match := PIN.match(line):
            found.setdefault(canonicalize_name(match["name"]), []).append(match["version"])
    return found


def wanted(repository: Path, *extras: str) -> list[Requirement]:
    """Return what pyproject.toml asks for, with the named extras."""
    project = tomllib.loads((repository / "pyproject.toml").read_text())["project"]
    lines = list(project["dependencies"])
    for extra in extras:
        lines += project["optional-dependencies"][extra]
    return [Requirement(line) for line in lines]


@pytest.mark.parametrize("name", LOCKS)
def test_every_line_is_a_pin_or_a_hash(repository: Path, name: str) -> None:
    lines = (repository / name).read_text().splitlines()
    strange = [line for line in lines if not PIN.match(line) and not HASH.match(line)]
    assert not strange, "a lock names packages and hashes only: no address, option or local path"


@pytest.mark.parametrize("name", LOCKS)
def test_every_pin_has_hashes(repository: Path, name: str) -> None:
    lines = (repository / name).read_text().splitlines()
    bare = [
        line
        for line, after in zip(lines, [*lines[1:], ""], strict=True)
        if PIN.match(line) and not HASH.match(after)
    ]
    assert not bare


@pytest.mark.parametrize(
    ("name", "extras"),
    [
        ("requirements.lock", ("install",)),
        ("requirements-dev.lock", ("install", "dev")),
        ("requirements-attack.lock", ("install", "attack")),
        ("requirements-extras.lock", ("install", "mcp", "mqtt", "foxglove", "traces", "fleet")),
    ],
)
def test_lock_satisfies_pyproject(repository: Path, name: str, extras: tuple[str, ...]) -> None:
    locked = pins(repository / name)
    unmet = [
        str(requirement)
        for requirement in wanted(repository, *extras)
        if not (any if requirement.marker else all)(  # a marker may split one name into two pins
            requirement.specifier.contains(version)
            for version in locked.get(canonicalize_name(requirement.name), ["0"])
        )
    ]
    assert not unmet, "pyproject.toml asks for what the lock does not have: run `make lock`"


def test_development_runs_on_the_versions_that_users_get(repository: Path) -> None:
    runtime, dev, _ = (pins(repository / name) for name in LOCKS)
    assert {name: dev.get(name) for name in runtime} == runtime


def test_the_extra_of_the_wheel_pins_what_the_lock_pins(repository: Path) -> None:
    project = tomllib.loads((repository / "pyproject.toml").read_text())["project"]
    extra = [Requirement(line) for line in project["optional-dependencies"]["locked"]]
    found: dict[str, list[str]] = {}
    for one in extra:
        found.setdefault(one.name, []).append(str(one.specifier).removeprefix("=="))
    locked = pins(repository / "requirements.lock")
    del locked["setuptools"]  # builds, and runs nothing
    assert found == locked
    asked = {canonicalize_name(one.name) for one in wanted(repository)}
    assert asked <= set(found), "a dependency that nothing pins"


EXTRAS = "requirements-extras.lock"
FOR_OTHERS = {
    "httptools": "uvicorn's parser",
    "tzdata": "zoneinfo's time zones, where the system has none",
    "uvloop": "uvicorn's loop",
    "websockets": "uvicorn's WebSocket",
}
"""What no file of ours imports, and the package that does."""
COME_ALONG = {"starlette", "pydantic-core", "pons", "pons-robot"}
"""What fastapi and pydantic are faces of, and ourselves."""
PARTS = (
    "processes",
    "devices",
    "pons_assets",
    "wire",
    "maps",
    "planner",
    "localization",
    "bridge",
    "sensors",
    "ros2",
    "sim",
    "lockstep",
    "pons",
)


def test_each_package_that_running_needs_is_imported_or_named_with_its_user(
    repository: Path,
) -> None:
    sources = (
        path.read_text("utf-8") for part in PARTS for path in (repository / part).rglob("*.py")
    )
    imported = {name for text in sources for name in IMPORT.findall(text)}
    by_import = packages_distributions()
    used = {canonicalize_name(one) for name in imported for one in by_import.get(name, [])}
    needed = {canonicalize_name(requirement.name) for requirement in wanted(repository)}
    # Of extras: their users say aloud that it is missing.
    # And setuptools builds the package for a robot of ROS 2, over there.
    used -= {"setuptools", "sherpa-onnx", "sherpa-onnx-core", *pins(repository / EXTRAS)} - needed
    # Of the extras mqtt, foxglove and traces, likewise; they name what they bring along, too.
    used -= {"aiomqtt", "paho-mqtt", "foxglove-sdk"}
    used -= {name for name in used if name.startswith("opentelemetry-")}
    assert needed - used == set(FOR_OTHERS) - used
    assert used - needed <= COME_ALONG, "imported, but pyproject.toml does not ask for it"


def test_attacks_run_on_the_versions_that_tests_have(repository: Path) -> None:
    _, dev, attack = (pins(repository / name) for name in LOCKS)
    assert {name: found for name, found in attack.items() if dev.get(name, found) != found} == {}
