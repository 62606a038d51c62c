"""Orders that hang on something: "unless", "in there", whom to tell, and what is not read so."""

from __future__ import annotations

import pytest

from planner.language.grammar import Context, plan
from planner.plan import EVERY_KIND, Ask, Clarify, If, Look, Refuse, Say, StepPlan, Vocabulary

WHOLE = Context(runnable=EVERY_KIND)


def branch(text: str, home: Vocabulary) -> If:
    made = plan(text, home, WHOLE)
    assert isinstance(made, StepPlan), made
    assert len(made.steps) == 1
    assert isinstance(made.steps[0], If)
    return made.steps[0]


CONDITIONS = (
    ("somebody is in the {}", "nobody is in the {}"),
    ("there's someone in the {}", "there's no one in the {}"),
    ("the cat is in the {}", "the cat is not in the {}"),
    ("the cat's lying in the {}", "the cat isn't in the {}"),
)


@pytest.mark.parametrize(("holds", "lacks"), CONDITIONS)
@pytest.mark.parametrize("order", ["go to the study", "say hello", "come back", "turn around"])
def test_unless_is_if_not(home: Vocabulary, holds: str, lacks: str, order: str) -> None:
    """Before the order and behind it, of the other place or of the same."""
    for place in ("study", "kitchen"):
        unless, flat = holds.format(place), lacks.format(place)
        denied = branch(f"{order} unless {unless}", home)
        assert denied.then == ()
        for same in (f"unless {unless}, {order}", f"{order} if {flat}"):
            other = branch(same, home)
            assert (other.then, other.otherwise) == ((), denied.otherwise)
            assert isinstance(other.when, Look)
            assert isinstance(denied.when, Look)
            assert other.when.place == denied.when.place


@pytest.mark.parametrize(
    "state", ["somebody is sleeping", "Mum is asleep", "my son's still up", "I tell you otherwise"]
)
def test_a_state_that_no_eye_tells_is_refused(home: Vocabulary, state: str) -> None:
    for text in (f"unless {state}, go to the study", f"if {state}, go to the study"):
        made = plan(text, home, WHOLE)
        assert isinstance(made, Refuse)


def test_how_somebody_is_there_says_no_more_than_that_they_are(home: Vocabulary) -> None:
    asked = "ask her whether she wants tea, if not come back"
    plain = branch(f"if Grandma is on the sofa {asked}", home)
    assert branch(f"if Grandma's sitting on the sofa {asked}", home) == plain
    assert plain.then == (Ask(question="Grandma, do you want tea?"),)


@pytest.mark.parametrize(
    "things",
    ["there are {} cups on the desk", "you see {} cups on the desk", "{} cups are on the desk"],
)
@pytest.mark.parametrize(
    "count", ["two", "both", "all the", "more", "only two", "fewer than six", "at least 3", "many"]
)
def test_how_many_there_must_be_no_look_answers(home: Vocabulary, things: str, count: str) -> None:
    """Its yes says that there is one."""
    for text in (
        f"if {things.format(count)}, come back",
        f"come back unless {things.format(count)}",
    ):
        made = plan(text, home, WHOLE)
        assert isinstance(made, Refuse), text


@pytest.mark.parametrize("words", ["come to dinner", "wait in the hall"])
def test_what_they_are_asked_to_do_is_said_as_a_plea(home: Vocabulary, words: str) -> None:
    asked = branch(f"if there's somebody in the study, ask them to {words}", home)
    assert asked == branch(f"if there's somebody in the study, tell them to {words}", home)
    assert asked.then == (Say(text=f"please {words}"),)


def test_somebody_behind_nobody_is_the_other_branch(home: Vocabulary) -> None:
    both = branch("if nobody is in the study, go home. If somebody is, say hello", home)
    plain = branch("if somebody is in the study, say hello, otherwise go home", home)
    assert (both.then, both.otherwise) == (plain.then, plain.otherwise)


@pytest.mark.parametrize(
    "text",
    [
        "keep looking until you find something",
        "keep looking until you find no more cups",
        "keep looking until you find two cups",
        "look for the ball until you find the cat",
        "keep going until you see the dog",
        "keep looking until it gets dark",
    ],
)
def test_what_ends_no_search_is_refused(home: Vocabulary, text: str) -> None:
    made = plan(text, home, WHOLE)
    assert isinstance(made, Refuse)
    assert made.code.value == "conditional"


@pytest.mark.parametrize(
    "until", ["it gets dark", "dinner is ready", "Tom is asleep", "the cat comes"]
)
def test_what_no_eye_tells_is_waited_for_in_vain(home: Vocabulary, until: str) -> None:
    made = plan(f"wait in the hallway until {until}", home, WHOLE)
    assert isinstance(made, Refuse)
    assert until in made.reason.en


@pytest.mark.parametrize(
    "text",
    [
        "keep looking until you find the dog",
        "follow me until I say stop",
        "wait in the hallway until Tom comes, then go to the bedroom",
        "every five minutes look in the kitchen until somebody is there",
        "turn left until you see the cat",
        "ask Mum if she wants tea, if so go to the kitchen",
        "每五分钟看一次厨房，直到有人为止",
        "在门口等着，妈妈来了就跟他说你好",
        "问问妈妈要不要喝茶，要的话就去厨房",
    ],
)
def test_what_the_learned_reader_reads_moves_nothing_at_once(home: Vocabulary, text: str) -> None:
    made = plan(text, home, WHOLE)
    assert isinstance(made, Clarify | Refuse)


def test_no_button_holds_more_steps_than_a_plan_may(home: Vocabulary) -> None:
    for times, carries in ((19, True), (20, False)):
        made = plan(", ".join(["turn left"] * times + ["go to the kitch"]), home, WHOLE)
        assert isinstance(made, Clarify)
        assert {each.plan is not None for each in made.options} == {carries}
