"""A condition that leans on a question before it is written out in that question's words."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.language.leaning_condition import (
    WhetherThere,
    read_whether_there,
    write_condition,
)

QUESTIONS = {
    "is Dad in the study": ("Dad", "in the study"),
    "is there anyone in the kitchen?": ("anyone", "in the kitchen"),
    "are there any cups on the table": ("any cups", "on the table"),
    "go and see if Mum is in the bedroom": ("Mum", "in the bedroom"),
    "see if Dad is there": ("Dad", ""),
    "check whether the dog is still in the hallway": ("the dog", "in the hallway"),
    "爸爸在书房吗": ("爸爸", "书房"),
    "看看爸爸在不在书房": ("爸爸", "书房"),
    "看看书房有没有爸爸": ("爸爸", "书房"),
    "看看有没有人": ("人", ""),
    "厨房有人吗？": ("人", "厨房"),
    "look around": None,
    "how many chairs are in the kitchen": None,
    "is it raining": None,
    "is she asleep": None,
    "看看周围": None,
}
ON_DAD = {
    "if he is, tell him dinner's ready": "if Dad is in the study, tell him dinner's ready",
    "if so, say hello": "if Dad is in the study, say hello",
    "if he isn't, look in the bedroom": "if Dad is not in the study, look in the bedroom",
    "and if not go to the bedroom": "if Dad is not in the study, go to the bedroom",
    "then say hello, otherwise come back": "if Dad is in the study, say hello, otherwise come back",
    "if he's there say hello, if he isn't come back": (
        "if Dad is in the study, say hello, otherwise come back"
    ),
    "say hello if he's there": "if Dad is in the study, say hello",
    "otherwise come back": "if Dad is not in the study, come back",
    "if he is, ask him if he wants tea": "if Dad is in the study, ask him if he wants tea",
    "if he is, go up to him": "if Dad is in the study, go up to Dad",
}
ON_BABA = {
    "如果他在，就告诉他吃饭了": "如果书房有爸爸，就告诉他吃饭了",
    "要是不在就去卧室看看": "如果书房没有爸爸，就去卧室看看",
    "在的话跟他说吃饭了": "如果书房有爸爸，就跟他说吃饭了",
    "他在就说你好，不在就回来": "如果书房有爸爸，就说你好，否则回来",
    "否则去卧室": "如果书房没有爸爸，就去卧室",
}
LEFT = (
    *(
        "if it rains, go home",
        "if he is hungry, go to the kitchen",
        "go to the kitchen",
        "if he is",
    ),
    *("if he is, go to the study when it is dark", "if he is there or not, come back"),
    *("如果下雨就回家", "去卧室", "如果他饿了就去厨房"),
)


@pytest.mark.parametrize(("question", "parts"), QUESTIONS.items())
def test_a_question_whether_somebody_is_somewhere(
    question: str, parts: tuple[str, str] | None
) -> None:
    assert read_whether_there(question) == (WhetherThere(*parts) if parts is not None else None)


@pytest.mark.parametrize(("said", "whole"), [*ON_DAD.items(), *ON_BABA.items()])
def test_conditions_are_written_out(said: str, whole: str) -> None:
    asked = WhetherThere("Dad", "in the study") if said in ON_DAD else WhetherThere("爸爸", "书房")
    assert write_condition(asked, "", said) == whole


@pytest.mark.parametrize("said", LEFT)
def test_what_leans_on_nothing_or_on_more_stays(said: str) -> None:
    for asked in (WhetherThere("Dad", "in the study"), WhetherThere("爸爸", "书房")):
        assert write_condition(asked, "study", said) is None


@pytest.mark.parametrize("question", ["is {w} in the study", "see if {w} is there"])
@pytest.mark.parametrize("who", ["Dad", "the dog", "Anna", "my mum"])
@pytest.mark.parametrize("order", ["come back", "go to the kitchen and look around", "say hello"])
def test_yes_and_no_are_each_others_contrary(question: str, who: str, order: str) -> None:
    """Law: "if so X, otherwise Y" and "if not Y, if so X" hang the same on the same question."""
    asked = read_whether_there(question.format(w=who))
    assert asked is not None
    yes = write_condition(asked, "study", f"if so {order}, otherwise wait ten seconds")
    no = write_condition(asked, "study", f"if not wait ten seconds, if so {order}")
    assert yes == f"if {who} is in the study, {order}, otherwise wait ten seconds"
    assert no == f"if {who} is not in the study, wait ten seconds, otherwise {order}"


def test_a_thing_that_may_be_missing_has_no_article() -> None:
    cup = WhetherThere("a cup", "on the table")
    assert write_condition(cup, "", "if not, come back") == (
        "if there is no cup on the table, come back"
    )
    assert write_condition(WhetherThere("anyone", ""), "study", "if not, come back") == (
        "if nobody is in the study, come back"
    )


@given(st.text(max_size=60))
def test_any_text_is_read_or_left(text: str) -> None:
    for asked in (WhetherThere("Dad", "in the study"), WhetherThere("爸爸", "书房")):
        write_condition(asked, "study", text)
    read_whether_there(text)
