"""Be the command ``pons``: read the words, load only what they need, return an exit status."""

from __future__ import annotations

import os
import select
import sys
from dataclasses import replace
from importlib import import_module
from typing import TYPE_CHECKING

from pons.settings import (
    BadSetting,
    LaunchSettings,
    is_robot_named,
    load,
    port_of,
    robot_of,
    site_of,
)
from pons_assets import IS_INSTALLED, needs_checkout

if TYPE_CHECKING:
    import argparse

EXIT_USAGE = 2
_FOLLOW = frozenset({
    "say", "answer", "confirm", "cancel", "pause", "resume", "places", "orders", "replies", "why",
    "arm", "reset", "people", "goals", "log", "open", "down", "logs", "skill",
    "go", "rehearse",
})  # fmt: skip
"""Words to a robot that runs: in a folder without one, this user's only one is meant."""
EXIT_UNREAD = 141
"""As a shell tells of a program that SIGPIPE ended: 128 + 13."""


def main(arguments: list[str] | None = None) -> int:
    """Run one command."""
    words = sys.argv[1:] if arguments is None else arguments
    try:
        status = _run_command(words)
        sys.stdout.flush()
        return status
    except BrokenPipeError:
        if not _reader_is_gone():
            raise
        return EXIT_UNREAD
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


def _reader_is_gone() -> bool:
    """Return whether nobody reads the output any more (``pons status | head``), and drop the rest.

    Linux tells it of a pipe by POLLERR; a pipe of another kind that broke leaves the output alone.
    """
    poll = select.poll()
    poll.register(sys.stdout.fileno(), 0)  # errors are told unasked
    if not any(told & select.POLLERR for _, told in poll.poll(0)):
        return False
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # the exit flushes once more
    return True


def _run_command(words: list[str]) -> int:
    """Run one command; what it refuses is raised."""
    if words[:1] in (["stop"], ["estop"], ["disarm"]) and words[1:] in ([], ["--json"]):
        from pons import stop  # before argparse: nothing may slow this down

        as_json = len(words) > 1
        stop.leave(stop.run(load(forgiving=True), words[0], as_json=as_json))  # type: ignore[arg-type]  # one of them
    if words in (["--version"], ["version"]):
        from pons_assets.version import version_line

        print(version_line())
        return 0
    from pons.grammar import parser  # after an order to stop

    settings = load(starts=words[:1] == ["up"])
    if words and words[0] in _FOLLOW and not is_robot_named():
        from pons.running import of_this_user

        settings = of_this_user(settings)
    status = _run_apart(settings, *words) if words else None
    return _dispatch(settings, parser().parse_args(words), words) if status is None else status


def _run_apart(settings: LaunchSettings, word: str, *more: str) -> int | None:
    """Run a command that reads its own words, and whose imports are not for the others."""
    from pons import grammar

    words = list(more)
    if word == grammar.MOCK_LLM:
        from pons.mock_llm.command import main as mock_llm

        return mock_llm(words)
    if word in (grammar.MCP, grammar.FLEET):
        from pons import extras

        run = extras.serve_mcp if word == grammar.MCP else extras.become_fleet
        return run(settings, words)
    if word == grammar.EVAL:
        from pons.evals.command import main as evaluate

        return evaluate(settings, words)
    if word == grammar.SITE:
        from pons import site

        return site.run(settings, words)
    if word == grammar.MAP:
        from pons import mapping

        return mapping.run(settings, words)
    if word == grammar.ROBOT:
        from pons import robot

        return robot.run(settings, words)
    if word == grammar.SKILL:
        from pons import skill_command

        return skill_command.run(settings, words)
    if word == grammar.NAV2:
        from ros2.nav2 import main as nav2

        return nav2(["--robot", str(settings.robot), "--home", str(settings.home), *words])
    return None


def _describe_refusal(wrong: Exception) -> str | None:
    """Return what a person is told of a robot.toml or a port that can't be used; None of a bug."""
    from pons.launch_words import chinese_line  # late: `pons stop` needs neither
    from wire import ConfigError

    if not isinstance(wrong, ConfigError):
        return None
    return f"{wrong}{chinese_line(str(wrong))}"


def _dispatch(settings: LaunchSettings, said: argparse.Namespace, words: list[str]) -> int:
    if said.word == "up":
        return _bring_up(settings, said, words)
    if said.word in ("down", "logs", "open"):
        return _background(settings, said)
    if said.word in ("help", "completion"):
        return _help(said)
    if (given := getattr(said, "robot", None)) is not None:
        settings = replace(settings, robot=robot_of(str(given), settings.home))
    elif not os.environ.get("PONS_ROBOT"):
        from pons.running import of_running

        settings = of_running(settings)
    if said.word in _TOOLS:
        return _tool(settings, said)
    from pons.grammar import OPERATOR

    if said.word in OPERATOR or said.word == "status":
        from pons import operator

        if said.word == "status":
            return operator.status(settings, as_json=said.json)
        return operator.ask(settings, said.word)
    return _goal(settings, said)


