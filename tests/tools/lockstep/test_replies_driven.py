"""What driven goals end with keeps the laws of replies, in the person's language and the other."""

from __future__ import annotations

import pytest

from planner.plan import Code, Language, Outcome
from tests.planner.language.laws.replies import count_sentences, find_foreign, find_inner
from tools.lockstep import LockstepWorld

pytestmark = pytest.mark.nightly


SHORT = 200
"""Characters that may be more than two sentences."""
ORDERS = (
    *("go to the kitchen", "where are you?", "what do you see?", "turn left 40 degrees"),
    *("is anybody in the kitchen?", "move 10 cm back", "go to the garage", "bring me a beer"),
    *("what did you do last?", "say “the bridge has a token”", "wait 1 second, then say hello"),
    *("say good night twice", "is the tv on?", "what did you see today?"),
    *("去厨房", "你在哪里？", "你看到了什么？", "左转40度", "厨房里有人吗？", "后退10厘米"),
    *("去车库", "给我拿瓶啤酒", "你刚才做了什么？", "说“安全桥有词元”", "等一秒，然后说你好"),
    *("说晚安两遍", "电视开着吗？", "你今天看到了什么？"),
)


def faults(outcome: Outcome, asked: Language) -> list[str]:
    """Return which laws the words of a goal's end break, in the person's language and the other."""
    found = []
    for language in Language:
        said = outcome.message.of(language)
        found += [f"inner {word}" for word in find_inner(said)]
        if language is asked:  # what a person named in one language has no word in the other
            found += [f"foreign {word}" for word in find_foreign(said, language)]
        told_long = outcome.code is not Code.RECALLED and count_sentences(said) > 2
        if "e-" in said or (told_long and len(said) > SHORT):
            found.append(f"{count_sentences(said)} sentences, or a figure that nobody reads")
    return found


@pytest.mark.timeout(300)
def test_what_driven_goals_end_with_is_short_of_one_language_and_without_inner_words() -> None:
    world, broken = LockstepWorld(seed=5), []
    world.open_eyes()
    for order in ORDERS:
        goal = world.say(order)
        world.run_until(lambda _, goal=goal: goal.record.outcome is not None, 60.0)  # type: ignore[misc]
        outcome, language = goal.record.outcome, goal.record.language
        assert outcome is not None, order
        broken += [f"{order}: {each}: {outcome.message}" for each in faults(outcome, language)]
        plan = goal.record.plan
        looks = plan is not None and any(step.kind == "look" for step in plan.steps)
        if looks and outcome.message.en.startswith("Arrived"):
            broken.append(f"{order}: the answer is not first: {outcome.message.en}")
    assert broken == []
