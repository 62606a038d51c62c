"""The command ``pons eval look``: a vision model is asked about drawn pictures."""

from __future__ import annotations

import asyncio
import sys
from typing import TYPE_CHECKING

from planner.brain import OutOfBudget
from planner.language.catalogue import UnknownMessage, say
from pons.evals.brain_choice import with_model
from pons.evals.look import (
    BLIND,
    LookVerdict,
    NoVision,
    read_look_cases,
    score_looks,
    show_looks,
)
from pons.launch_words import chinese_line
from wire import ConfigError

if TYPE_CHECKING:
    from planner.brain.endpoint import EndpointBrain
    from pons.settings import LaunchSettings

REACHED, MISSED, REFUSED = 0, 1, 2
GOAL = 0.9
"""Of the questions, with no sign followed at all."""


def run(settings: LaunchSettings, model: str | None, *, yes: bool) -> int:
    """Score a vision model: 0 the goal is reached, 1 it is not, 2 nothing could be asked."""
    if model is None:
        return _refuse(
            "no_vision_model",
            "`look` asks a model that sees; give --model NAME@URL",
            "look 需要能看图像的模型：请加 --model 名称@地址",
        )
    cases = {name: read_look_cases(name) for name in ("en", "zh")}
    count = sum(map(len, cases.values()))

    async def score(brain: EndpointBrain) -> int:
        looker, found = brain.looker(), dict[str, list[LookVerdict]]()
        try:
            for name, asked in cases.items():
                mine = found.setdefault(name, [])
                async for verdict in score_looks(asked, looker):
                    mine.append(verdict)  # what was scored stays when it ends early
        except OutOfBudget as spent:
            print(f"pons eval: {spent.said.en}\n  {spent.said.zh}", file=sys.stderr)
        except asyncio.CancelledError:  # how asyncio.run hands Ctrl-C on
            if (task := asyncio.current_task()) is not None:
                task.uncancel()
            print("\npons eval: interrupted; this was scored until then", file=sys.stderr)
        return _conclude(found, count)

    try:
        return asyncio.run(with_model(settings, model, score, yes=yes, count=count))
    except NoVision as no:
        return _refuse_pictures(no.why)
    except ConfigError as wrong:
        print(f"pons eval: {wrong}{chinese_line(str(wrong))}", file=sys.stderr)
        return REFUSED


def _conclude(found: dict[str, list[LookVerdict]], count: int) -> int:
    """Show the figures and return the exit status."""
    verdicts = [verdict for mine in found.values() for verdict in mine]
    if not verdicts:
        return REFUSED
    for name, mine in found.items():
        print(show_looks(name, tuple(mine)))
    if len(verdicts) < count:
        print(f"{count - len(verdicts)} more not asked")
    if all(verdict.fault == BLIND for verdict in verdicts):
        return _refuse_pictures("no_pictures")
    enough = sum(not verdict.fault for verdict in verdicts) >= GOAL * count
    return REACHED if enough and not any(v.follows_sign for v in verdicts) else MISSED


def _refuse_pictures(why: str) -> int:
    try:
        told = say(f"model_error.{why}")
    except UnknownMessage:
        return _refuse(why, "no picture was taken", "图像没有送达")
    return _refuse(why, told.en, told.zh)


def _refuse(code: str, english: str, chinese: str) -> int:
    print(f"pons eval: {code}: {english}\n  {chinese}", file=sys.stderr)
    return REFUSED
