"""Who is said to be elsewhere is told there; a person whom the word does not fit is not."""

from typing import Any

import pytest

from planner.mission.follow_up import meaning_of
from planner.mission.state import MissionState
from planner.plan import Count, Find, GoTo, Look, Patrol, Say
from tests.planner.mission.leaning import NOW_S, order_done, order_under_way

TOLD = (GoTo(place="kitchen"), Say(text="Mum, lunch is ready"))
MUM = order_done("tell Mum in the kitchen lunch is ready", *TOLD)
MUM_BARE = order_done("tell Mum lunch is ready", Say(text="lunch is ready"))
MUM_ZH = order_done("去厨房告诉妈妈吃饭了", *TOLD)
SEEKING = order_under_way(
    "look for my backpack in the kitchen", Find(object="backpack", place="kitchen")
)
MOVED = (
    "no, she's in the study", "No, she's in the study now, not the kitchen.",
    "she's not in the kitchen, she's in the study", "wait, she is actually in the study",
)  # fmt: skip


@pytest.mark.parametrize("said", MOVED)
def test_who_is_elsewhere_is_told_there(said: str) -> None:
    assert meaning_of(MUM, said, NOW_S) == "tell mum in the study lunch is ready"
    assert meaning_of(MUM_BARE, said, NOW_S) == "tell Mum in the study lunch is ready"


@pytest.mark.parametrize("said", ["不对，她在书房呢", "她不在厨房，在书房", "不，她现在在书房"])
def test_so_it_is_in_chinese(said: str) -> None:
    assert meaning_of(MUM_ZH, said, NOW_S) == "去书房告诉妈妈吃饭了"


def test_what_is_sought_is_sought_there() -> None:
    for said in ("no, it's in the study", "it's not in the kitchen, it's in the study"):
        assert meaning_of(SEEKING, said, NOW_S) == "look for the backpack in the study"


@pytest.mark.parametrize(
    "said",
    [
        "no, he's in the study", "she's in the study", "no, she's in the kitchen",
        "she's not in the bathroom, she's in the study", "no, she's asleep",
        "is she in the study?", "no, she's in the study if Dad is there", "她在书房",
    ],
)  # fmt: skip
def test_another_word_sends_to_nobody(said: str) -> None:
    assert meaning_of(MUM, said, NOW_S) == said


ON_BED = order_under_way(
    "go to the bedroom and see if the cat is on the bed",
    GoTo(place="bedroom"), GoTo(place="bed"), Look(question="is it on the bed?", place="bed"),
)  # fmt: skip


@pytest.mark.parametrize(
    "said", ["no, the sofa", "I meant the sofa", "No, sorry, the living room, on the sofa."]
)
def test_a_thing_in_a_room_is_corrected_with_its_room(said: str) -> None:
    meant = "go to the living room and see if the cat is on the sofa"
    assert meaning_of(ON_BED, said, NOW_S) == meant


@pytest.mark.parametrize("said", ["no, the kitchen", "no, the study, on the sofa"])
def test_a_room_without_the_thing_is_asked_about(said: str) -> None:
    assert meaning_of(ON_BED, said, NOW_S) == said


@pytest.mark.parametrize(
    "steps",
    [
        (Count(object="cup", place="kitchen"), Count(object="cup", place="study")),
        (Patrol(places=("kitchen", "study"), look=True),),
    ],
)
def test_a_correction_of_two_places_is_no_bare_drive(steps: tuple[Any, ...]) -> None:
    book: MissionState = order_done("see to the kitchen and the study", *steps)
    assert meaning_of(book, "no, the bedroom", NOW_S) == "no, the bedroom"
