"""Score what is read of sentences to memory and of standing orders, by the planner itself first.

What is to be kept, forgotten, repeated or changed asks no brain, as at run time. A question to
memory is right where it becomes a `recall` of what is asked; a standing order where its time is the
one that is expected and the plan of the order within fits. Nothing is kept and nothing moves.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.brain import ThinkRequest
from planner.brain.situation import RememberedItem, Situation
from planner.language.commands import Forget, ForgetFacts, Remember, TeachFact, read_statement
from planner.language.motion_guard.step_words import moves
from planner.language.schedule import ChangeOrders, ScheduleCommand
from planner.language.sentence import parse
from planner.mission.effects import AskBrain
from planner.mission.plan_request import thinker
from planner.plan import EVERY_KIND, Means, Recall, StepPlan
from pons.evals.matchers import BadMatcher, read_expectation
from pons.evals.world import new_goal
from tools.evals.lines import LineVerdict
from tools.evals.order_words import describe, is_named

if TYPE_CHECKING:
    from planner.brain import Brain
    from planner.language.commands import Intent
    from planner.plan import Vocabulary
    from pons.evals.matchers import Made
    from tools.evals.lines import SuiteLine

KINDS = ("cron", "every", "in", "day", "event", "list", "when", "left", "remove", "pause", "resume",
         "skip", "change", "again", "problem", "none", "stops")  # fmt: skip
_KNOWN = Situation(remembered=(RememberedItem(what="what is asked for", fits=True),))
"""Memory knows what a sentence names: a question about now may then be answered from it."""
_STILL = frozenset(
    {"recall", "deeds", "teach", "forget", "place", "command", "answer", "clarify", "still"}
)


async def hear_memory(line: SuiteLine, brain: Brain, vocabulary: Vocabulary) -> LineVerdict:
    """Return what a question to memory, or what is told to it, comes to."""
    text, wanted = line.columns
    done, made = _read_locally(text), None
    if done is None:
        asked = ThinkRequest(
            text=text, vocabulary=vocabulary, room="study", runnable=EVERY_KIND,
            situation=_KNOWN, goal=new_goal("memory"),
        )  # fmt: skip
        made = (await brain.think(asked)).plan
        done = _name(made)
    ways = [way.strip() for way in wanted.split("|")]
    right = any(_fits(way, done, made) for way in ways)
    moved = isinstance(made, StepPlan) and any(map(moves, made.steps))
    still = all(way.split()[0] in _STILL for way in ways)
    return LineVerdict(line, text, done, right and not (moved and still), moved and still)


def _read_locally(text: str) -> str | None:
    """Return what the planner itself does with a sentence; None: it asks a brain."""
    match parse(text).intent or read_statement(text):
        case None:
            return None
        case TeachFact():
            return "teach"
        case ForgetFacts(about):
            return f"forget {about or 'all'}"
        case Remember() | Forget():
            return "place"
    return "command"


def _name(made: Made) -> str:
    """Return a plan in the words of an expectation."""
    if not isinstance(made, StepPlan):
        return made.kind
    step = made.steps[0] if len(made.steps) == 1 else None
    if not isinstance(step, Recall):
        return " > ".join(each.kind for each in made.steps)
    place = f" @{step.place}" if step.place else ""
    when = f" %{step.span}" if step.span else ""
    what = "deeds" if step.deeds else f"recall {step.object or ''}".strip()
    return f"{what}{place}{when}"


def _fits(way: str, done: str, made: Made | None) -> bool:
    kind = way.split(maxsplit=1)[0]
    if kind in ("teach", "place", "command", "deeds"):
        return done == way
    if kind in ("recall", "forget"):
        return done.split(maxsplit=1)[0] == kind and _bare(way) == _bare(done)
    return made is not None and read_expectation(way).fits(made)


def _bare(text: str) -> str:
    """Return words without articles and without the 的 of Chinese, which do not matter."""
    parts = [part for part in text.casefold().split() if part not in ("the", "my", "a", "an")]
    return re.sub("我的|的", "", "".join(parts))


async def hear_order(line: SuiteLine, brain: Brain, vocabulary: Vocabulary) -> LineVerdict:
    """Return what a sentence about standing orders is read as.

    Raises:
        BadMatcher: its expectation can't be read.
    """
    text, expected = line.columns
    wanted, _, does = (each.strip() for each in expected.partition("=>"))
    if wanted.split()[0] not in KINDS:
        raise BadMatcher(f"{expected!r}: unknown kind; known: {', '.join(KINDS)}")
    said = parse(text)
    if wanted == "stops":
        stops = said.orders_stop or said.may_mean_stop
        return LineVerdict(line, text, "stops" if stops else "does not stop", stops)
    intent = said.intent
    read = describe(intent)
    right = read == wanted or (isinstance(intent, ChangeOrders) and is_named(wanted, intent))
    if right and does and isinstance(intent, ScheduleCommand):
        within = AskBrain(new_goal("order"), intent.order, said.language)
        right = await _does(does, intent, within, brain, vocabulary)
    wrong = not right and wanted == "none"
    return LineVerdict(line, text, f"{read} => {_order(intent)}", right, wrong)


def _order(intent: Intent | None) -> str:
    if not isinstance(intent, ScheduleCommand):
        return ""
    return f"remind {intent.reminder}" if intent.reminder is not None else intent.order


async def _does(
    does: str, intent: ScheduleCommand, within: AskBrain, brain: Brain, vocabulary: Vocabulary
) -> bool:
    """Tell whether the order within is planned as expected, unasked; or the words to say are."""
    if does.startswith("remind"):
        words = does.removeprefix("remind").strip()
        return intent.reminder is not None and words in ("", intent.reminder)
    think = thinker(brain, vocabulary, None, Means(camera=True, detector=True))
    planned = await think(within)
    made = planned.plan
    return made is not None and not planned.unasked and read_expectation(does).fits(made)
