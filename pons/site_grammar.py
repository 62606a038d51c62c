"""Hold the grammar of ``pons site``: its acts, their words and examples."""

from __future__ import annotations

import argparse
from pathlib import Path

from pons.command_parser import CommandParser


def parser() -> argparse.ArgumentParser:
    """Return the grammar of ``pons site``."""
    top = CommandParser(
        prog="pons site",
        description="Make a site of a map, name its rooms, check it. Works on folders and needs no "
        "running robot; one that runs takes a changed site at its next start.",
        examples=["pons site import map.yaml attic", "pons site check attic"],
    )
    acts = top.add_subparsers(dest="act", required=True, metavar="ACT", parser_class=CommandParser)
    what = "make a site of a Nav2 map, or of a picture"
    example = "pons site import map.yaml attic --start 0 0 90"
    made = acts.add_parser("import", help=what, description=what, examples=[example])
    made.add_argument(
        "map", help="map.yaml, a PGM or PNG with --resolution, or ros2:/map of a ROS 2 robot"
    )
    made.add_argument("name", help="of the site: small letters, digits, _")
    made.add_argument("--resolution", type=float, metavar="M", help="of a picture: metres a pixel")
    made.add_argument(
        "--origin", type=float, nargs=3, default=(0.0, 0.0, 0.0), metavar=("X_M", "Y_M", "YAW_DEG"),
        help="of a picture: its lower left corner in map",
    )  # fmt: skip
    made.add_argument("--start", type=float, nargs=3, metavar=("X_M", "Y_M", "YAW_DEG"))
    made.add_argument(
        "--unknown", choices=("unknown", "free"), help="what grey 205 is where the file frees it"
    )
    _add_masks(made)
    _with_json(acts, "list", "list the sites", "pons site list --json")
    for act, what in (
        ("rooms", "show the rooms that are proposed, with and without a name"),
        ("check", "say what is wrong with a site"),
    ):
        shown = _with_json(acts, act, what, f"pons site {act} attic")
        shown.add_argument("name", help="a site, by name or folder")
    what, example = (
        "accept a proposed room under a name",
        "pons site name attic room_1 study --zh 书房",
    )
    named = acts.add_parser("name", help=what, description=what, examples=[example])
    named.add_argument("name", help="a site, by name or folder")
    named.add_argument("room", help="room_1 and so on, as `pons site rooms` shows them")
    named.add_argument("english", help="what people call it")
    named.add_argument("--zh", metavar="NAME", help="its Chinese name")
    what, example = (
        "print the site's fence with masks joined to it",
        "pons site masks attic --keepout k.yaml",
    )
    masked = acts.add_parser("masks", help=what, description=what, examples=[example])
    masked.add_argument("name", help="a site, by name or folder")
    _add_masks(masked)
    return top


def _with_json(
    acts: argparse._SubParsersAction[CommandParser],  # it has no public name
    act: str,
    what: str,
    example: str,
) -> CommandParser:
    made = acts.add_parser(act, help=what, description=what, examples=[example])
    made.add_argument("--json", action="store_true", help="as JSON")
    return made


def _add_masks(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--keepout", type=Path, metavar="YAML", help="a Nav2 keep-out mask")
    parser.add_argument("--speed", type=Path, metavar="YAML", help="a Nav2 speed mask")
    parser.add_argument("--speed-kind", choices=("percent", "mps"), default="percent")
    parser.add_argument("--speed-base", type=float, default=100.0)
    parser.add_argument("--speed-multiplier", type=float, default=-1.0)
