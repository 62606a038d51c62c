"""Name every serial port, what answers on it, and every camera; print a part of robot.toml.

``pons robot find [--port PATH] [--json]`` listens, and asks only what moves nothing, turns nothing
and changes no setting. Needs no running robot; a port that a running one holds is named busy.
``pons robot try [--robot FILE]`` turns the wheels, off the ground (docs/robot-try.md).
``pons robot node FOLDER`` writes the package that a robot of ROS 2 runs, ``pons robot mount``
prints where its lidar sits (docs/ros2.md).
"""

from __future__ import annotations

import argparse
import json
import sys
from dataclasses import asdict, replace
from pathlib import Path
from shutil import copytree, ignore_patterns
from typing import TYPE_CHECKING, Any, Final

from devices.camera_listing import list_cameras
from devices.port_listing import describe_port, find_port_takers, list_ports
from pons.command_parser import CommandParser
from pons.command_words import load_words
from pons.robot.port_finder import question_ports
from pons.settings import robot_of
from pons.terminal import pick
from pons_assets import ROS2_NODE
from wire import load_robot

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from devices.camera_listing import CameraEntry
    from devices.port_listing import SerialPortEntry
    from pons.robot.port_finder import PortFinding
    from pons.settings import LaunchSettings

EXIT_FOUND, EXIT_NOTHING, EXIT_REFUSED = 0, 1, 3
ZENOH: Final = "eclipse-zenoh>=1.10,<1.11"
HEAD: Final = "# for robot.toml:"
CODES: Final = load_words("pons.robot")["ports"]
"""What is said of a port, in English and Chinese; ``detail`` is the finding's."""
RELAY_GONE: Final = (
    (
        "relay_gone: it is a part of pons_ros2 now: `pons robot node FOLDER` writes that "
        "(docs/ros2.md)"
    ),
    (
        "relay_gone: 中继节点现在是 pons_ros2 软件包的一部分：请用 `pons robot node FOLDER` 写出"
        "（docs/ros2.md）"
    ),
)
_TAKERS: Final = {
    "brltty": "port_brltty",
    "gpsd": "port_gpsd",
    "ModemManager": "port_modem_manager",
}
_FORBIDDEN_TO_ALL: Final = (
    "no group of users may open it: install deploy/pi/70-pons.rules; in a container add --device",
    "没有任何用户组有权打开：请安装 deploy/pi/70-pons.rules；在容器中请加 --device",
)


def parser() -> argparse.ArgumentParser:
    """Return the grammar of ``pons robot``."""
    top = CommandParser(
        prog="pons robot",
        description="Choose a preset for your robot, find what is plugged in, try it with its "
        "wheels off the ground.",
        examples=["pons robot presets", "pons robot new rover --from waveshare_ugv_rover",
                  "pons robot find", "pons robot try"],
    )  # fmt: skip
    acts = top.add_subparsers(dest="act", required=True, metavar="ACT", parser_class=CommandParser)

    def act(name: str, what: str, example: str) -> CommandParser:
        return acts.add_parser(name, help=what, description=what, examples=[example])

    listed = act("presets", "list the robots that come with Pons", "pons robot presets --json")
    listed.add_argument("--json", action="store_true", help="as JSON")
    what = "write a preset down as this home's robot.toml, used by default from then on"
    made = act("new", what, "pons robot new rover --from waveshare_ugv_rover")
    made.add_argument("name", metavar="NAME", help="the robot's id: small letters, digits, _ and -")
    made.add_argument("--from", dest="preset", required=True, metavar="PRESET",
                      help="as `pons robot presets` lists it")  # fmt: skip
    made.add_argument("--set", dest="values", action="append", default=[], metavar="KEY=VALUE",
                      help="what was measured or found: base.wheel_radius_m=0.033")  # fmt: skip
    what = "name each serial port and what answers on it, moving nothing"
    find = act("find", what, "pons robot find --port /dev/ttyUSB0")
    find.add_argument(
        "--port", type=Path, action="append", metavar="PATH", help="this one alone, or several"
    )
    find.add_argument("--json", action="store_true", help="as JSON")
    what = "turn the wheels, off the ground, and prove that they stop"
    tried = act("try", what, "pons robot try --robot robot.toml")
    what = "write the ROS 2 package that a robot runs into a new folder"
    node = act("node", what, "pons robot node ~/ros2_ws/src/pons_ros2")
    node.add_argument("folder", type=Path, metavar="FOLDER", help="~/ros2_ws/src/pons_ros2")
    what = "print where a ROS 2 robot's lidar sits, by its /tf_static"
    for of_robot in (tried, act("mount", what, "pons robot mount --robot ros2_diff_drive")):
        of_robot.add_argument(
            "--robot", type=Path, metavar="FILE", help="robot.toml, or a preset's name (PONS_ROBOT)"
        )
    return top


