"""The command ``pons eval``: a suite, an exam of a minute, or a journal thought again."""

from __future__ import annotations

import argparse
import asyncio
import sys
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING

from maps.errors import SiteError
from planner.brain import Brain, OfflineBrain, OutOfBudget
from planner.site import Site
from pons.evals.brain_choice import with_brain
from pons.evals.cases import MissingSuite, Suite
from pons.evals.matchers import BadMatcher
from pons.evals.report import as_json, content, has_passed, table
from pons.evals.score import SentenceVerdict, score_each
from pons.evals.suites import DATA, HOME_SITE, OTHERS, load, suite_names
from pons.launch_words import chinese_line
from wire import ConfigError

if TYPE_CHECKING:
    from pons.settings import LaunchSettings

REACHED, MISSED, REFUSED = 0, 1, 2
TALK, MEMORY, ORDERS, PERSON, TRIAL, LOOK = OTHERS
GOAL = 0.9
PERSON_GOAL = 0.95


@dataclass(frozen=True, slots=True)
class SuiteScore:
    """Hold one suite's results."""

    name: str
    verdicts: tuple[SentenceVerdict, ...]
    left: int
    """Sentences not asked: the budget was up."""


def main(settings: LaunchSettings, words: list[str]) -> int:
    """Score a brain on a suite: 0 the goal is reached, 1 it is not, 2 nothing could be asked."""
    parser = _parser()
    said = parser.parse_args(words)
    if said.quick or said.journal is not None:
        if said.suite is not None or (said.quick and said.journal is not None):
            parser.error("give one of SUITE, --quick and --journal")
        return _quick(settings, said) if said.quick else _journal(settings, said)
    if said.suite is None:
        parser.error("give a SUITE, --quick or --journal")
    if said.suite in OTHERS:
        return _score_other(settings, said)
    try:
        suites = load(said.suite, said.data, said.site)
        if said.guard:
            return _guard(suites)
        brain, scored = asyncio.run(_score_suites(settings, suites, said.model, yes=said.yes))
    except (MissingSuite, BadMatcher, SiteError) as wrong:
        print(f"pons eval: {wrong}\n  {_in_chinese(wrong)}", file=sys.stderr)
        return REFUSED
    except ConfigError as wrong:
        print(f"pons eval: {wrong}{chinese_line(str(wrong))}", file=sys.stderr)
        return REFUSED
    if not any(one.verdicts for one in scored) and any(one.left for one in scored):
        return REFUSED
    if said.json:
        print(as_json(content(one.name, brain, one.verdicts, one.left) for one in scored))
    else:
        print("\n\n".join(table(one.name, brain, one.verdicts, one.left) for one in scored))
    return REACHED if all(has_passed(one.verdicts, one.left) for one in scored) else MISSED


def _score_other(settings: LaunchSettings, said: argparse.Namespace) -> int:
    """Score a suite that has a reader of its own."""
    if said.suite == LOOK:
        from pons.evals.look_command import run

        return run(settings, said.model, yes=said.yes)
    if said.suite == ORDERS:
        return _orders(settings, said)
    return _person(settings, said) if said.suite in (PERSON, TRIAL) else _talk(settings, said)


def _in_chinese(wrong: MissingSuite | BadMatcher | SiteError) -> str:
    """Return in Chinese why nothing could be asked; the names stand in the line above."""
    if isinstance(wrong, SiteError):
        return wrong.message["zh"]
    if isinstance(wrong, BadMatcher):
        return "句集文件有一行无法读取：请按上面所示修改"
    return "没有这个句集：请从上面列出的名称中选择，或给出 .tsv 文件"


