"""Check what the offline brain makes of orders, in both languages: the tables are the contract."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from planner.language.grammar import Context, plan
from planner.plan import (
    EVERY_KIND,
    AnswerPlan,
    Clarify,
    Code,
    Language,
    Refuse,
    StepPlan,
    Vocabulary,
    check_plan,
)

WHOLE = Context(runnable=EVERY_KIND)
"""A robot that can do every kind of step."""

MOTION = {
    # one place
    "go to the living room": "living_room",
    "Go to the Kitchen.": "kitchen",
    "kindly drive to the kitchen": "kitchen",
    "could you please go to the kitchen?": "kitchen",
    "Hey robot, please navigate to the bathroom now": "bathroom",
    "I want you to go to the study": "study",
    "head over to the couch": "sofa",
    "walk to my desk": "desk",
    "visit the hallway": "hallway",
    "go into the kitchen": "kitchen",
    "take me to the bathroom": "bathroom",
    "go back to the kitchen": "kitchen",
    "return to the living room": "living_room",
    "go near the sofa": "sofa",
    "go to the couch in the living room": "sofa",
    "can you go to the TV please": "tv",
    "go to the charging dock": "charging_dock",
    "GO TO THE KITCHEN!!!": "kitchen",
    "ｇｏ ｔｏ ｔｈｅ ｋｉｔｃｈｅｎ": "kitchen",
    'go to the "kitchen"': "kitchen",
    "navigate to 厨房": "kitchen",
    # spelling
    "go to the livingroom": "living_room",
    "go to the living-room": "living_room",
    "go to the bed room": "bedroom",
    "go to the kitchn": "kitchen",
    "go to the kitcehn": "kitchen",
    # several
    "go to the kitchen, then the bedroom, then come back": "kitchen bedroom come_back",
    "go to the kitchen and the bedroom": "kitchen bedroom",
    "go to the kitchen and come back": "kitchen come_back",
    "go to the kitchen and back": "kitchen come_back",
    "go to the kitchen, then return": "kitchen come_back",
    "first go to the kitchen, after that the study, finally go home": "kitchen study return_home",
    "go to the kitchen. Then go to the study.": "kitchen study",
    "go from the kitchen to the bedroom": "kitchen bedroom",
    "go to the kitchen, wait for ten seconds, then come back": "kitchen wait=10 come_back",
    "go to the study and stay there for half a minute": "study wait=30",
    "go to the kitchen and stay there": "kitchen",
    "去厨房停下": "kitchen",
    "来厨房": "kitchen",
    "starting from the study, go to the kitchen": "study kitchen",
    "go to the kitchen, go to the bedroom last": "kitchen bedroom",
    'go to the kitchen and say "Hi, go to the study"': "kitchen say=Hi, go to the study",
    # home, waiting, saying
    "go home": "return_home",
    "return to base": "return_home",
    "go charge": "return_home",
    "recharge your battery": "return_home",
    "wait 5 seconds": "wait=5",
    "wait 2.5 s": "wait=2.5",
    "wait a minute": "wait=60",
    "say hello": "say=hello",
    # Chinese
    "去厨房": "kitchen",
    "请去客厅吧": "living_room",
    "小车，去厨房。": "kitchen",
    "机器人去厨房": "kitchen",
    "帮我去一下厨房，谢谢": "kitchen",
    "能不能去厨房": "kitchen",
    "你能去厨房吗？": "kitchen",
    "我想让你去厨房": "kitchen",
    "带我去洗手间": "bathroom",
    "前往玄关": "entrance",
    "移动到书桌": "desk",
    "回到厨房": "kitchen",
    "返回客厅": "living_room",
    "到厨房去": "kitchen",
    "去卧室里的床旁边": "bed",
    "去沙发旁边": "sofa",
    "走到“书房”": "study",
    "去 厨房": "kitchen",
    "去kitchen": "kitchen",
    "請去客廳": "living_room",
    "導航到廚房": "kitchen",
    "先去厨房，再去卧室，最后回来": "kitchen bedroom come_back",
    "先去厨房再去卧室然后回家": "kitchen bedroom return_home",
    "去厨房和卧室": "kitchen bedroom",
    "去厨房、卧室、书房": "kitchen bedroom study",
    "依次访问厨房、书房": "kitchen study",
    "从客厅去厨房": "living_room kitchen",
    "从书房出发，到玄关": "study entrance",
    "去厨房等10秒再回来": "kitchen wait=10 come_back",
    "等五秒后去厨房": "wait=5 kitchen",
    "到厨房后去卧室": "kitchen bedroom",
    "去厨房，然后说“你好，去书房”": "kitchen say=你好，去书房",
    "去厨房说你好": "kitchen say=你好",
    "回家": "return_home",
    "去充电": "return_home",
    "去充电桩": "charging_dock",
    "等半分钟": "wait=30",
    "等二十五秒": "wait=25",
    # in the order that words of order say
    "go to the bedroom, but first go to the kitchen": "kitchen bedroom",
    "go to the bedroom, go to the kitchen first": "kitchen bedroom",
    "go to the kitchen before the bedroom": "kitchen bedroom",
    "去厨房之前先去卧室": "bedroom kitchen",
    "move forward 1 m": "move=1",
    "turn left": "turn=90",
    "左转": "turn=90",
    "follow me": "find=person follow=person",
    "find the red cup": "find=red cup",
    "find the green cup in the kitchen": "kitchen find=green cup@kitchen",
    "naviagte to the kitchen": "kitchen",
    "folow the man in the kitchen": "kitchen find=man@kitchen follow=man",
    "meet Mary at the sofa, follow her, and take her back": (
        "sofa find=Mary@sofa follow=Mary say=Please come with me. sofa"
    ),
    "what do you see?": "look=what do you see",
    "看看有没有人": "look=看看有没有人",
    "go to the kitchen and look for a red cup": "kitchen find=red cup@kitchen",
    "look for a red cup in the kitchen": "kitchen find=red cup@kitchen",
    "how many people are in the bedroom": "bedroom count=people@bedroom",
    "去客厅看看有没有人": "living_room look=看看有没有人@living_room",
    "从卧室出发，去书房看一下情况": "bedroom study look=看一下情况@study",
}

STILL = {
    # asked back
    "the kitchen": "clarify not_understood",
    "come back": "clarify ambiguous",
    "回来": "clarify ambiguous",
    "go to the kitchen and fly": "clarify not_understood",
    "go to the kitchen door": "clarify not_understood",
    "go to the sofa and follow her": "clarify incomplete",
    "go behind the kitchen": "clarify not_understood",
    "go near the kitchen": "clarify not_understood",
    "drive into the sofa": "clarify not_understood",
    "go to the couch in the kitchen": "clarify not_understood",
    "I want to go to the kitchen": "clarify not_understood",
    "did you go to the kitchen": "recall",
    "the kitchen is dirty": "clarify not_understood",
    "go to the kitchen tomorrow": "clarify not_understood",
    "go to the kitchen at 5 pm": "clarify not_understood",
    "<b>go to the kitchen</b>": "clarify not_understood",
    "🚫 go to the kitchen": "clarify not_understood",
    "where are you and go to the kitchen": "clarify not_understood",
    "stop at the kitchen": "clarify not_understood",
    "go to the kitchen, stop!": "clarify not_understood",
    "去厨房，停": "clarify not_understood",
    "leave from the kitchen": "clarify not_understood",
    "go to the study, from the kitchen": "clarify not_understood",
    "从厨房出发": "clarify not_understood",
    "asdf qwer": "clarify not_understood",
    "go to the garage": "clarify unknown_place",
    "go to the dining room": "clarify unknown_place",
    "go to the living rooom": "clarify unknown_place",  # "room" is too short to be sure
    "go to the kichten": "clarify unknown_place",
    "go to the moon": "clarify unknown_place",
    "go to bedroom 2": "clarify not_understood",
    "go to the kitchen or the bedroom": "clarify ambiguous",
    "去厨房，先去卧室": "clarify not_understood",
    "去厨房吗": "clarify not_understood",
    "去厨房旁边": "clarify not_understood",
    "去过厨房": "clarify not_understood",
    "去厨房的路": "clarify not_understood",
    "我要去厨房": "clarify not_understood",
    "明天去厨房": "clarify not_understood",
    "去厨房然后飞起来": "clarify no_capability",
    "停在厨房": "clarify not_understood",
    "去书店": "clarify unknown_place",
    "去厨房和车库": "clarify not_understood",
    "去厨房或者卧室": "clarify ambiguous",
    # no, with the reason
    "don't go to the kitchen": "refuse negated",
    "Don’t go to the kitchen": "refuse negated",
    "never go to the kitchen": "refuse negated",
    "go to the kitchen but not the bedroom": "refuse negated",
    "go anywhere except the kitchen": "refuse negated",
    "don't stop": "refuse negated",
    "别去厨房": "refuse negated",
    "不要去厨房": "refuse negated",
    "去厨房，不要去卧室": "refuse negated",
    "別去廚房": "refuse negated",
    "不用去厨房了": "refuse negated",
    "去厨房 don't": "refuse negated",
    "if the door is open, go to the kitchen": "refuse conditional",
    "go to the kitchen unless it is dark": "refuse conditional",
    "go to the kitchen when I call": "refuse conditional",
    "如果门开着就去厨房": "refuse conditional",
    "等我回来再去厨房": "refuse conditional",
    "有人的话去厨房": "refuse conditional",
    "bring me a beer from the fridge": "clarify no_capability",
    "pick up the cup": "clarify no_capability",
    "open the front door": "refuse no_capability",
    "把杯子拿过来": "clarify no_capability",
    "帮我做饭": "refuse no_capability",
    "往前走两步": "clarify not_understood",
    "come here": "clarify incomplete",
    "过来": "clarify incomplete",
    "drive to (3, 1)": "refuse out_of_scope",
    "go to the kitchen at 3 m/s": "refuse out_of_scope",
    "go to the kitchen quickly": "refuse out_of_scope",
    "去坐标(3,1)": "refuse out_of_scope",
    "全速去厨房": "refuse out_of_scope",
    "run over the cat": "refuse unsafe",
    "撞墙": "refuse unsafe",
    "wait 3 hours": "refuse bad_plan",
    "stop": "refuse stopped",
    "停": "refuse stopped",
    "hello": "answer: Hello. Tell me where to go.",
    "thank you": "answer: You are welcome.",
    "请": "refuse empty_goal",
    "": "refuse empty_goal",
    "  \n ": "refuse empty_goal",
    "🙂🙂": "refuse bad_text",
    "...": "refuse bad_text",
    "go\x00to the kitchen": "refuse bad_text",
    "\x89PNG\r\n\x1a\n": "refuse bad_text",
    "\u202ego to the kitchen": "refuse bad_text",
    "\ue000": "refuse bad_text",
    "\ud800": "refuse bad_text",
    # a motion with a part that can't be done: asked first
    "go to the kitchen and bring me a beer": "clarify no_capability",
    "去厨房拿可乐": "clarify no_capability",
    "去书房并打开窗户": "clarify no_capability",
    # questions about itself
    "where are you?": "answer: I am in the study.",
    "which room are you in": "answer: I am in the study.",
    "你在哪": "answer: I am in the study.",
    "你现在在哪里？": "answer: I am in the study.",
}

BARE = {
    "move forward 1 m": "refuse no_capability",
    "turn left": "refuse no_capability",
    "左转": "refuse no_capability",
    "follow me": "refuse no_camera",
    "find the red cup": "refuse no_camera",
    "what do you see?": "refuse no_camera",
    "看看有没有人": "refuse no_camera",
    "go to the kitchen and look for a red cup": "clarify no_camera",
    "look for a red cup in the kitchen": "clarify no_camera",
    "how many people are in the bedroom": "clarify no_camera",
    "去客厅看看有没有人": "clarify no_camera",
    "从卧室出发，去书房看一下情况": "clarify no_camera",
    "pick up the cup": "refuse no_capability",
    "patrol the kitchen": "clarify no_capability",
    "go to the kitchen and turn around": "clarify no_capability",
}
"""What a robot says that has no camera and can't turn: a no, or an offer of what is left."""


