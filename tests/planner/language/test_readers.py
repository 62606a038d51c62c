"""The ladder of readers: each sentence is taken by the first that is concerned, and told once."""

from __future__ import annotations

from dataclasses import dataclass, field

import pytest

from planner.language.catalogue import say
from planner.language.commands import (
    ForgetFacts,
    HereCommand,
    OutcomeCommand,
    PauseCommand,
    TeachFact,
)
from planner.language.grammar import Context
from planner.language.readers import (
    AT_THE_DOOR,
    BUILT_IN,
    BY_THE_PLANNER,
    READERS,
    READERS_WITH_MODEL,
    OrderWords,
    read_order,
    readings,
)
from planner.language.reading import (
    AnswerReading,
    ChangeReading,
    CommandReading,
    HaltReading,
    OrdersReading,
)
from planner.language.schedule import OrderCommand
from planner.language.sentence import SaidSentence, parse
from planner.plan import EVERY_KIND, AnswerPlan, ChangedOrder, Clarify, Code, Refuse, StepPlan
from planner.site import Site
from planner.site.site_view import vocabulary_of
from tests.conftest import ROOT

HOME = vocabulary_of(Site.load(ROOT / "sites" / "home"))
CHANGE = ChangeReading(ChangedOrder(words="go to the study"))


@dataclass
class Goals:
    """Stand at the door with these goals."""

    asking: tuple[str, ...] = ()
    change: ChangeReading | None = None
    moves: bool = False
    asked: list[str] = field(default_factory=list)

    def asked_by(self, said: SaidSentence) -> tuple[str, ...]:
        return self.asking if said.consent is not None else ()

    def change_of(self, said: SaidSentence) -> ChangeReading | None:
        self.asked.append(said.text)
        return self.change

    def may_stop(self, said: SaidSentence) -> bool:
        return self.moves and said.may_mean_stop


@dataclass
class Words:
    """Know these facts and places."""

    open_order: OrderCommand | None = None
    corrected: TeachFact | None = None
    told: TeachFact | None = None
    places: tuple[str, ...] = ()
    has_outcome: bool = False

    def correct_fact(self, said: SaidSentence) -> TeachFact | None:
        return self.corrected

    def tell_fact(self, said: SaidSentence) -> TeachFact | None:
        return self.told

    def is_place(self, name: str) -> bool:
        return name in self.places


def test_with_a_model_the_built_in_readers_alone_are_missing() -> None:
    assert (*AT_THE_DOOR, *BY_THE_PLANNER, *BUILT_IN) == READERS
    assert READERS[: -len(BUILT_IN)] == READERS_WITH_MODEL
    assert [reader.__name__ for reader in READERS[:2]] == ["stop", "answer"]


@pytest.mark.parametrize(
    ("said", "goals", "reading"),
    [
        ("stop", Goals(("g1",), CHANGE, moves=True), HaltReading()),
        ("stop, go home", Goals(moves=True), HaltReading("go home")),
        ("I think you may stop now", Goals(moves=True), HaltReading(is_doubtful=True)),
        ("I think you may stop now", Goals(), None),
        ("no", Goals(("g1",), CHANGE), AnswerReading(("g1",))),
        ("no, the study", Goals(("g1",), CHANGE), CHANGE),
        ("go to the kitchen", Goals(), None),
    ],
)
def test_at_the_door_a_stop_goes_before_an_answer_and_that_before_a_change(
    said: str, goals: Goals, reading: object
) -> None:
    assert next(readings(parse(said), goals, AT_THE_DOOR), None) == reading


def test_what_a_stop_or_an_answer_takes_is_not_read_for_a_change() -> None:
    goals = Goals(("g1",), CHANGE)
    assert next(readings(parse("stop"), goals, AT_THE_DOOR)) == HaltReading()
    assert next(readings(parse("yes"), goals, AT_THE_DOOR)) == AnswerReading(("g1",))
    assert goals.asked == []


FACT = TeachFact("the key is in the study")


@pytest.mark.parametrize(
    ("said", "words", "intent"),
    [
        ("hold on a moment", Words(), PauseCommand()),
        (
            "you are in the kitchen",
            Words(places=("the kitchen", "kitchen")),
            HereCommand("kitchen"),
        ),
        ("you are in the way", Words(), None),
        ("forget about the kitchen", Words(places=("kitchen", "the kitchen")), None),
        ("did it work?", Words(), None),
        ("the key is in the study", Words(told=FACT), FACT),
        ("no, it is in the study", Words(corrected=FACT), FACT),
        ("go to the kitchen", Words(), None),
    ],
)
def test_a_command_is_one_only_where_what_it_names_is_there(
    said: str, words: Words, intent: object
) -> None:
    reading = next(readings(parse(said), words, BY_THE_PLANNER), None)
    assert reading == (None if intent is None else CommandReading(intent))  # type: ignore[arg-type]


def test_an_outcome_is_told_once_there_is_one_and_words_of_memory_are_forgotten() -> None:
    asked = next(readings(parse("how did it go?"), Words(has_outcome=True), BY_THE_PLANNER))
    assert asked == CommandReading(OutcomeCommand())
    gone = next(readings(parse("forget about my keys"), Words(), BY_THE_PLANNER))
    assert isinstance(gone, CommandReading)
    assert isinstance(gone.intent, ForgetFacts)


def test_who_declines_a_standing_order_leaves_it_to_the_next_reader() -> None:
    found = readings(parse("remind me at eight"), Words(told=FACT), BY_THE_PLANNER)
    assert [type(each) for each in found] == [OrdersReading, CommandReading]


def order(text: str, *, is_answer: bool = False) -> OrderWords:
    context = Context(runnable=frozenset(EVERY_KIND))
    return OrderWords(parse(text), HOME, context, is_answer)


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("go to the kitchen", StepPlan),
        ("去厨房", StepPlan),
        ("yes", AnswerPlan),
        ("don't go to the kitchen", Refuse),
        ("where did you last see my keys?", StepPlan),
        ("zwei dingse flumpen", Clarify),
        ("天地玄黄", Clarify),
    ],
)
def test_the_built_in_brain_reads_or_says_that_it_does_not(text: str, kind: type) -> None:
    assert type(read_order(order(text)).plan) is kind


def test_what_is_not_read_is_told_in_one_sentence_with_its_cure() -> None:
    for text in ("zwei dingse flumpen", "天地玄黄"):
        made = read_order(order(text)).plan
        assert isinstance(made, Clarify)
        assert made.code is Code.NOT_UNDERSTOOD
        assert "without a model. I know" in made.question.en
        assert "没有模型" in made.question.zh
        assert text in made.question.en
        assert text in made.question.zh


def test_a_yes_to_a_question_about_the_order_is_no_idle_one() -> None:
    idle = AnswerPlan(text=say("talk.nothing_asked"))
    assert read_order(order("yes")).plan == idle
    assert read_order(order("yes", is_answer=True)).plan != idle
