"""Which place a sentence leaves out, by itself: courtesy and a reason change nothing."""

import pytest

from planner.language.commands import read_left_out

LEAVES = (
    "not {}", "skip {}", "you can skip {}", "leave {} out", "don't bother with {}",
    "don't go into {}", "there's no need to look in {}", "never mind {}", "stay out of {}",
)  # fmt: skip
LEAVES_ZH = ("{}就别进了", "{}别进去", "别去{}了", "{}不用看了", "跳过{}", "{}就算了", "不用去{}")


@pytest.mark.parametrize("form", LEAVES)
@pytest.mark.parametrize("lead", ["", "oh, ", "no, "])
@pytest.mark.parametrize("tail", ["", ", please", ", the door's shut", " because Anna's asleep"])
@pytest.mark.parametrize("place", ["the bathroom", "my study"])
def test_a_place_is_left_out_however_it_is_said(
    form: str, lead: str, tail: str, place: str
) -> None:
    assert read_left_out(f"{lead}{form.format(place)}{tail}") == place


@pytest.mark.parametrize("form", LEAVES_ZH)
@pytest.mark.parametrize("tail", ["", "，门关着呢", "，孩子他爸睡着呢。", "，我刚看过"])
@pytest.mark.parametrize("place", ["卫生间", "书房"])
def test_so_it_is_in_chinese(form: str, tail: str, place: str) -> None:
    assert read_left_out(form.format(place) + tail) == place


@pytest.mark.parametrize(
    "text",
    [
        "not the bathroom if the door is shut", "not the bathroom, go to the kitchen",
        "not the bathroom?", "skip the bathroom and then come back", "go to the bathroom",
        "don't go into the bedroom until I call", "别进卧室，去厨房", "卧室别进去吗？",
        "如果门关着，卧室就别进了", "去卧室",
    ],
)  # fmt: skip
def test_what_says_more_leaves_nothing_out(text: str) -> None:
    assert read_left_out(text) is None