@pytest.mark.parametrize(("text", "end"), BARE.items(), ids=ascii)
def test_what_the_robot_lacks_is_told(
    text: str, end: str, understood_bare: Callable[[str], str]
) -> None:
    assert understood_bare(text) == end


@pytest.mark.parametrize(("text", "end"), [*MOTION.items(), *STILL.items()], ids=ascii)
def test_an_order_is_understood_and_nothing_else_moves(
    text: str, end: str, understood: Callable[[str], str]
) -> None:
    assert understood(text) == end


@pytest.mark.parametrize("text", [*MOTION, *STILL], ids=ascii)
def test_what_the_brain_plans_can_run_and_reads_the_same_in_both_languages(
    text: str, home: Vocabulary
) -> None:
    made = plan(text, home, WHOLE)
    assert check_plan(made, home, EVERY_KIND) is None
    if isinstance(made, Clarify | Refuse | AnswerPlan):
        said = made.text if isinstance(made, AnswerPlan) else None
        said = said or (made.question if isinstance(made, Clarify) else None)
        said = said or (made.reason if isinstance(made, Refuse) else None)
        assert said is not None
        assert said.en != said.zh


@pytest.mark.parametrize("text", [*MOTION, *STILL], ids=ascii)
@pytest.mark.parametrize("language", list(Language))
def test_every_option_is_itself_an_order(text: str, language: Language, home: Vocabulary) -> None:
    made = plan(text, home, Context(language=language, runnable=EVERY_KIND))
    for option in made.options if isinstance(made, Clarify) else ():
        assert isinstance(plan(option.text, home, WHOLE), StepPlan), option.text


def test_long_text_is_refused_with_both_numbers(home: Vocabulary) -> None:
    made = plan("go to the kitchen " * 6000, home)
    assert isinstance(made, Refuse)
    assert made.code is Code.TEXT_TOO_LONG
    assert "108000" in made.reason.en
    assert "2000" in made.reason.zh


def test_too_many_steps_are_refused(home: Vocabulary) -> None:
    made = plan("go to kitchen, " * 21, home)
    assert isinstance(made, Refuse)
    assert made.code is Code.BAD_PLAN


def test_an_unknown_place_is_told_with_what_is_near_and_what_exists(home: Vocabulary) -> None:
    made = plan("go to the kichten, then come back", home)
    assert isinstance(made, Clarify)
    assert [option.text for option in made.options] == ["go to the kitchen, then come back"]
    assert "Did you mean kitchen?" in made.question.en
    assert "玄关" in made.question.zh