def _talk(settings: LaunchSettings, said: argparse.Namespace) -> int:
    """Score words that lean on the goal before them, or on memory, in both languages."""
    from pons.evals.memory_score import read_memory_cases, score_memory, show_memory
    from pons.evals.talk import read_talks, score_talks, show_talks
    from pons.evals.world import site_world

    async def score(brain: Brain) -> int:
        site, right, asked = Site.load(said.site), 0, 0
        for name in ("en", "zh"):
            if said.suite == TALK:
                talks = await score_talks(read_talks(name), brain, site)
                print(show_talks(name, talks))
                verdicts = [each.right for each in talks]
            else:
                world = site_world(said.site, room="study")
                answers = await score_memory(read_memory_cases(name), brain, world)
                print(show_memory(name, answers))
                verdicts = [each.right and not each.moves_wrongly for each in answers]
            right, asked = right + sum(verdicts), asked + len(verdicts)
        return REACHED if right >= GOAL * asked else MISSED

    try:
        return asyncio.run(with_brain(settings, said.model, score, yes=said.yes))
    except (SiteError, ConfigError) as wrong:
        print(f"pons eval: {wrong}{chinese_line(str(wrong))}", file=sys.stderr)
        return REFUSED


def _orders(settings: LaunchSettings, said: argparse.Namespace) -> int:
    """Score sentences about standing orders, in both languages."""
    from pons.evals.orders import read_order_cases, score_orders, show_orders

    async def score(brain: Brain) -> int:
        site, right, count = Site.load(said.site), 0, 0
        for name in ("en", "zh"):
            verdicts = await score_orders(read_order_cases(name), brain, site)
            print(show_orders(name, verdicts))
            right, count = right + sum(v.right for v in verdicts), count + len(verdicts)
        return REACHED if right >= GOAL * count else MISSED

    try:
        return asyncio.run(with_brain(settings, said.model, score, yes=said.yes))
    except (SiteError, ConfigError) as wrong:
        print(f"pons eval: {wrong}{chinese_line(str(wrong))}", file=sys.stderr)
        return REFUSED


def _person(settings: LaunchSettings, said: argparse.Namespace) -> int:
    """Hold conversations with a brain and, where none is named, with a model by script as well.

    A trial is for models: what it asks is beyond a grammar.
    """
    from pons.evals.journal.command import LockstepMissing, require_lockstep
    from pons.evals.person import Conversation, converse, show_conversations
    from pons.evals.person_robot import RobotEar, ScriptedModel
    from pons.evals.person_scripts import Script, ScriptSet, read_scripts

    sets = (
        (ScriptSet.TRIAL,)
        if said.suite == TRIAL
        else (ScriptSet.OWN, ScriptSet.THIRD, ScriptSet.FOURTH)
    )

    def brains(brain: Brain) -> tuple[Brain, ...]:
        if said.model is not None:
            return (brain,)
        scripted = (ScriptedModel(whims=False), ScriptedModel())[: 1 if said.drive else 2]
        return scripted if said.suite == TRIAL else (brain, scripted[-1])

    async def hold(script: Script, brain: Brain, site: Site) -> Conversation:
        if not said.drive:
            return await converse(script, brain, RobotEar(brain, site))
        from pons.evals.driven_person import driven_robot

        with driven_robot(brain, said.site) as robot:
            return await converse(script, brain, robot)

    async def score(brain: Brain) -> int:
        site, right, count = Site.load(said.site), 0, 0
        for name, script_set in product(("en", "zh"), sets):
            for each in brains(brain):
                scripts = read_scripts(name, script_set)
                held = tuple([await hold(one, each, site) for one in scripts])
                hostile = each.hostile if isinstance(each, ScriptedModel) else 0
                print(show_conversations(f"{script_set}{name}", each.tag.name, held, hostile))
                right, count = right + sum(h.right for h in held), count + len(held)
                if any(h.moves_wrongly for h in held):
                    right = -count
        return REACHED if right >= PERSON_GOAL * count else MISSED

    try:
        if said.drive:
            require_lockstep()
        return asyncio.run(with_brain(settings, said.model, score, yes=said.yes))
    except (BadMatcher, SiteError, ConfigError, LockstepMissing) as wrong:
        print(f"pons eval: {wrong}", file=sys.stderr)
        return REFUSED


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="pons eval",
        description="Score what a brain plans. Exit status: 0 goal reached, 1 not, 2 not asked.",
    )
    parser.add_argument(
        "suite",
        nargs="?",
        help=f"{', '.join((*suite_names(), *OTHERS))}, or a .tsv file",
    )
    parser.add_argument("--quick", action="store_true", help="examine a model for a minute")
    parser.add_argument(
        "--journal",
        metavar="FILE",
        help="think the sentences of a journal (missions.db) or a home folder again",
    )
    parser.add_argument(
        "--model",
        nargs="?",
        const="",
        metavar="NAME@URL",
        help="ask a model: the owner's, or NAME, URL or NAME@URL; else the offline brain",
    )
    parser.add_argument(
        "--guard",
        action="store_true",
        help="measure the guard against motion nobody asked for on the suite: no brain is scored",
    )
    parser.add_argument("--yes", action="store_true", help="a model elsewhere may be asked")
    parser.add_argument("--most", type=int, default=50, metavar="N", help="the newest sentences")
    parser.add_argument("--drives", type=int, default=3, metavar="N", help="plans to drive, of new")
    parser.add_argument("--drive", action="store_true", help="person, trial: drive in lockstep")
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--data", type=Path, default=DATA, help="folder of the orders of others")
    parser.add_argument("--site", type=Path, default=HOME_SITE, help="whose names ours use")
    return parser