def _write_node(folder: Path) -> int:
    """Copy the package; refuse where the folder is there already or can't be written."""
    try:
        copytree(ROS2_NODE, folder, ignore=ignore_patterns("__pycache__"))
    except OSError as error:
        cure = pick("name a new folder", "请指定一个尚不存在的文件夹")
        print(f"node_not_written: {folder}: {error.strerror or error}; {cure}", file=sys.stderr)
        return EXIT_REFUSED
    print(f"{folder}: on the robot there `colcon build`, `pip install '{ZENOH}'`, and")
    print("ros2 launch pons_ros2 pons.launch.py (docs/ros2.md)")
    return EXIT_FOUND


def run(settings: LaunchSettings, words: list[str]) -> int:
    """Be ``pons robot``; 0 where a device was recognised or all was proved, 1 where none was."""
    if words[:1] == ["relay"]:
        print(pick(*RELAY_GONE), file=sys.stderr)
        return EXIT_REFUSED
    said = parser().parse_args(words)
    if said.act in ("presets", "new"):
        from pons.robot import presets

        if said.act == "presets":
            return presets.list_presets(as_json=said.json)
        return presets.write_new(settings, said.name, said.preset, said.values)
    if said.act in ("try", "mount") and said.robot is not None:
        settings = replace(settings, robot=robot_of(str(said.robot), settings.home))
    if said.act == "try":
        from pons.robot.trial_command import run_trial

        return run_trial(settings)
    if said.act == "node":
        return _write_node(said.folder)
    if said.act == "mount":
        from pons.ros2_robot import print_mounting

        return print_mounting(load_robot(settings.robot))
    entries = [describe_port(path) for path in said.port] if said.port else list_ports()
    if not said.json and entries:
        names = ", ".join(str(entry.path) for entry in entries)
        print(f"listening at {names} …", file=sys.stderr, flush=True)
    found = question_ports(entries)
    cameras = [] if said.port else list_cameras()
    takers = find_port_takers()
    if said.json:
        content = {
            "ports": [_record(one) for one in found],
            "port_takers": takers,
            "cameras": [_camera_record(one) for one in cameras],
        }
        print(json.dumps(content, ensure_ascii=False, indent=1))
    else:
        lines = list(describe(found, takers))
        lines += describe_cameras(cameras)
        parts = list(robot_part(found))
        head = [] if parts or not cameras else ["", HEAD]
        print("\n".join([*lines, *parts, *head, *camera_part(cameras)]))
    return EXIT_FOUND if cameras or any(one.answer for one in found) else EXIT_NOTHING


def describe(found: Sequence[PortFinding], takers: Sequence[str] = ()) -> Iterator[str]:
    """Yield the lines about ports, for a terminal."""
    if not found:
        yield from _explain("port_none")
    for one in found:
        yield f"{one.entry.path}  {adapter_words(one.entry)}"
        if one.answer is not None:
            yield f"  {one.part} {one.kind}, {one.baud} baud: {printable(one.answer.words)}"
        else:
            yield from _explain(one.code, one.detail)
        if one.entry.twins:
            yield from _explain("port_twins", ", ".join(map(str, one.entry.twins)))
    for taker in takers:
        yield from _explain(_TAKERS[taker])


