"""Lead an owner from an empty folder to a robot that knows its rooms, one next act at a time.

What is done is seen from what is there: a robot.toml of this home, its trial, a map of its own,
rooms on it. What was found and chosen before that lies in ``wizard.json``, so that a page that is
closed, or another one, goes on at the same step. Ports are looked at, and robot.toml is written, by
``pons robot`` in a process of its own, as a map is saved by ``pons map``: this one loads nothing
for it.
"""

from __future__ import annotations

import asyncio
import json
import logging
import os
import re
import shutil
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from pons_assets import DEFAULT_SITE, SITES
from processes.parent_death import child_command

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable
    from pathlib import Path

    from planner.site import KnownPlaces
    from wire import RobotDescription

log = logging.getLogger(__name__)

KEPT, OWN_ROBOT, OWN_SITES, CANVASES = "wizard.json", "robot.toml", "sites", "mapping"
STEPS = ("look", "choose", "measure", "try", "map", "rooms")
LOOK_LIMIT_S = 40.0
"""All ports are listened at side by side; a slow board needs some ten seconds."""
SAVE_LIMIT_S = 300.0
"""A large home's loops are settled once more, and its rooms are cut; a small computer is slow."""
MIN_FREE_BYTES = 200 * 1024 * 1024
"""As much as a start of everything asks for (pons/launch_checks.py)."""
_CODE = re.compile(r"[a-z][a-z0-9_]{2,39}")
MEASURED = ("wheel_radius_m", "wheel_separation_m", "radius_m")


class WizardRefusal(Exception):
    """A step can't be done now; ``code`` is stable."""

    def __init__(self, code: str, detail: str, unnamed: str = "wizard_unwritten") -> None:
        """Keep the code beside the words; ``unnamed`` names a sentence for codes without one."""
        super().__init__(f"{code}: {detail}")
        self.code, self.detail, self.unnamed = code, detail, unnamed


@dataclass(frozen=True, slots=True)
class CommandResult:
    """Hold what a command has said."""

    status: int
    out: str
    error: str


