"""List the robots that come with Pons, and write one of them down as this home's own.

A preset is never written to: trials and calibrations go into the home's copy, which ``pons`` uses
by default from then on. So a checkout stays as it was pulled.
"""

from __future__ import annotations

import json
import re
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from pons.settings import OWN_ROBOT
from pons.terminal import command_path, pick
from pons_assets import IS_INSTALLED, ROBOT_FILE, ROBOTS
from wire import ConfigError, load_robot

if TYPE_CHECKING:
    from pons.settings import LaunchSettings

EXIT_DONE, EXIT_MISSING, EXIT_REFUSED = 0, 2, 3
_ID_LINE = re.compile(r'^id = "[^"]*"', re.MULTILINE)
DEMO = "demo"
"""The name of the simulated robot of the demo home among presets."""


def is_shipped(path: Path) -> bool:
    """Return whether a robot.toml came with Pons, so that nothing may write to it."""
    return path.parent == ROBOTS or (IS_INSTALLED and path == ROBOT_FILE)


def list_presets(*, as_json: bool) -> int:
    """Print each preset with its first sentence; 0."""
    found = [(path.stem, _sentence(path)) for path in sorted(ROBOTS.glob("*.toml"))]
    found.insert(0, (DEMO, _sentence(ROBOT_FILE)))
    if as_json:
        content = {"presets": [{"name": name, "what": what} for name, what in found]}
        print(json.dumps(content, ensure_ascii=False, indent=1))
        return EXIT_DONE
    for name, what in found:
        print(f"{name:<24} {what}")
    print(f"{command_path()} robot new NAME --from PRESET")
    return EXIT_DONE


def write_new(settings: LaunchSettings, name: str, preset: str) -> int:
    """Write ``$PONS_HOME/robot.toml`` of a preset; 0 done, 2 no such preset, 3 refused."""
    source = ROBOT_FILE if preset == DEMO else ROBOTS / f"{preset}.toml"
    if not source.is_file():
        there = ", ".join([DEMO, *(path.stem for path in sorted(ROBOTS.glob("*.toml")))])
        told = pick(f"{preset} is no preset; there are", f"没有预设 {preset}；已有")
        print(f"preset_unknown: {told}: {there}", file=sys.stderr)
        return EXIT_MISSING
    target = settings.home / OWN_ROBOT
    text = _ID_LINE.sub(f'id = "{name}"', source.read_text("utf-8"), count=1)
    try:
        with tempfile.TemporaryDirectory() as folder:
            tried = Path(folder) / OWN_ROBOT
            tried.write_text(text, "utf-8")
            load_robot(tried)
        settings.home.mkdir(mode=0o700, parents=True, exist_ok=True)
        with target.open("x", encoding="utf-8") as file:
            file.write(text)
    except ConfigError as wrong:
        print(f"robot_name: {name!r}: {wrong.detail.splitlines()[0]}", file=sys.stderr)
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


def _sentence(path: Path) -> str:
    """Return the first sentence of the comment that a preset begins with."""
    lines = path.read_text("utf-8").splitlines()
    head = [line[2:] for line in lines[: next(i for i, x in enumerate(lines) if x[:1] != "#")]]
    return re.split(r"(?<=[a-z)])[.:] ", " ".join(head), maxsplit=1)[0].rstrip(".")
