"""Show to whom sentences are said, in both languages."""

from __future__ import annotations

import pytest

from fleet.addressee import Addressee, is_free_name, is_stop, read_addressee, to_names
from fleet.errors import FleetError

KNOWN = ("r1", "r2", "Ada", "kitchen-1")
EVERYBODY = tuple(sorted(KNOWN))


@pytest.mark.parametrize(
    ("text", "addressee", "order"),
    [
        ("r2: go to the kitchen", Addressee("named", ("r2",)), "go to the kitchen"),
        ("R2, go to the kitchen", Addressee("named", ("r2",)), "go to the kitchen"),
        ("ada go home", Addressee("named", ("Ada",)), "go home"),
        ("tell ada to go home", Addressee("named", ("Ada",)), "go home"),
        ("r1 and r2: go home", Addressee("each", ("r1", "r2")), "go home"),
        ("everybody go home", Addressee("each", EVERYBODY), "go home"),
        ("Everyone, home", Addressee("each", EVERYBODY), "home"),
        ("all robots go home", Addressee("each", EVERYBODY), "go home"),
        ("everybody but r1 go home", Addressee("each", ("Ada", "kitchen-1", "r2")), "go home"),
        ("all except r1 and ada: home", Addressee("each", ("kitchen-1", "r2")), "home"),
        ("somebody look whether the back door is shut", Addressee("any"),
         "look whether the back door is shut"),
        ("can somebody go to the hall", Addressee("any"), "go to the hall"),
        ("nearest: go to the hall", Addressee("nearest"), "go to the hall"),
        ("the nearest robot go to the hall", Addressee("nearest"), "go to the hall"),
        ("大家回家", Addressee("each", EVERYBODY), "回家"),
        ("大家都去厨房", Addressee("each", EVERYBODY), "去厨房"),
        ("谁去看看后门关了没有", Addressee("any"), "去看看后门关了没有"),
        ("谁能去厨房", Addressee("any"), "去厨房"),
        ("最近的机器人去厨房", Addressee("nearest"), "去厨房"),
        ("r2去厨房", Addressee("named", ("r2",)), "去厨房"),
        ("让r2去厨房", Addressee("named", ("r2",)), "去厨房"),
        ("r1和r2：回家", Addressee("each", ("r1", "r2")), "回家"),
        ("除了r1以外大家都回家", Addressee("each", ("Ada", "kitchen-1", "r2")), "回家"),
        ("除了r1和r2都回家", Addressee("each", ("Ada", "kitchen-1")), "回家"),
        ("go to the kitchen", None, "go to the kitchen"),
        ("谁在厨房", None, "谁在厨房"),
        ("r22 is a robot", None, "r22 is a robot"),
        ("everybody", Addressee("each", EVERYBODY), ""),
    ],
)  # fmt: skip
def test_a_sentence_is_said_to(text: str, addressee: Addressee | None, order: str) -> None:
    assert read_addressee(text, KNOWN) == (addressee, order)


def test_an_unknown_name_with_a_colon_is_told_with_those_that_exist() -> None:
    with pytest.raises(FleetError) as refused:
        read_addressee("r9: go home", KNOWN)
    assert refused.value.code == "unknown_robot"
    assert "r9" in refused.value.message["zh"]
    assert "kitchen-1" in refused.value.message["en"]


def test_names_are_found_in_any_case_and_once() -> None:
    assert to_names(["ADA", "ada", "r1"], KNOWN) == ("Ada", "r1")


@pytest.mark.parametrize("name", ["everybody", "nearest", "stop", "r 2", "", "谁", "x" * 40])
def test_a_word_of_address_is_no_robots_name(name: str) -> None:
    assert not is_free_name(name)


@pytest.mark.parametrize("order", ["stop", "Stop!", "please stop now", "停下", "都停下", "别动。"])
def test_a_bare_stop(order: str) -> None:
    assert is_stop(order)


@pytest.mark.parametrize("order", ["go to the bus stop", "stop at the kitchen", "停在厨房"])
def test_an_order_with_the_word_stop_in_it_is_left_to_the_robot(order: str) -> None:
    assert not is_stop(order)
