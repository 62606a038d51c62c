"""Tell, ask and find people: who is named is searched for, and hears it with the name first."""

from __future__ import annotations

import pytest

from planner.language.grammar.context import Context
from planner.language.grammar.parser import plan
from planner.plan import EVERY_KIND, Ask, Clarify, Code, Find, Say, StepPlan, Vocabulary

HERE = Context(things=frozenset({"person", "人", "cup", "杯子"}), runnable=EVERY_KIND)


@pytest.mark.parametrize(
    ("said", "who", "heard"),
    [
        ("tell Mum I'm home", "Mum", Say(text="Mum, i am home")),
        ("go and tell my husband dinner is ready", "husband", Say(text="husband, dinner is ready")),
        (
            "go find Dad and tell him the phone's for him",
            "Dad",
            Say(text="Dad, the phone's for him"),
        ),
        ("跟我老婆说饭好了", "我老婆", Say(text="老婆,饭好了")),
        ("跟妈妈说我出门了", "妈妈", Say(text="妈妈,我出门了")),
        # who is called to something hears it whole
        ("去叫阿公吃饭", "阿公", Say(text="阿公,吃饭")),
        ("喊小明出来吃饭", "小明", Say(text="小明,出来吃饭")),
        ("跟闺女讲一声该睡觉了", "闺女", Say(text="闺女,该睡觉了")),
        ("跟妈妈说吃完饭再去厨房", "妈妈", Say(text="妈妈,吃完饭再去厨房")),
        ("跟小明说作业写完再看电视", "小明", Say(text="小明,作业写完再看电视")),
        # a question is asked as of themselves
        ("go ask Dad if he wants a cuppa", "Dad", Ask(question="Dad, do you want a cuppa?")),
        (
            "ask Mum if she's taken her tablets",
            "Mum",
            Ask(question="Mum, have you taken your tablets?"),
        ),
        ("ask Mum if she's tired", "Mum", Ask(question="Mum, are you tired?")),
        ("ask Mum how she slept", "Mum", Ask(question="Mum, how did you sleep?")),
        ("ask Mum when she's free", "Mum", Ask(question="Mum, when are you free?")),
        ("问问妈妈想吃什么", "妈妈", Ask(question="妈妈,想吃什么")),
    ],
)
def test_who_is_told_or_asked_without_a_place_is_searched_for(
    home: Vocabulary, said: str, who: str, heard: Say | Ask
) -> None:
    assert plan(said, home, HERE) == StepPlan(steps=(Find(object=who), heard))


@pytest.mark.parametrize(
    "said",
    [
        "don't tell Dad dinner is ready",
        "Dad told me to go to the kitchen",
        "Mum says dinner is ready",
        "tell Dad or Mum",
        "别告诉妈妈我出门了",
        "妈妈跟我说她出门了",
        "不要叫阿公吃饭",
        "叫阿公还是阿婆吃饭",
        "阿公叫我去厨房",
        "我跟妈妈说了去厨房",
        "给妈妈倒杯水",
        "叫外卖给妈妈",
        "叫我起床",
        "ask Dad when he's back if he wants tea",
        "ask Dad when he is back",
        "tell me when Dad is free",
        "whoever is in the kitchen should come here",
        "tell whoever is hungry that dinner is ready",
        "don't say goodnight to Mum",
        "Dad said goodnight to Mum",
    ],
)
def test_talk_a_choice_or_a_time_is_nobody_to_be_told(home: Vocabulary, said: str) -> None:
    assert not isinstance(plan(said, home, HERE), StepPlan)


@pytest.mark.parametrize(
    ("said", "same"),
    [
        ("去找我儿子，问他作业写完没有，回来跟我讲", "问我儿子作业写完没有，然后回来"),
        ("去问问我爸几点出门，问完回来跟我说", "去问问我爸几点出门，然后回来"),
        ("叫老爸接电话，叫完就回去充电", "叫老爸接电话，然后回去充电"),
        (
            "ask Dad if he wants tea and let me know what he says",
            "ask Dad if he wants tea and come back",
        ),
        ("ask Dad if he wants tea and tell me his answer", "ask Dad if he wants tea and come back"),
        (
            "ask whoever's in the kitchen if they want tea",
            "ask anybody in the kitchen if they want tea",
        ),
    ],
)
def test_words_for_people_end_where_the_next_order_begins(
    home: Vocabulary, said: str, same: str
) -> None:
    made = plan(said, home, HERE)
    assert isinstance(made, StepPlan)
    assert made == plan(same, home, HERE)


@pytest.mark.parametrize("said", ["follow Dad", "take Grandma to the kitchen", "跟着奶奶"])
def test_who_is_followed_or_led_is_asked_for(home: Vocabulary, said: str) -> None:
    made = plan(said, home, HERE)
    assert isinstance(made, Clarify)
    assert made.code is Code.INCOMPLETE


def test_whoever_is_there_is_meant_by_them(home: Vocabulary) -> None:
    made = plan("去门口看看谁来了，跟人家说我马上下来", home, HERE)
    assert isinstance(made, StepPlan)
    assert made.steps[-1] == Say(text="我马上下来")


def test_quoted_words_order_nothing(home: Vocabulary) -> None:
    made = plan('say "go to the kitchen and then come back"', home, HERE)
    assert isinstance(made, StepPlan)
    assert made.steps == (Say(text="go to the kitchen and then come back"),)
