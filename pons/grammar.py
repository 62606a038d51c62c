"""Own the grammar of the command ``pons``: its words, their options and their help.

Standard library alone, for ``pons stop`` passes by here.
"""

from __future__ import annotations

import argparse
from pathlib import Path

MOCK_LLM = "mock-llm"
EVAL = "eval"
SITE = "site"
MAP = "map"
ROBOT = "robot"
NAV2 = "nav2"
_APART = {
    EVAL: "score what a brain plans, on sentences",
    MOCK_LLM: "serve a model that is none, with faults",
    SITE: "make a site of a map, name its rooms, check it",
    MAP: "make a site of a drive, or mend the map of one",
    ROBOT: "find what is plugged in; try a robot, its wheels off the ground",
    NAV2: "let Nav2 drive through the bridge, in the planner's place",
}
"""They read their own words."""
OPERATOR = {
    "arm": "power the drive, standing",
    "disarm": "ramp to zero, then torque off",
    "estop": "protective stop, latched until reset",
    "reset": "leave a latched state; never moves the robot",
}
"""Acts of an operator."""
LONGEST_FAULT_S = 3600.0


def parser() -> argparse.ArgumentParser:
    """Return the whole grammar of the command."""
    top = argparse.ArgumentParser(prog="pons", description="A sentence moves the robot.")
    words = top.add_subparsers(dest="word", required=True, metavar="COMMAND")
    _launch(words)
    words.add_parser("tls", help="make or renew the certificate; say what devices must trust")
    _saying(words)
    words.add_parser("stop", help="stop now and hold, with or without a planner")
    shown = words.add_parser("status", help="show the robot and its goals")
    shown.add_argument("--json", action="store_true")
    for verb in ("cancel", "pause"):
        word = words.add_parser(verb, help=f"{verb} a goal: the running one unless named")
        word.add_argument("goal", nargs="?")
    word = words.add_parser("resume", help="resume the paused goal, or clear what is held")
    word.add_argument("goal", nargs="?")
    for kind, what in OPERATOR.items():
        words.add_parser(kind, help=what)
    _doctor(words)
    _calibrate(words)
    words.add_parser("why", help="explain the last stop: row, evidence, what to do")
    wrote = words.add_parser("replies", help="show what the model wrote about a goal, if kept")
    wrote.add_argument("goal", nargs="?", metavar="GOAL", help="the newest unless named")
    keyed = words.add_parser("key", help="make the key by which the bridge knows its operator")
    keyed.add_argument("act", choices=("new",))
    brakes = words.add_parser("braking", help="show what stops have taught of the brakes")
    brakes.add_argument("act", nargs="?", choices=("forget",), help="after a repair, bridge down")
    fenced = words.add_parser("fence", help="show, propose, accept or reject a fence")
    fenced.add_argument("act", choices=("show", "propose", "accept", "reject"))
    fenced.add_argument("what", nargs="?", help="a file to propose, or a proposal's id")
    _places_and_people(words)
    kept = words.add_parser("orders", help="list standing orders, add, show, pause, remove one")
    kept.add_argument("act", nargs="?", default="list",
                      choices=("list", "add", "show", "pause", "resume", "skip",
                               "remove", "export", "import"))  # fmt: skip
    kept.add_argument("words", nargs="*", help="the order as a sentence, or an id; skip: and a day")
    kept.add_argument("--json", action="store_true")
    broken = words.add_parser("fault", help="break the simulated robot; without a name, mend it")
    broken.add_argument("names", nargs="*", metavar="NAME", help="an unknown one lists them all")
    broken.add_argument("--for", dest="seconds", type=_seconds, help="mend it after so long [s]")
    _replay(words)
    _detect(words)
    for name, what in _APART.items():
        words.add_parser(name, help=f"{what}: {name} --help")
    return top


