"""Check the suite of conversations: by grammar, by a model and from the shell."""

from __future__ import annotations

import asyncio
from typing import Any

import pytest

from planner.brain import OfflineBrain, ScriptedBrain
from planner.plan import ComeBack, GoTo, PlanRole, StepPlan
from planner.site.site import Site
from pons.__main__ import main
from pons.evals.matchers import BadMatcher
from pons.evals.talk import KEEPS, TalkCase, TalkVerdict, _read, read_talks, score_talk, score_talks
from tests.conftest import ROOT

STUDY = GoTo(place="study")
FREE = "tuned\tfree\tgo to the bedroom => go bedroom\t{}\t{}"


@pytest.fixture(scope="module")
def site() -> Site:
    return Site.load(ROOT / "sites" / "home")


def verdict(text: str, expected: str, site: Site, *replies: Any) -> TalkVerdict:
    brain = ScriptedBrain(replies, by_grammar=False) if replies else OfflineBrain()
    return asyncio.run(score_talk(_read(FREE.format(text, expected)), brain, site))


def test_the_grammar_understands_nine_of_ten_and_no_correction_that_is_none(site: Site) -> None:
    right = total = 0
    for name in ("en", "zh"):
        verdicts = asyncio.run(score_talks(read_talks(name), OfflineBrain(), site))
        right, total = right + sum(v.right for v in verdicts), total + len(verdicts)
        for each in verdicts:
            if each.case.role == KEEPS:
                assert each.role in (KEEPS, PlanRole.NEW.value), each.case.text
    assert total >= 60
    assert right >= 0.9 * total


def test_a_models_role_counts_where_the_words_bear_it(site: Site) -> None:
    free = "hmm, no, rather the study I think"
    instead = StepPlan(steps=(STUDY,), does=PlanRole.INSTEAD)
    assert verdict(free, "instead: go study", site, instead).right
    assert verdict("go to the study", "new: go study", site, instead).right
    after = StepPlan(steps=(STUDY,), does=PlanRole.AFTER)
    assert verdict("when you are done, the study", "after: go study", site, after).right


def test_what_a_person_would_be_asked_about_first_is_not_right(site: Site) -> None:
    roams = StepPlan(steps=(STUDY, ComeBack()), does=PlanRole.INSTEAD)
    asked = verdict("hmm, no, rather the study I think", "instead: go study > back", site, roams)
    assert (asked.asked, asked.right) == (True, False)


@pytest.mark.parametrize(
    "line", ["tuned\tx\t\tyes\tbeside: go study", "tuned\tx\tgo => fly x\ta\tkeeps"]
)
def test_a_line_that_cannot_be_read_is_named(line: str) -> None:
    with pytest.raises(BadMatcher):
        _read(line)


def test_every_case_has_words() -> None:
    cases: list[TalkCase] = [case for name in ("en", "zh") for case in read_talks(name)]
    assert all(case.text and (case.role == KEEPS) is (case.wanted is None) for case in cases)


def test_from_the_shell(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["eval", "talk"]) == 0
    shown = capsys.readouterr().out
    assert "en tuned" in shown
    assert "zh held out" in shown
    assert main(["eval", "talk", "--site", "/nowhere"]) == 2
