"""What the built-in brain answers to the sentences of every suite keeps the laws of replies."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner.brain import OfflineBrain, ThinkRequest
from planner.language.folding import is_chinese
from planner.plan import RUNNABLE, AnswerPlan, Clarify, Language, Refuse
from planner.site import Site
from planner.site.site_view import vocabulary_of
from pons_assets import DEFAULT_SITE
from tests.planner.language.laws.replies import count_sentences, find_foreign, find_inner

pytestmark = pytest.mark.nightly


HOME = vocabulary_of(Site.load(DEFAULT_SITE))
RUNS = RUNNABLE | {"find", "count", "look", "follow", "go_to_object"}
LISTED = 250
"""Characters of an answer that lists places or things."""


def sentences(repository: Path) -> list[str]:
    """Return the orders of every suite: the column behind its split and its group."""
    lines = (
        line.split("\t")
        for room in ("pons", "tools")
        for path in sorted((repository / room / "evals").glob("*/*.tsv"))
        if path.parent.name != "looks"
        for line in path.read_text("utf-8").splitlines()
        if line.strip() and not line.startswith("#")
    )
    return sorted({columns[2].partition(" =>")[0] for columns in lines if len(columns) >= 4})


@pytest.mark.timeout(300)
async def test_replies_to_all_suites_are_short_of_one_language_and_without_inner_words(
    repository: Path,
) -> None:
    said, wrong = 0, []
    for text in sentences(repository):
        language = Language.ZH if is_chinese(text) else Language.EN
        request = ThinkRequest(text=text, vocabulary=HOME, language=language, runnable=RUNS)
        plan = (await OfflineBrain().think(request)).plan
        told = []
        if isinstance(plan, Clarify):
            told = [plan.question, *(option.label for option in plan.options)]
        elif isinstance(plan, AnswerPlan | Refuse):
            told = [plan.text if isinstance(plan, AnswerPlan) else plan.reason]
        for each in told:
            own = each.of(language)
            said += 1
            long = count_sentences(own) > 2 and len(own) > LISTED
            if find_inner(own) or find_foreign(own, language) or long:
                wrong.append(f"{text}: {own}")
    print(f"{said} replies")
    assert said > 300
    assert wrong == [], said
