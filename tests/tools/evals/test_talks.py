"""Check the suite of sentences that lean on a goal: by grammar, by a model and from the shell."""

from __future__ import annotations

import asyncio
from typing import Any

import pytest

from planner.brain import OfflineBrain, ScriptedBrain
from planner.plan import ComeBack, GoTo, PlanRole, StepPlan
from pons.evals.matchers import BadMatcher
from tests.conftest import ROOT
from tests.pons.evals.model_server import served_model
from tools.evals.__main__ import main
from tools.evals.lines import LineVerdict, read_line, read_lines
from tools.evals.talks import hear_talk

pytestmark = pytest.mark.nightly(keep=2)


SITE = ROOT / "sites" / "home"
STUDY = GoTo(place="study")
FREE = "tuned\tfree\tgo to the bedroom => go bedroom\t{}\t{}"


def verdict(text: str, expected: str, *replies: Any) -> LineVerdict:
    brain = ScriptedBrain(replies, by_grammar=False) if replies else OfflineBrain()
    return asyncio.run(hear_talk(read_line(FREE.format(text, expected), 3), brain, SITE))


def test_the_grammar_understands_nine_of_ten_and_no_correction_that_is_none() -> None:
    lines = [line for name in ("en", "zh") for line in read_lines("talks", name, 3)]
    held = [asyncio.run(hear_talk(line, OfflineBrain(), SITE)) for line in lines]
    assert len(held) == 70
    assert sum(each.right for each in held) >= 65
    for each in held:
        if each.line.columns[-1] == "keeps":
            assert not each.told.startswith(("instead", "after", "cancel")), each


def test_a_models_role_counts_where_the_words_bear_it() -> None:
    free = "hmm, no, rather the study I think"
    instead = StepPlan(steps=(STUDY,), does=PlanRole.INSTEAD)
    assert verdict(free, "instead: go study", instead).right
    after = StepPlan(steps=(STUDY,), does=PlanRole.AFTER)
    assert verdict("when you are done, the study", "after: go study", after).right


def test_what_a_person_would_be_asked_about_first_is_not_right() -> None:
    roams = StepPlan(steps=(STUDY, ComeBack()), does=PlanRole.INSTEAD)
    words = "hmm, no, rather the study I think"
    asked = verdict(words, "instead: go study > back", roams, roams)
    assert asked.told.startswith("confirms")
    assert not asked.right


@pytest.mark.parametrize(
    "row", ["tuned\tx\t\tyes\tbeside: go study", "tuned\tx\tgo => fly x\ta\tkeeps"]
)
def test_a_line_that_cannot_be_read_is_named(row: str) -> None:
    with pytest.raises(BadMatcher):
        asyncio.run(hear_talk(read_line(row, 3), OfflineBrain(), SITE))


@pytest.mark.usefixtures("home")
def test_what_a_model_may_cost_a_goal_is_counted_sentence_by_sentence() -> None:
    """A goal of one's own may take 30 calls; a suite has more sentences."""
    no = '{"kind":"refuse","code":"not_understood","en":"No.","zh":"不。"}'
    with served_model(lambda _: no) as served:
        assert main(["talk", "--model", f"m@{served.url}"]) == 1
    assert len(served.bodies) > 50
