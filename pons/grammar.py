"""Own the grammar of the command ``pons``: its words, their options and their help.

Standard library alone, for ``pons stop`` passes by here.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from pons.command_help import HELP, exit_table
from pons.command_parser import CommandParser, add_command

if TYPE_CHECKING:
    Words = argparse._SubParsersAction[CommandParser]  # noqa: SLF001  # it has no public name

FLEET = "fleet"
MCP = "mcp"
MOCK_LLM = "mock-llm"
EVAL = "eval"
SITE = "site"
MAP = "map"
ROBOT = "robot"
NAV2 = "nav2"
SKILL = "skill"
APART = (EVAL, FLEET, MCP, MOCK_LLM, SITE, MAP, ROBOT, NAV2, SKILL)
"""They read their own words."""
OPERATOR = ("arm", "disarm", "estop", "reset")
"""Acts of an operator."""
LONGEST_FAULT_S = 3600.0
PEOPLES_ROLES = ("operator", "viewer", "dispatcher", "agent")
GOAL_STATES = (
    "queued", "planning", "needs_clarification", "awaiting_confirmation", "running", "paused",
    "succeeded", "failed", "cancelled", "refused",
)  # fmt: skip


def parser() -> CommandParser:
    """Return the whole grammar of the command."""
    top = CommandParser(
        prog="pons",
        description="A sentence moves the robot. `pons COMMAND --help` says more of each command.",
        epilog=f'examples:\n  pons up\n  pons say "go home"\n  pons stop\n\n{exit_table()}',
    )
    top.add_argument("--version", action="store_true", help="print version and commit")
    words = top.add_subparsers(
        dest="word", required=True, metavar="COMMAND", parser_class=CommandParser
    )
    _launch(words)
    _saying(words)
    _history(words)
    for word in ("stop", "estop", "disarm", "status", "why"):
        add_command(words, word).add_argument("--json", action="store_true", help="as JSON")
    for word in ("cancel", "pause", "resume"):
        add_command(words, word).add_argument("goal", nargs="?", metavar="GOAL", help="its id")
    for word in ("arm", "reset", "tls", "mqtt"):
        add_command(words, word)
    _showing(words)
    _doctor(words)
    _calibrate(words)
    wrote = add_command(words, "replies")
    wrote.add_argument("goal", nargs="?", metavar="GOAL", help="the newest unless named")
    add_command(words, "key").add_argument("act", choices=("new",))
    brakes = _of_robot(add_command(words, "braking"))
    brakes.add_argument("act", nargs="?", choices=("forget",), help="after a repair, bridge down")
    fenced = add_command(words, "fence")
    fenced.add_argument("act", choices=("show", "propose", "accept", "reject"))
    fenced.add_argument("what", nargs="?", help="a file to propose, or a proposal's id")
    fenced.add_argument("--json", action="store_true", help="as JSON")
    for add in (_places, _people):
        add(words)
    kept = add_command(words, "orders")
    kept.add_argument("act", nargs="?", default="list",
                      choices=("list", "add", "show", "pause", "resume", "skip",
                               "remove", "export", "import"))  # fmt: skip
    kept.add_argument("words", nargs="*", help="the order as a sentence, or an id; skip: and a day")
    kept.add_argument("--json", action="store_true", help="as JSON")
    broken = _of_robot(add_command(words, "fault"))
    broken.add_argument("names", nargs="*", metavar="NAME", help="an unknown one lists them all")
    broken.add_argument("--for", dest="seconds", type=_seconds, help="mend it after so long [s]")
    _replay(words)
    _detect(words)
    _helping(words)
    for name in APART:
        add_command(words, name, reads_own=True)
    return top


def _of_robot(word: CommandParser) -> CommandParser:
    word.add_argument(
        "--robot", type=Path, metavar="FILE", help="robot.toml, or a preset's name (PONS_ROBOT)"
    )
    return word


def _showing(words: Words) -> None:
    kept = add_command(words, "record")
    kept.add_argument("act", choices=("export",), help="write a rosbag2 (MCAP) for ROS 2's tools")
    kept.add_argument("files", nargs="+", type=Path, metavar="FILE", help="recordings of one run")
    kept.add_argument("--to", type=Path, metavar="FOLDER", help="beside the first, unless named")
    kept.add_argument("--json", action="store_true", help="as JSON")
    shown = add_command(words, "foxglove")
    shown.add_argument("act", nargs="?", choices=("layout",), help="print the window's layout")
    shown.add_argument("--port", type=int, default=8765, help="of the loopback: 8765")


def _helping(words: Words) -> None:
    shells = ("bash", "zsh", "fish")
    add_command(words, "completion").add_argument("shell", choices=shells)
    add_command(words, "help").add_argument("about", nargs="?", choices=(*HELP, "exit-codes"))


def _launch(words: Words) -> None:
    started = _of_robot(add_command(words, "up"))
    started.add_argument("-d", "--detach", action="store_true", help="run on in the background")
    started.add_argument("--site", type=Path, help="folder or name of a site (PONS_SITE)")
    started.add_argument("--port", help="port of page and API (PONS_PORT)")
    started.add_argument("--tls", action="store_true", help="serve https (PONS_TLS=1); docs/tls.md")
    started.add_argument(
        "--metal", type=Path, metavar="FILE", help="a robot.toml that the simulated robot obeys, "
        "where --robot is to be wrong about it"
    )  # fmt: skip
    started.add_argument("--domain", metavar="random|FILE", help="make the simulated home worse")
    started.add_argument("--seed", type=int, help="of --domain, and of the simulator's noise")
    started.add_argument("--twin", action="store_true", help="play base and lidar of robot.toml")
    started.add_argument("--twin-firmware", type=Path, metavar="BUILD", help="docs/firmware.md")
    started.add_argument("--map", dest="mapping", metavar="NAME", help="map a home by driving")
    started.add_argument("--set-up", action="store_true", help="try the robot again, at the page")
    started.add_argument("--no-planner", action="store_true", help="leave it to another brain")
    add_command(words, "down")
    shown = add_command(words, "logs")
    shown.add_argument("name", nargs="*", metavar="PROCESS", help="as bridge; all unless named")
    shown.add_argument("-f", "--follow", action="store_true", help="go on showing")
    shown.add_argument("-n", "--lines", type=int, default=20, metavar="N", help="of each: 20")
    add_command(words, "open")


def _saying(words: Words) -> None:
    said = add_command(words, "say")
    said.add_argument("text", nargs="*", help="the sentence")
    said.add_argument("--wav", type=Path, metavar="FILE", help="a recording in its place (English)")
    said.add_argument("--no-wait", action="store_true", help="return when the goal is accepted")
    said.add_argument("--replace", action="store_true", help="forget the running goal")
    said.add_argument("--json", action="store_true", help="the goal as JSON, nothing else")
    sent = add_command(words, "go")
    sent.add_argument(
        "where", nargs="+", metavar="PLACE | X Y [HEADING]", help="name, or m and deg"
    )
    sent.add_argument("--map", metavar="ID", help="the map that the point is on; else the robot's")
    sent.add_argument("--no-wait", action="store_true", help="return when the goal is accepted")
    sent.add_argument("--replace", action="store_true", help="forget the running goal")
    sent.add_argument("--json", action="store_true", help="the goal as JSON, nothing else")
    tried = add_command(words, "rehearse")
    tried.add_argument("text", nargs="*", help="the sentence; it is not given")
    tried.add_argument("--goal", metavar="GOAL", help="a goal's plan, by its id, in its place")
    tried.add_argument(
        "--drive", action="store_true", help="drive it in the simulator; some seconds"
    )
    tried.add_argument("--json", action="store_true", help="as JSON")
    told = add_command(words, "answer")
    told.add_argument("words", nargs="+", metavar="[GOAL] TEXT", help="its id first, where several")
    told.add_argument("--no-wait", action="store_true", help="return when the answer is taken")
    agreed = add_command(words, "confirm")
    agreed.add_argument("goal", nargs="?", metavar="GOAL", help="its id")
    agreed.add_argument("--no-wait", action="store_true", help="return when the yes is taken")


def _history(words: Words) -> None:
    listed = add_command(words, "goals")
    listed.add_argument("goal", nargs="?", metavar="GOAL", help="all of this one, by its id")
    listed.add_argument("--day", metavar="YYYY-MM-DD", help="of one day, by this machine's clock")
    listed.add_argument("--state", choices=GOAL_STATES, help="in this state")
    listed.add_argument("--search", metavar="WORDS", help="whose sentence holds these words")
    listed.add_argument("--most", type=int, default=20, metavar="N", help="20 unless given")
    listed.add_argument("--html", type=Path, metavar="FILE", help="write GOAL as one page to share")
    listed.add_argument("--json", action="store_true", help="as JSON")
    told = add_command(words, "log")
    told.add_argument("-f", "--follow", action="store_true", help="go on, as it happens")
    told.add_argument("--json", action="store_true", help="an object a line")


def _doctor(words: Words) -> None:
    seen = _of_robot(add_command(words, "doctor"))
    seen.add_argument("--json", action="store_true", help="as JSON")
    seen.add_argument("--jitter", action="store_true", help="measure a 100 Hz loop for 5 s")
    seen.add_argument(
        "--model",
        nargs="?",
        const="",
        metavar="NAME@URL",
        help="examine a model for a minute: the owner's, or NAME, URL or NAME@URL",
    )
    seen.add_argument("--yes", action="store_true", help="with --model: spend without asking")


def _replay(words: Words) -> None:
    again = add_command(words, "replay")
    again.add_argument("files", nargs="+", metavar="FILE", help="in order, where they are one run")
    again.add_argument(
        "--with-model",
        metavar="NAME@URL",
        help="FILE is a journal (missions.db) or a home folder: think its sentences again",
    )
    again.add_argument("--most", type=int, default=50, metavar="N", help="the newest sentences")
    again.add_argument("--json", action="store_true", help="with --with-model")
    again.add_argument("--yes", action="store_true", help="with --with-model: do not ask")


def _detect(words: Words) -> None:
    word = add_command(words, "detect")
    word.add_argument("images", nargs="+", type=Path, metavar="IMAGE", help="JPEG or PNG")
    word.add_argument("--model", type=Path, metavar="FILE", help="ONNX, in place of the owner's")
    word.add_argument("--labels", type=Path, metavar="FILE", help="its class names, one a line")
    word.add_argument("--decoder", help="how its output is read, in place of what is found out")
    word.add_argument("--json", action="store_true", help="as JSON")
    word.add_argument("--out", type=Path, metavar="FILE", help="write the picture with its boxes")


def _places(words: Words) -> None:
    word = add_command(words, "places")
    word.add_argument(
        "act", nargs="?", choices=("list", "export", "remember", "forget"), default="list"
    )
    word.add_argument("name", nargs="?", help="its name")
    word.add_argument("--zh", metavar="NAME", help="its Chinese name, beside or alone")
    word.add_argument("--json", action="store_true", help="as JSON")


def _people(words: Words) -> None:
    word = add_command(words, "people")
    word.add_argument("act", nargs="?", choices=("list", "add", "remove", "pair"), default="list")
    word.add_argument("name", nargs="?", help="whom to add (a name), or to remove (an id)")
    word.add_argument("--role", choices=PEOPLES_ROLES, default="operator")
    word.add_argument("--json", action="store_true", help="as JSON")


def _calibrate(words: Words) -> None:
    word = _of_robot(add_command(words, "calibrate"))
    word.add_argument("--reference", choices=("truth", "lidar"), help="what distances compare with")
    word.add_argument(
        "--measured-m",
        type=float,
        nargs="*",
        metavar="M",
        help="a person measures each run by tape; without numbers it asks after each",
    )
    word.add_argument(
        "--track", action="store_true", help="only the track that counts in turns, by the gyro"
    )
    word.add_argument("--shuttles", type=int, default=3, choices=range(2, 11), metavar="N",
                      help="so many times to and fro: 3")  # fmt: skip
    word.add_argument(
        "--patience", type=_seconds, default=30.0, metavar="S", help="wait so long to be armed"
    )
    word.add_argument("--yes", action="store_true", help="write without asking")


def _seconds(text: str) -> float:
    """Read how long. Raises ArgumentTypeError."""
    try:
        seconds = float(text)
    except ValueError:
        seconds = -1.0
    if not 0.0 < seconds <= LONGEST_FAULT_S:
        raise argparse.ArgumentTypeError(f"{text!r}; expected 0 to {LONGEST_FAULT_S:.0f} seconds")
    return seconds
