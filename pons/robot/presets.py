"""List the robots that come with Pons, and write one of them down as this home's own.

A preset is never written to: trials and calibrations go into the home's copy, which ``pons`` uses
by default from then on. So a checkout stays as it was pulled.
"""

from __future__ import annotations

import json
import re
import sys
import tempfile
import tomllib
from math import floor
from pathlib import Path
from typing import TYPE_CHECKING

from pons.settings import OWN_ROBOT
from pons.terminal import command_path, pick
from pons_assets import IS_INSTALLED, ROBOT_FILE, ROBOTS
from wire import ConfigError, RobotDescription, load_robot

if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import Any

    from pons.settings import LaunchSettings

EXIT_DONE, EXIT_MISSING, EXIT_REFUSED = 0, 2, 3
_ID_LINE = re.compile(r'^id = "[^"]*"', re.MULTILINE)
MEASURED = ("wheel_radius_m", "wheel_separation_m", "radius_m")
"""Keys of [base] that each build has of its own."""
SETTABLE = (*(f"base.{key}" for key in MEASURED), "drive.port", "lidar.port")
DEMO = "demo"
"""The name of the simulated robot of the demo home among presets."""


def is_shipped(path: Path) -> bool:
    """Return whether a robot.toml came with Pons, so that nothing may write to it."""
    return path.parent == ROBOTS or (IS_INSTALLED and path == ROBOT_FILE)


def list_presets(*, as_json: bool) -> int:
    """Print each preset with its first sentence; 0."""
    found = [(DEMO, ROBOT_FILE), *((path.stem, path) for path in sorted(ROBOTS.glob("*.toml")))]
    if as_json:
        content = {"presets": [{"name": name, **_record(path)} for name, path in found]}
        print(json.dumps(content, ensure_ascii=False, indent=1))
        return EXIT_DONE
    for name, path in found:
        print(f"{name:<24} {_sentence(path)}")
    print(f"{command_path()} robot new NAME --from PRESET")
    return EXIT_DONE


def _record(path: Path) -> dict[str, Any]:
    """Return what a program that offers presets shows of one."""
    robot = load_robot(path)
    return {
        "what": _sentence(path),
        "drive": robot.drive.kind,
        "lidar": robot.lidar.kind,
        "base": {key: getattr(robot.base, key) for key in MEASURED},
    }


def write_new(settings: LaunchSettings, name: str, preset: str, values: Sequence[str] = ()) -> int:
    """Write ``$PONS_HOME/robot.toml`` of a preset; 0 done, 2 no such preset, 3 refused.

    Args:
        settings: of the home.
        name: the robot's id.
        preset: as ``pons robot presets`` names it.
        values: of keys that are measured or found, as ``base.radius_m=0.2``.
    """
    source = ROBOT_FILE if preset == DEMO else ROBOTS / f"{preset}.toml"
    if not source.is_file():
        there = ", ".join([DEMO, *(path.stem for path in sorted(ROBOTS.glob("*.toml")))])
        told = pick(f"{preset} is no preset; there are", f"没有预设 {preset}；已有")
        print(f"preset_unknown: {told}: {there}", file=sys.stderr)
        return EXIT_MISSING
    target = settings.home / OWN_ROBOT
    text = _ID_LINE.sub(f'id = "{name}"', source.read_text("utf-8"), count=1)
    try:
        text = _with_values(text, values)
        with tempfile.TemporaryDirectory() as folder:
            tried = Path(folder) / OWN_ROBOT
            tried.write_text(text, "utf-8")
            load_robot(tried)
        settings.home.mkdir(mode=0o700, parents=True, exist_ok=True)
        with target.open("x", encoding="utf-8") as file:
            file.write(text)
    except ConfigError as wrong:
        code = wrong.code if values else "robot_name"
        print(f"{code}: {name!r}: {wrong.detail.splitlines()[0]}", file=sys.stderr)
        return EXIT_REFUSED
    except FileExistsError:
        told = pick("is there and stays; move it away first", "已存在，不会覆盖；请先移走")
        print(f"robot_exists: {target} {told}", file=sys.stderr)
        return EXIT_REFUSED
    except OSError as error:
        print(f"home_unwritable: {target}: {error.strerror}", file=sys.stderr)
        return EXIT_REFUSED
    pons = command_path()
    print(
        pick(f"wrote {target}: robot {name}, as {preset}", f"已写入 {target}：{name}（{preset}）")
    )
    print(pick("used from now on; next", "此后默认使用；下一步") + f": {pons} doctor, {pons} up")
    return EXIT_DONE


def _with_values(text: str, values: Sequence[str]) -> str:
    """Return a preset's text with values in place; comments stay.

    Raises:
        ConfigError: ``robot_value``: it is none of ``SETTABLE``.
    """
    if not values:
        return text
    import tomlkit  # a change alone needs it

    document: Any = tomlkit.parse(text)
    for given in values:
        key, _, value = given.partition("=")
        if key not in SETTABLE:
            known = ", ".join(SETTABLE)
            raise ConfigError("robot_value", f"{key!r} is set in the file itself; here: {known}")
        table, name = key.split(".")
        try:
            read = tomllib.loads(f"value = {value}")["value"]
        except tomllib.TOMLDecodeError:
            read = value
        document.setdefault(table, tomlkit.table())[name] = read
    limits = RobotDescription().limits.model_dump() | document.get("limits", {})
    radius_m = document.get("base", {}).get(
        "wheel_radius_m", RobotDescription().base.wheel_radius_m
    )
    reach_mps = floor(limits["max_wheel_radps"] * radius_m * 100) / 100
    if reach_mps < limits["max_speed_mps"]:  # wheels as small as these turn no faster
        document.setdefault("limits", tomlkit.table())["max_speed_mps"] = reach_mps
    return tomlkit.dumps(document)


def _sentence(path: Path) -> str:
    """Return the first sentence of the comment that a preset begins with."""
    lines = path.read_text("utf-8").splitlines()
    head = [line[2:] for line in lines[: next(i for i, x in enumerate(lines) if x[:1] != "#")]]
    return re.split(r"(?<=[a-z)])[.:] ", " ".join(head), maxsplit=1)[0].rstrip(".")
