"""Read what units and compose file start; move it from where it is installed to a test's place."""

from __future__ import annotations

import shlex
import sys
from pathlib import Path
from typing import Any

import yaml

ROOT = Path(__file__).resolve().parents[2]
UNITS = ROOT / "deploy" / "systemd"
PROCESSES = ("sim", "localization", "bridge", "planner", "camera")
PORT = "8420"

Unit = dict[str, dict[str, list[str]]]


def unit(path: Path) -> Unit:
    """Return a unit's sections; a key may stand more than once."""
    sections: Unit = {}
    here: dict[str, list[str]] = {}
    for line in path.read_text().splitlines():
        if not line or line.startswith(("#", ";")):
            continue
        if line.startswith("["):
            here = sections.setdefault(line.strip("[]"), {})
            continue
        name, found, value = line.partition("=")
        assert found, f"{path.name}: {line!r} is neither a section nor a setting"
        here.setdefault(name, []).append(value)
    return sections


def services() -> dict[str, Unit]:
    """Return our service units by the process they start."""
    return {name: unit(UNITS / f"pons-{name}.service") for name in PROCESSES}


def compose() -> dict[str, Any]:
    """Return the compose file, its anchors resolved."""
    content = yaml.safe_load((ROOT / "docker-compose.yml").read_text())
    assert isinstance(content, dict)
    return content


def by_units() -> dict[str, list[str]]:
    """Return the commands that the units start."""
    return {name: shlex.split(one["Service"]["ExecStart"][0]) for name, one in services().items()}


def by_compose() -> dict[str, list[str]]:
    """Return the commands that the profile sim starts."""
    described = compose()["services"]
    return {
        name: [*described[name].get("entrypoint", []), *described[name]["command"]]
        for name in PROCESSES
    }


def moved(command: list[str], home: Path, site: Path, port: int) -> list[str]:
    """Return a command as it stands, but for the places that a test can't have."""
    places = {
        "/opt/pons/.venv/bin/python": sys.executable,
        "python": sys.executable,
        "/opt/pons/deploy/with-token.sh": str(ROOT / "deploy" / "with-token.sh"),
        "/var/lib/pons": str(home),
        "/etc/pons/robot.toml": str(ROOT / "robot.toml"),
        "/etc/pons/sites/home": str(site),
        "/etc/pons/sites/${PONS_SITE_NAME:-home}": str(site),
        "0.0.0.0": "127.0.0.1",  # a container's own network; here the machine's
        PORT: str(port),
    }
    made = [places.get(word, word) for word in command]
    left = [word for word in made if word.startswith(("/opt/pons", "/etc/pons", "/var/lib/pons"))]
    assert not left, left
    return made


def weight_of(nice: int, ordinary: int) -> float:
    """Return the weight that is to others' what a nice is: each step is a quarter (sched(7))."""
    return ordinary * float(1.25**-nice)