class SetupWizard:
    """Be the wizard of one home."""

    def __init__(
        self,
        home: Path,
        robot: RobotDescription,
        site: Path,
        places: Callable[[], KnownPlaces],
        *,
        robot_file: Path | None = None,
        run: Callable[..., Awaitable[CommandResult]] | None = None,
    ) -> None:
        """Take what this planner was started with.

        Args:
            home: where robot.toml is written.
            robot: in use.
            site: in use.
            places: returns the places that are known now.
            robot_file: of the robot in use; None: the home's own.
            run: runs ``pons`` with words; the tests' own.
        """
        self._home, self._robot, self._site, self._places = home, robot, site, places
        self._robot_file, self._run = robot_file, run or self._run_pons
        self._presets: list[dict[str, Any]] | None = None
        self._working = asyncio.Lock()

    async def view(self) -> dict[str, Any]:
        """Return the steps, those that are done, the next one and what it needs."""
        kept = self._read()
        done = self._list_done(kept)
        step = next((each for each in STEPS if each not in done), None)
        needs_presets = step in ("choose", "measure")
        return {
            "steps": STEPS,
            "done": done,
            "step": step,
            "ports": kept.get("ports"),
            "preset": kept.get("preset"),
            "presets": await self._list_presets(kept) if needs_presets else None,
            "is_written": self._has_own_robot,
            "mapping": self.mapping,
        }

    async def look(self) -> None:
        """Find out what is plugged in; nothing moves.

        Raises:
            WizardRefusal: ``wizard_busy``, ``wizard_look``.
        """
        result = await self._at_once("robot", "find", "--json")
        try:
            found = json.loads(result.out)
        except ValueError:
            raise WizardRefusal("wizard_look", result.error.strip()[:200]) from None
        self._keep(ports=[*map(_port, found["ports"]), *map(_camera, found["cameras"])])

    async def choose(self, preset: str) -> None:
        """Remember a preset.

        Raises:
            WizardRefusal: ``preset_unknown``.
        """
        known = [each["name"] for each in await self._list_presets(self._read())]
        if preset not in known:
            raise WizardRefusal("preset_unknown", f"{preset[:60]!r}; known: {', '.join(known)}")
        self._keep(preset=preset)

    async def measure(self, name: str, base: dict[str, float]) -> None:
        """Write this home's robot.toml of the chosen preset, what was measured and what was found.

        Raises:
            WizardRefusal: ``wizard_unchosen``, or the code of ``pons robot new``.
        """
        kept = self._read()
        preset = kept.get("preset")
        if preset is None:
            raise WizardRefusal("wizard_unchosen", "choose a preset first")
        values = [f"base.{key}={base[key]!r}" for key in MEASURED]
        values += [f'{part}.port="{path}"' for part, path in self._found_ports(kept, preset)]
        words = [word for value in values for word in ("--set", value)]
        result = await self._at_once("robot", "new", name, "--from", preset, *words)
        if result.status != 0:
            code, _, detail = result.error.strip().partition(": ")
            raise WizardRefusal(code[:40] or "wizard_unwritten", detail[:200])

    @property
    def mapping(self) -> str | None:
        """Return the name of the map that is being made; None where none is."""
        return self._site.name if self._site.parent == self._home / CANVASES else None

    def check_may_map(self) -> None:
        """Hold that a map of this home can be begun.

        Raises:
            WizardRefusal: ``mapping_already``, ``map_no_lidar``, ``site_exists``, ``disk_full``,
                ``site_unwritable``.
        """
        if self.mapping is not None:
            raise WizardRefusal("mapping_already", self.mapping)
        if self._robot.lidar.is_simulated and not self._robot.drive.virtual:
            raise WizardRefusal("map_no_lidar", "robot.toml has no [lidar]")
        if (self._home / OWN_SITES / DEFAULT_SITE.name).exists():
            raise WizardRefusal("site_exists", DEFAULT_SITE.name)
        try:
            (self._home / CANVASES).mkdir(exist_ok=True)
        except OSError as error:
            raise WizardRefusal("site_unwritable", str(error)) from None
        free = shutil.disk_usage(self._home).free
        if not free >= MIN_FREE_BYTES:
            raise WizardRefusal("disk_full", f"{free} bytes are free, {MIN_FREE_BYTES} are needed")

    async def save_map(self) -> None:
        """Make a site of the map that grows, as ``pons map`` does: whole, or nothing of it.

        Raises:
            WizardRefusal: ``not_mapping``, ``wizard_busy``, or the code of ``pons map``.
        """
        if self.mapping is None:
            raise WizardRefusal("not_mapping", "no map is being made")
        site = self._home / OWN_SITES / self.mapping
        if site.exists():
            raise WizardRefusal("site_exists", self.mapping)
        result = await self._at_once("map", self.mapping, limit_s=SAVE_LIMIT_S)
        if site.is_dir():  # it is written last and whole; names alone may have had no room
            return
        told = result.error.strip().removeprefix("refused: ")
        code, _, detail = told.partition(": ")
        if _CODE.fullmatch(code) is None:
            code, detail = "map_unsaved", told
        raise WizardRefusal(code, detail[:200], "map_unsaved")

    @property
    def _has_own_robot(self) -> bool:
        return (self._home / OWN_ROBOT).is_file()

    def _list_done(self, kept: dict[str, Any]) -> list[str]:
        own, robot = self._has_own_robot, self._robot
        has_map = self.mapping is None and (
            self._site.parent != SITES
            or any((self._home / OWN_SITES).glob("[!.]*/map.yaml"))  # hidden: half written
        )
        is_ready = not robot.drive.virtual and (robot.ros2 is not None or robot.valid_trial)
        reached = {
            "look": own or kept.get("ports") is not None,
            "choose": own or kept.get("preset") is not None,
            "measure": own,
            "try": own and bool(is_ready),
            "map": own and has_map,
            "rooms": own and has_map and any(p.kind == "room" for p in self._places().places),
        }
        return [step for step in STEPS if reached[step]]

    async def _list_presets(self, kept: dict[str, Any]) -> list[dict[str, Any]]:
        """Return the presets, those first whose parts were found."""
        if self._presets is None:
            result = await self._run("robot", "presets", "--json")
            self._presets = [
                each for each in json.loads(result.out)["presets"] if each["name"] != "demo"
            ]
        kinds = {port["kind"] for port in kept.get("ports") or () if port["kind"]}
        fits = [{**each, "fits": len(kinds & {each["drive"], each["lidar"]})}
                for each in self._presets]  # fmt: skip
        return sorted(fits, key=lambda each: -each["fits"])

    def _found_ports(self, kept: dict[str, Any], preset: str) -> list[tuple[str, str]]:
        """Return where the parts of a preset were found."""
        wanted = next((each for each in self._presets or () if each["name"] == preset), {})
        ports = kept.get("ports") or ()
        return [
            (part, port["lasting"])
            for part in ("drive", "lidar")
            for port in ports
            if port["part"] == part and port["kind"] == wanted.get(part)
        ]

    async def _at_once(self, *words: str, limit_s: float = LOOK_LIMIT_S) -> CommandResult:
        """Run a command, if none runs."""
        if self._working.locked():
            raise WizardRefusal("wizard_busy", "another page does this now")
        async with self._working:
            return await self._run(*words, limit_s=limit_s)

    async def _run_pons(self, *words: str, limit_s: float = LOOK_LIMIT_S) -> CommandResult:
        environment = {**os.environ, "PONS_HOME": str(self._home)}
        if words[0] == "map" and self._robot_file is not None:
            environment["PONS_ROBOT"] = str(self._robot_file)  # whose lidar has seen the map
        process = await asyncio.create_subprocess_exec(
            *child_command("pons", *words), env=environment,
            stdin=asyncio.subprocess.DEVNULL, stdout=asyncio.subprocess.PIPE,
            stderr=asyncio.subprocess.PIPE,
        )  # fmt: skip
        try:
            out, error = await asyncio.wait_for(process.communicate(), limit_s)
        except TimeoutError:
            process.kill()
            await process.wait()
            code = "map_unsaved" if words[0] == "map" else "wizard_look"
            raise WizardRefusal(code, f"no end within {limit_s:.0f} s") from None
        return CommandResult(process.returncode or 0, out.decode(), error.decode(errors="replace"))

    def _read(self) -> dict[str, Any]:
        try:
            kept = json.loads((self._home / KEPT).read_text("utf-8"))
        except (OSError, ValueError):
            return {}
        return kept if isinstance(kept, dict) else {}

    def _keep(self, **more: object) -> None:
        beside = self._home / f".{KEPT}.new"
        beside.write_text(json.dumps({**self._read(), **more}, ensure_ascii=False), "utf-8")
        beside.replace(self._home / KEPT)


def _port(found: dict[str, Any]) -> dict[str, Any]:
    answer = found["answer"]
    return {
        "path": found["path"],
        "lasting": found["lasting"],
        "part": found["part"],
        "kind": found["kind"],
        "code": found["code"],
        "device": "" if answer is None else f"{found['part']} {found['kind']}: {answer['words']}",
        "cure": None if answer is not None or not found["message"]["en"] else found["message"],
    }


def _camera(found: dict[str, Any]) -> dict[str, Any]:
    return {
        "path": found["path"], "lasting": found["lasting"], "part": "camera", "kind": "uvc",
        "code": found["code"], "device": f"camera: {found['name']}", "cure": None,
    }  # fmt: skip