def _launch(words: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    started = words.add_parser("up", help="start simulator, localization, bridge and planner")
    started.add_argument("--site", type=Path, help="folder or name of a site (PONS_SITE)")
    started.add_argument("--robot", type=Path, help="robot.toml (PONS_ROBOT)")
    started.add_argument("--port", help="port of page and API (PONS_PORT)")
    started.add_argument("--tls", action="store_true", help="serve https (PONS_TLS=1); docs/tls.md")
    started.add_argument("--metal", type=Path, help="what the simulated robot is really like")
    started.add_argument("--domain", metavar="random|FILE", help="make the simulated home worse")
    started.add_argument("--seed", type=int, help="of --domain, and of the simulator's noise")
    started.add_argument("--twin", action="store_true", help="play base and lidar of robot.toml")
    started.add_argument("--twin-firmware", type=Path, metavar="BUILD", help="docs/firmware.md")
    started.add_argument("--map", dest="mapping", metavar="NAME", help="map a home by driving")
    started.add_argument("--set-up", action="store_true", help="try the robot again, at the page")
    started.add_argument("--no-planner", action="store_true", help="leave it to another brain")


def _saying(words: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    said = words.add_parser("say", help="give a goal, in English or Chinese, and follow it")
    said.add_argument("text", nargs="*", help="the sentence")
    said.add_argument("--wav", type=Path, metavar="FILE", help="a recording in its place (English)")
    said.add_argument("--no-wait", action="store_true", help="return when the goal is accepted")
    said.add_argument("--replace", action="store_true", help="forget the running goal")
    told = words.add_parser("answer", help="answer a goal's question: the one that asks, or named")
    told.add_argument("words", nargs="+", metavar="[GOAL] TEXT", help="its id first, where several")
    told.add_argument("--no-wait", action="store_true", help="return when the answer is taken")
    agreed = words.add_parser("confirm", help="say yes to the plan that waits for it, or named")
    agreed.add_argument("goal", nargs="?", metavar="GOAL")
    agreed.add_argument("--no-wait", action="store_true", help="return when the yes is taken")


def _doctor(words: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    seen = words.add_parser(
        "doctor",
        help="say what this machine lacks and how to mend it",
        description="Exit status: 0 all is well, 1 something works less well, 2 must be mended.",
    )
    seen.add_argument("--json", action="store_true")
    seen.add_argument("--jitter", action="store_true", help="measure a 100 Hz loop for 5 s")
    seen.add_argument(
        "--model",
        nargs="?",
        const="",
        metavar="NAME@URL",
        help="examine a model for a minute: the owner's, or NAME, URL or NAME@URL",
    )
    seen.add_argument("--yes", action="store_true", help="with --model: spend without asking")


def _replay(words: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    again = words.add_parser("replay", help="run a recording again and compare every command")
    again.add_argument("files", nargs="+", metavar="FILE", help="in order, where they are one run")
    again.add_argument(
        "--with-model",
        metavar="NAME@URL",
        help="FILE is a journal (missions.db) or a home folder: think its sentences again",
    )
    again.add_argument("--most", type=int, default=50, metavar="N", help="the newest sentences")
    again.add_argument("--json", action="store_true", help="with --with-model")
    again.add_argument("--yes", action="store_true", help="with --with-model: do not ask")


def _detect(words: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    word = words.add_parser("detect", help="try a detector on pictures: what it is, what it sees")
    word.add_argument("images", nargs="+", type=Path, metavar="IMAGE", help="JPEG or PNG")
    word.add_argument("--model", type=Path, metavar="FILE", help="ONNX, in place of the owner's")
    word.add_argument("--labels", type=Path, metavar="FILE", help="its class names, one a line")
    word.add_argument("--decoder", help="how its output is read, in place of what is found out")
    word.add_argument("--json", action="store_true")
    word.add_argument("--out", type=Path, metavar="FILE", help="write the picture with its boxes")


def _places_and_people(words: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    word = words.add_parser("places", help="list the places, remember one here, forget one")
    word.add_argument(
        "act", nargs="?", choices=("list", "export", "remember", "forget"), default="list"
    )
    word.add_argument("name", nargs="?", help="its name")
    word.add_argument("--zh", metavar="NAME", help="its Chinese name, beside or alone")
    people = words.add_parser("people", help="list who may use the robot, add or remove somebody")
    people.add_argument("act", nargs="?", choices=("list", "add", "remove"), default="list")
    people.add_argument("name", nargs="?", help="whom to add (a name), or to remove (an id)")
    people.add_argument("--role", choices=("operator", "viewer"), default="operator")
    people.add_argument("--json", action="store_true")


def _calibrate(words: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    word = words.add_parser("calibrate", help="drive on a clear floor, measure, write robot.toml")
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
    word.add_argument("--shuttles", type=int, default=3, choices=range(2, 11), metavar="N")
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