def _quick(settings: LaunchSettings, said: argparse.Namespace) -> int:
    from pons.evals import quick

    word = said.model or ""
    return quick.run(settings, word, as_json=said.json, yes=said.yes, called="pons eval --quick")


def _journal(settings: LaunchSettings, said: argparse.Namespace) -> int:
    from pons.evals.journal import command

    options = command.JournalOptions(max(0, said.most), max(0, said.drives), said.json, said.yes)
    word = said.model or ""
    return command.run(settings, [said.journal], word, options, "pons eval --journal")


def _guard(suites: tuple[Suite, ...]) -> int:
    """Measure the guard: 0 nothing unasked is walked and little is asked in vain, 1 otherwise."""
    from pons.evals.guard_score import score_guard, show

    if any(case.course is not None for suite in suites for case in suite.cases):
        print(
            "pons eval: guard_of_turns: --guard is for sentences; of turns the table with --model "
            "tells the guard's word\n  --guard 只用于单句；轮次句集请用 --model，结果在表中",
            file=sys.stderr,
        )
        return REFUSED
    scores = [asyncio.run(score_guard(suite)) for suite in suites]
    print("\n".join(map(show, scores)))
    return REACHED if all(score.has_passed for score in scores) else MISSED


async def _score_suites(
    settings: LaunchSettings, suites: tuple[Suite, ...], model: str | None, *, yes: bool
) -> tuple[str, list[SuiteScore]]:
    count = sum(len(suite.cases) for suite in suites)

    async def score(brain: Brain) -> tuple[str, list[SuiteScore]]:
        return await score_whole(suites, brain)

    return await with_brain(settings, model, score, yes=yes, count=count)


def _tell_progress(done: int, count: int) -> None:
    """Show on a terminal how far a slow model is."""
    if sys.stderr.isatty():
        print(f"\r{done} of {count}", end="" if done < count else "\n", file=sys.stderr, flush=True)


async def score_whole(suites: tuple[Suite, ...], brain: Brain) -> tuple[str, list[SuiteScore]]:
    """Score to the end of the suites or of the budget, or to Ctrl-C: paid results are kept."""
    verdicts: list[list[SentenceVerdict]] = [[] for _ in suites]
    count = sum(len(suite.cases) for suite in suites)
    try:
        for suite, mine in zip(suites, verdicts, strict=True):
            async for verdict in score_each(suite, brain):
                mine.append(verdict)
                if not isinstance(brain, OfflineBrain):
                    _tell_progress(sum(map(len, verdicts)), count)
    except OutOfBudget as spent:
        print(f"pons eval: {spent.said.en}", file=sys.stderr)
    except asyncio.CancelledError:  # how asyncio.run hands Ctrl-C on
        if (task := asyncio.current_task()) is not None:
            task.uncancel()
        print("\npons eval: interrupted; this was scored until then", file=sys.stderr)
    scored = [
        SuiteScore(suite.name, tuple(mine), len(suite.cases) - len(mine))
        for suite, mine in zip(suites, verdicts, strict=True)
    ]
    return f"{brain.tag.name} {brain.tag.version}", scored
