"""Who is said to be elsewhere is told there; a person whom the word does not fit is not."""

from typing import Any

import pytest

from planner.mission.state import MissionState
from planner.plan import Count, Patrol
from tests.planner.mission.leaning import changed_by, means, order_done, order_under_way

MUM = order_done("tell Mum in the kitchen lunch is ready")
MUM_BARE = order_done("tell Mum lunch is ready")
MUM_ZH = order_done("去厨房告诉妈妈吃饭了")
SEEKING = order_under_way("look for my backpack in the kitchen")
MOVED = (
    "no, she's in the study", "No, she's in the study now, not the kitchen.",
    "she's not in the kitchen, she's in the study", "wait, she is actually in the study",
)  # fmt: skip


@pytest.mark.parametrize("said", MOVED)
def test_who_is_elsewhere_is_told_there(said: str) -> None:
    assert means(MUM, said, "tell Mum in the study lunch is ready")
    assert means(MUM_BARE, said, "tell Mum in the study lunch is ready")


@pytest.mark.parametrize("said", ["不对，她在书房呢", "她不在厨房，在书房", "不，她现在在书房"])
def test_so_it_is_in_chinese(said: str) -> None:
    assert means(MUM_ZH, said, "去书房告诉妈妈吃饭了")


def test_what_is_sought_is_sought_there() -> None:
    for said in ("no, it's in the study", "it's not in the kitchen, it's in the study"):
        assert means(SEEKING, said, "look for the backpack in the study")


@pytest.mark.parametrize(
    "said",
    [
        "no, he's in the study", "she's in the study", "no, she's in the kitchen",
        "she's not in the bathroom, she's in the study", "no, she's asleep",
        "is she in the study?", "no, she's in the study if Dad is there", "她在书房",
    ],
)  # fmt: skip
def test_another_word_sends_to_nobody(said: str) -> None:
    assert changed_by(MUM, said) is None


ON_BED = order_under_way("go to the bedroom and see if the cat is on the bed")


@pytest.mark.parametrize(
    "said", ["no, the sofa", "I meant the sofa", "No, sorry, the living room, on the sofa."]
)
def test_a_thing_in_a_room_is_corrected_with_its_room(said: str) -> None:
    meant = "go to the living room and see if the cat is on the sofa"
    assert means(ON_BED, said, meant)


@pytest.mark.parametrize("said", ["no, the kitchen", "no, the study, on the sofa"])
def test_a_room_without_the_thing_is_asked_about(said: str) -> None:
    assert changed_by(ON_BED, said) is None


@pytest.mark.parametrize(
    "steps",
    [
        (Count(object="cup", place="kitchen"), Count(object="cup", place="study")),
        (Patrol(places=("kitchen", "study"), look=True),),
    ],
)
def test_a_correction_of_two_places_is_no_bare_drive(steps: tuple[Any, ...]) -> None:
    book: MissionState = order_done("see to the kitchen and the study", *steps)
    assert changed_by(book, "no, the bedroom") is None