def robot_part(found: Sequence[PortFinding]) -> Iterator[str]:
    """Yield what robot.toml should say of what was found; a part that stands twice is commented."""
    seen: set[str] = set()
    for one in found:
        if one.answer is None:
            continue
        again = "# " if one.part in seen else ""
        if not seen:
            yield ""
            yield HEAD
        if again:
            yield f"# a second {one.part}; robot.toml has one:"
        seen.add(one.part)
        keys = {"kind": one.kind, "port": str(one.entry.lasting), **one.answer.keys}
        yield f"{again}[{one.part}]"
        for key, value in keys.items():
            yield f"{again}{key} = {json.dumps(value)}"
        for key, where in one.answer.missing.items():
            yield f"# {key} =     # {where}"


def describe_cameras(cameras: Sequence[CameraEntry]) -> Iterator[str]:
    """Yield the lines about cameras, for a terminal."""
    for one in cameras:
        yield f"{one.path}  {printable(one.name)}"
        if one.is_permitted:
            yield f"  camera uvc: {one.lasting}"
        else:
            yield from _explain("camera_forbidden")


def camera_part(cameras: Sequence[CameraEntry]) -> Iterator[str]:
    """Yield what robot.toml should say of the cameras; all but the first are commented."""
    for number, one in enumerate(cameras):
        again = "# " if number else ""
        if number == 1:
            yield "# a second camera; robot.toml has one:"
        yield f"{again}[camera]"
        yield f'{again}kind = "uvc"'
        yield f"{again}device = {json.dumps(str(one.lasting))}"
        if not number:
            yield "# x_m, z_m, pitch_rad, fov_rad =     # where it sits, how wide it sees"


def _camera_record(one: CameraEntry) -> dict[str, Any]:
    return {
        "path": str(one.path),
        "lasting": str(one.lasting),
        "name": one.name,
        "code": "camera_found" if one.is_permitted else "camera_forbidden",
    }


def describe_code(code: str, detail: str) -> tuple[str, str]:
    """Return what a code of :data:`CODES` says to a person, in English and Chinese."""
    if code == "port_forbidden" and not detail:
        return _FORBIDDEN_TO_ALL
    english, chinese = CODES[code]
    shown = printable(detail)
    return english.format(detail=shown), chinese.format(detail=shown)


def _explain(code: str, detail: str = "") -> Iterator[str]:
    yield f"  {code}: {pick(*describe_code(code, detail))}"


def adapter_words(entry: SerialPortEntry) -> str:
    """Return what the adapter calls itself."""
    usb = entry.usb
    if usb is None:
        return entry.driver
    named = " ".join(filter(None, (usb.maker, usb.name)))
    serial = f", serial {usb.serial}" if usb.serial else ""
    return printable(f"usb {usb.vendor}:{usb.product} {named}{serial}")


def printable(text: str) -> str:
    """Return what a device said of itself without what would move a terminal's cursor."""
    return "".join(letter if letter.isprintable() else "?" for letter in text)


def _record(one: PortFinding) -> dict[str, Any]:
    """Return a finding as JSON can hold it."""
    english, chinese = describe_code(one.code, one.detail) if one.code in CODES else ("", "")
    answer = None
    if one.answer is not None:
        answer = {
            "words": one.answer.words,
            "keys": dict(one.answer.keys),
            "missing": dict(one.answer.missing),
        }
    usb = one.entry.usb
    return {
        "path": str(one.entry.path),
        "lasting": str(one.entry.lasting),
        "usb": None if usb is None else asdict(usb),
        "code": one.code,
        "detail": one.detail,
        "message": {"en": english, "zh": chinese},
        "part": one.part or None,
        "kind": one.kind or None,
        "baud": one.baud or None,
        "answer": answer,
        "twins": [str(path) for path in one.entry.twins],
    }
