"""Be the command ``pons``: read the words, load only what they need, return an exit status."""

from __future__ import annotations

import argparse
import os
import sys
from dataclasses import replace
from importlib import import_module
from pathlib import Path

from pons.settings import BadSetting, LaunchSettings, load, port_of, site_of
from pons_assets import IS_INSTALLED, needs_checkout

EXIT_USAGE = 2
MOCK_LLM = "mock-llm"
CONFORMANCE = "conformance"
EVAL = "eval"
SITE = "site"
MAP = "map"
ROBOT = "robot"
NAV2 = "nav2"
_APART = {
    CONFORMANCE: "play broken brains at a simulated bridge",
    EVAL: "score what a brain plans, on sentences",
    MOCK_LLM: "serve a model that is none, with faults",
    SITE: "make a site of a map, name its rooms, check it",
    MAP: "make a site of a drive, or mend the map of one",
    ROBOT: "find out what is plugged in, for robot.toml",
    NAV2: "let Nav2 drive through the bridge, in the planner's place",
}
"""They read their own words."""
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
    for kind, what in _OPERATOR.items():
        words.add_parser(kind, help=what)
    _doctor(words)
    _calibrate(words)
    words.add_parser("why", help="explain the last stop: row, evidence, what to do")
    keyed = words.add_parser("key", help="make the key by which the bridge knows its operator")
    keyed.add_argument("act", choices=("new",))
    brakes = words.add_parser("braking", help="show what stops have taught of the brakes")
    brakes.add_argument("act", nargs="?", choices=("forget",), help="after a repair, bridge down")
    fenced = words.add_parser("fence", help="show, propose, accept or reject a fence")
    fenced.add_argument("act", choices=("show", "propose", "accept", "reject"))
    fenced.add_argument("what", nargs="?", help="a file to propose, or a proposal's id")
    _places(words)
    kept = words.add_parser("orders", help="list standing orders, add, show, pause, remove one")
    kept.add_argument("act", nargs="?", default="list",
                      choices=("list", "add", "show", "pause", "resume", "remove"))  # fmt: skip
    kept.add_argument("words", nargs="*", help="the order as a sentence, or an id")
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
    again.add_argument("--drives", type=int, default=3, metavar="N", help="plans to drive, of new")
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