def _goal(settings: LaunchSettings, said: argparse.Namespace) -> int:
    """Give a goal, answer one, or act on one."""
    from pons import goals

    if said.word == "say":
        if bool(said.text) == (said.wav is not None):
            code = "two_orders" if said.text else "no_order"
            raise BadSetting(f"{code}: give a sentence, or a recording with --wav FILE")
        told = said.wav or " ".join(said.text)
        wait = not said.no_wait
        return goals.say(settings, told, wait=wait, replace=said.replace, as_json=said.json)
    if said.word == "go":
        from pons import pointing

        return pointing.run(settings, said)
    if said.word == "rehearse":
        from pons import rehearse

        return rehearse.run(settings, said)
    if said.word == "answer":
        return goals.answer(settings, said.words, wait=not said.no_wait)
    if said.word == "confirm":
        return goals.confirm(settings, said.goal, wait=not said.no_wait)
    return goals.act(settings, said.word, said.goal)


def _bring_up(settings: LaunchSettings, said: argparse.Namespace, words: list[str]) -> int:
    if said.detach:
        from pons import background

        detached = [word for word in words if word not in ("-d", "--detach")]
        return background.start(settings, detached)
    from pons import launch

    port = port_of(said.port) if said.port is not None else None
    site = None if said.site is None else site_of(str(said.site), settings.home)
    robot = None if said.robot is None else robot_of(str(said.robot), settings.home)
    given = {"site": site, "robot": robot, "port": port, "metal": said.metal}
    given |= {"domain": said.domain, "seed": said.seed}
    given |= {"twin": said.twin or said.twin_firmware is not None}
    given |= {"twin_firmware": said.twin_firmware}
    given |= {"mapping": said.mapping, "set_up": said.set_up}
    chosen = {name: value for name, value in given.items() if value is not None}
    chosen["tls"] = said.tls or settings.tls
    return launch.run(replace(settings, **chosen), planner=not said.no_planner)


def _background(settings: LaunchSettings, said: argparse.Namespace) -> int:
    from pons import background

    if said.word == "logs":
        return background.show_logs(settings, said.name, said.lines, follow=said.follow)
    return background.end(settings) if said.word == "down" else background.open_page(settings)


def _help(said: argparse.Namespace) -> int:
    if said.word == "completion":
        from pons import completion

        return completion.run(said.shell)
    if said.about == "exit-codes":
        from pons.command_help import exit_table

        print(exit_table())
        return 0
    return main([*([said.about] if said.about else []), "--help"])


_BARE_TOOLS = frozenset({"tls", "key", "mqtt"})
"""Modules of ours whose ``run`` takes the settings alone; only the one that is asked for loads."""
_PLANNERS = frozenset({"places", "people", "orders", "replies", "goals", "log"})
_TOOLS = _BARE_TOOLS | _PLANNERS | {
    "doctor", "why", "foxglove", "record", "braking", "fence", "calibrate", "fault", "replay",
    "detect",
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
    if said.word == "why":
        from pons import why

        return why.run(settings, as_json=said.json)
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

        return fence.run(settings, said.act, said.what, as_json=said.json)
    if said.word in _PLANNERS:
        return _ask_planner(settings, said)
    if said.word == "fault":
        from pons import fault

        return fault.run(settings, said.names, seconds=said.seconds)
    if said.word == "detect":
        from pons import detect

        return detect.run(settings, said)
    return _show(settings, said)


def _show(settings: LaunchSettings, said: argparse.Namespace) -> int:
    """Show the robot live, or a recording of it."""
    if said.word == "foxglove":
        from pons import foxglove

        return foxglove.run(settings, said.act, said.port)
    if said.word == "record":
        from pons import record

        return record.export(said.files, said.to, as_json=said.json)
    from pons import replay

    if said.with_model is not None:
        return replay.with_model(settings, said)
    return replay.run(said.files)


def _ask_planner(settings: LaunchSettings, said: argparse.Namespace) -> int:
    """Run a command that shows or changes what the planner keeps."""
    if said.word == "places":
        from pons import places

        return places.run(settings, said.act, said.name, chinese=said.zh, as_json=said.json)
    if said.word == "orders":
        from pons import orders

        return orders.run(settings, said.act, said.words, as_json=said.json)
    if said.word == "people":
        from pons import people

        return people.run(settings, said.act, said.name, role=said.role, as_json=said.json)
    if said.word in ("goals", "log"):
        from pons import history

        return history.run(settings, said) if said.word == "goals" else history.log(settings, said)
    from pons import replies

    return replies.run(settings, said.goal)


if __name__ == "__main__":
    sys.exit(main())