def _places(words: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    word = words.add_parser("places", help="list the places, remember one here, forget one")
    word.add_argument(
        "act", nargs="?", choices=("list", "export", "remember", "forget"), default="list"
    )
    word.add_argument("name", nargs="?", help="its name")
    word.add_argument("--zh", metavar="NAME", help="its Chinese name, beside or alone")


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


_OPERATOR = {
    "arm": "power the drive, standing",
    "disarm": "ramp to zero, then torque off",
    "estop": "protective stop, latched until reset",
    "reset": "leave a latched state; never moves the robot",
}


def main(arguments: list[str] | None = None) -> int:
    """Run one command."""
    words = sys.argv[1:] if arguments is None else arguments
    try:
        return _run_command(words)
    except BadSetting as wrong:
        print(wrong, file=sys.stderr)
        return EXIT_USAGE
    except ModuleNotFoundError as missing:
        if not IS_INSTALLED or not (missing.name or "").startswith("tools"):
            raise
        print(needs_checkout(f"pons {words[0]}"), file=sys.stderr)
        return EXIT_USAGE
    except Exception as wrong:
        refusal = _describe_refusal(wrong)
        if refusal is None:
            raise
        print(refusal, file=sys.stderr)
        return EXIT_USAGE


def _run_command(words: list[str]) -> int:
    """Run one command; what it refuses is raised."""
    if words == ["stop"]:  # before argparse: nothing may slow this down
        from pons import stop

        return stop.run(load(forgiving=True))
    settings = load()
    if words[:1] == [MOCK_LLM]:  # reads its own words; its web server is not for the others
        from pons.mock_llm.command import main as mock_llm

        return mock_llm(words[1:])
    if words[:1] == [CONFORMANCE]:  # likewise; it starts a robot of its own
        from pons.conformance import main as conformance

        return conformance(settings, words[1:])
    if words[:1] == [EVAL]:  # likewise; it starts nothing
        from pons.evals.command import main as evaluate

        return evaluate(settings, words[1:])
    if words[:1] == [SITE]:  # likewise
        from pons import site

        return site.run(settings, words[1:])
    if words[:1] == [MAP]:  # likewise
        from pons import mapping

        return mapping.run(settings, words[1:])
    if words[:1] == [ROBOT]:  # likewise
        from pons import robot

        return robot.run(settings, words[1:])
    if words[:1] == [NAV2]:  # likewise
        from ros2.nav2 import main as nav2

        given = ["--robot", str(settings.robot), "--home", str(settings.home)]
        return nav2([*given, *words[1:]])
    return _dispatch(settings, parser().parse_args(words))


def _describe_refusal(wrong: Exception) -> str | None:
    """Return what a person is told of a robot.toml or a port that can't be used; None of a bug."""
    from pons.launch_words import chinese_cure  # late: `pons stop` needs neither
    from wire import ConfigError

    if not isinstance(wrong, ConfigError):
        return None
    cure = chinese_cure(str(wrong))
    return f"{wrong}" if cure is None else f"{wrong}\n  {cure}"


def _dispatch(settings: LaunchSettings, said: argparse.Namespace) -> int:
    if said.word == "up":
        from pons import up

        port = port_of(said.port) if said.port is not None else None
        site = None if said.site is None else site_of(str(said.site), settings.home)
        given = {"site": site, "robot": said.robot, "port": port, "metal": said.metal}
        given |= {"domain": said.domain, "seed": said.seed}
        given |= {"twin": said.twin or said.twin_firmware is not None}
        given |= {"twin_firmware": said.twin_firmware}
        given |= {"mapping": said.mapping, "set_up": said.set_up}
        chosen = {name: value for name, value in given.items() if value is not None}
        chosen["tls"] = said.tls or os.environ.get("PONS_TLS") == "1"  # not what ran here before
        return up.run(replace(settings, **chosen), planner=not said.no_planner)
    if said.word in _TOOLS:
        return _tool(settings, said)
    if said.word in _OPERATOR or said.word == "status":
        from pons import operator

        if said.word == "status":
            return operator.status(settings, as_json=said.json)
        return operator.ask(settings, said.word)
    from pons import goals

    if said.word == "say" and said.wav is not None:
        if said.text:
            raise BadSetting("two_orders: give a sentence or --wav FILE, not both")
        wait = not said.no_wait
        return goals.say_wav(settings, said.wav, wait=wait, replace=said.replace)
    if said.word == "say":
        if not said.text:
            raise BadSetting("no_order: give a sentence, or a recording with --wav FILE")
        text = " ".join(said.text)
        return goals.say(settings, text, wait=not said.no_wait, replace=said.replace)
    if said.word == "answer":
        return goals.answer(settings, said.words, wait=not said.no_wait)
    if said.word == "confirm":
        return goals.confirm(settings, said.goal, wait=not said.no_wait)
    return goals.act(settings, said.word, said.goal)


_BARE_TOOLS = frozenset({"tls", "why", "key"})
"""Modules of ours whose ``run`` takes the settings alone; only the one that is asked for loads."""
_TOOLS = _BARE_TOOLS | {
    "doctor", "braking", "fence", "places", "orders", "calibrate", "fault", "replay", "detect",
}  # fmt: skip


def _tool(settings: LaunchSettings, said: argparse.Namespace) -> int:
    """Run a tool that looks at the robot, or works on it, without the planner."""
    if said.word == "doctor":
        from pons import doctor

        if said.model is not None:
            from pons.evals import quick

            return quick.run(settings, said.model, as_json=said.json, yes=said.yes)
        return doctor.run(settings, as_json=said.json, jitter=said.jitter)
    if said.word in _BARE_TOOLS:
        code: int = import_module(f"pons.{said.word}").run(settings)
        return code
    if said.word == "braking":
        from pons import braking

        return braking.run(settings, forget=said.act == "forget")
    if said.word == "calibrate":
        from pons import calibrate

        return calibrate.run(
            settings,
            reference=said.reference,
            measured_m=said.measured_m,
            shuttles=said.shuttles, patience_s=said.patience, yes=said.yes, track=said.track,
        )  # fmt: skip
    if said.word == "fence":
        from pons import fence

        return fence.run(settings, said.act, said.what)
    if said.word == "places":
        from pons import places

        return places.run(settings, said.act, said.name, chinese=said.zh)
    if said.word == "orders":
        from pons import orders

        return orders.run(settings, said.act, said.words, as_json=said.json)
    if said.word == "fault":
        from pons import fault

        return fault.run(settings, said.names, seconds=said.seconds)
    if said.word == "detect":
        from pons import detect

        return detect.run(settings, said)
    from pons import replay

    if said.with_model is not None:
        return replay.with_model(settings, said)
    return replay.run(said.files)


if __name__ == "__main__":
    sys.exit(main())
