"""What leans on the goal before it means what a person means, and cancels nothing by chance."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from planner.language.sentence import parse
from planner.mission.effects import AskBrain
from planner.mission.events import Submitted
from planner.mission.follow_up import LEANS_S
from planner.mission.open_questions import find_offered_plan
from planner.mission.reducer import advance
from planner.mission.state import MissionState
from planner.plan import (
    ChangedOrder,
    Clarify,
    Code,
    ComeBack,
    Count,
    Find,
    GoalState,
    GoTo,
    Language,
    Look,
    Option,
    Patrol,
    Say,
    StepPlan,
    say_same,
)
from tests.planner.mission.leaning import (
    FACTS,
    NOW_S,
    changed_by,
    drive_under_way,
    each,
    heard,
    means,
    newest,
    order_asked_about,
    order_done,
    order_running,
    order_under_way,
    steps_after,
)

BARE = MissionState(FACTS)
BEDROOM = drive_under_way("go to the bedroom", "bedroom")
ZH = order_under_way("去卧室找我的杯子")
EITHER = drive_under_way("go to the kitchen or the study, whichever you like", "kitchen")

MEANINGS: tuple[tuple[MissionState, str, str | None], ...] = (
    *each(BEDROOM, "go to the study", "no, I meant the study", "No, sorry, the study."),
    *each(BEDROOM, "go to the study", "oh no, I meant the study, sorry", "no I meant the study"),
    *each(BEDROOM, "go to the study", "No, the study!", "not the bedroom, the study", "不对，书房"),
    *each(BEDROOM, "go to the study", "哦不好意思，我说的是书房", "no no, the study"),
    (BEDROOM, "hmm no, try the study first", "go to the study"),
    *each(ZH, "去书房找我的杯子", "不是不是，是书房", "不对，书房", "不是卧室，是书房"),
    *each(ZH, "去书房找我的杯子", "哎不是，我说的是书房", "不对，应该在书房", "哎等等，我是说书房"),
    (ZH, "不是那儿，是书房那边", "去书房找我的杯子"),
    *each(BEDROOM, "go to the kitchen", "sorry, I meant the kitchen", "and then the kitchen too"),
    *each(BEDROOM, "go to the kitchen", "the kitchen as well", "I meant the kitchen, go there"),
    (BEDROOM, "oh wait, the kitchen I mean", "go to the kitchen"),
    *each(BEDROOM, "go to the kitchen", "and then on to the kitchen", "and the kitchen?"),
    (BEDROOM, "对不起，不对，去书房", "去书房"),
    (BEDROOM, "and then come back", "come back"),
    *each(BEDROOM, "go to the bedroom", "again", "do that again, please", "再来一次"),
    (BEDROOM, "do that twice more", "go to the bedroom 2 times"),
    (BEDROOM, "three more times", "go to the bedroom 3 times"),
    (BEDROOM, "not there, by the desk", "go to the desk"),
    (BEDROOM, "and then have a look in the study", "have a look in the study"),
    (BEDROOM, "还是去厨房吧", "去厨房"),
    (ZH, "还有厨房", "去厨房找我的杯子"),
    (ZH, "然后再去厨房", "去厨房"),
    (ZH, "again", "去卧室找我的杯子"),
    (ZH, "再找两次", "去卧室找我的杯子2次"),
    (ZH, "找完再去客厅看看", "去客厅看看"),
    (ZH, "巡逻完了就回家", "回家"),
    *each(EITHER, "go to the study", "the other one", "no, the other one", "另一个"),
)


@pytest.mark.parametrize(("book", "text", "order"), MEANINGS)
@pytest.mark.parametrize("frame", ["{}", " {} ", "{}.", "um, {}", "{}!!"])
def test_a_sentence_means_what_it_leans_on_whatever_courtesy_and_noise_are_around_it(
    frame: str, book: MissionState, text: str, order: str
) -> None:
    assert means(book, frame.format(text), order)


@pytest.mark.parametrize("text", [text for book, text, _ in MEANINGS if book is EITHER])
def test_what_is_in_doubt_stays_as_it_was_said(text: str) -> None:
    assert changed_by(BEDROOM, text) is None
    assert changed_by(BARE, text) is None


@pytest.mark.parametrize("text", ["again", "do that again", "再来一次", "the other one"])
def test_what_was_long_ago_is_not_meant(text: str) -> None:
    assert changed_by(EITHER, text, LEANS_S + 1.0) is None


@pytest.mark.parametrize(
    "text",
    [
        "no, the dinner is ready",
        "no, not yet",
        "no",
        "no, that's fine",
        "and you?",
        "me too",
        "不，我很好",
        "不是的",
        "不好意思",
        "不好意思，我很好",
        "不好意思，去书房",
        "say hello again",
        "go to the kitchen; if you can't get in, wait in the hallway instead",
        "if the door is open, go to the study instead",
        "go to the kitchen or, if you can't, to the study instead",
        "如果进不去就改去书房",
        "no, if it rains",
    ],
)
def test_what_is_no_correction_takes_nothing_back(text: str) -> None:
    assert changed_by(BEDROOM, text) is None
    taken = heard(BEDROOM, text)
    assert taken.takes_back is None
    assert (taken.given.first, taken.given.replace) == (False, False)


@pytest.mark.parametrize(("text", "ends"), [
    ("no, I meant the study", True), ("不对，书房", True), ("forget that, go home", True),
    ("哦不好意思，我说的是书房", True),
    ("and then the kitchen too", False), ("again", False), ("还有厨房", False),
])  # fmt: skip
def test_a_correction_ends_what_runs_and_an_addition_waits_for_it(text: str, ends: bool) -> None:
    assert (heard(BEDROOM, text).takes_back == "g0") is ends
    assert heard(BEDROOM, text).given.first is (text != "again")


def test_the_goal_keeps_both_what_was_said_and_what_it_means() -> None:
    given = heard(BEDROOM, "again").given
    book, effects = advance(BEDROOM, given, NOW_S)
    assert (book.missions["new"].text, book.missions["new"].words) == ("again", "again")
    asks = [each for each in effects if isinstance(each, AskBrain)]
    assert [(each.text, each.changed) for each in asks] == [("again", given.changed)]
    assert given.changed == ChangedOrder(steps=(GoTo(place="bedroom"),))


@pytest.mark.parametrize(
    "said", ["the second one", "number two", "2", "第二个", "the study, please", "the study"]
)
def test_an_order_that_a_question_offers_is_chosen_aloud(said: str) -> None:
    options = tuple(Option(text=f"go to the {place}", label=say_same(f"go to the {place}"))
                    for place in ("kitchen", "study"))  # fmt: skip
    asks = Clarify(code=Code.AMBIGUOUS, question=say_same("Which one?"), options=options)
    book = order_asked_about("go to the kitchen or the study", asks)
    assert means(book, said, "go to the study")
    assert changed_by(book, "the third one") is None


@pytest.mark.parametrize("said", ["the second one", "option 2", "第二个", "go to the study"])
def test_of_plans_laid_side_by_side_the_one_that_is_named_is_done_as_it_stands(said: str) -> None:
    options = tuple(Option(text=f"go to the {place}", label=say_same(f"go to the {place}"),
                           plan=StepPlan(steps=(GoTo(place=place),)))
                    for place in ("kitchen", "study"))  # fmt: skip
    asks = Clarify(code=Code.NOT_UNDERSTOOD, question=say_same("Which?"), options=options)
    asking = newest(order_asked_about("study or so", asks))
    assert find_offered_plan(asking, said) == options[1].plan
    assert find_offered_plan(asking, "the third one") is None


DRIVES = order_under_way(
    "go to the bedroom, the bathroom and the hallway",
    *(GoTo(place=room) for room in ("bedroom", "bathroom", "hallway")),
)
ROUND = (
    GoTo(place="kitchen"), Look(question="see if anyone is there", place="kitchen"),
    GoTo(place="bedroom"), Look(question="see if anyone is there", place="bedroom"),
    GoTo(place="study"), Look(question="see if anyone is there", place="study"),
)  # fmt: skip
LOOKING = order_running("go round and see if anyone is there", *ROUND)
ROUND_ZH = (
    *(
        each if isinstance(each, GoTo) else Look(question="看看有没有人", place=each.place)
        for each in ROUND
    ),
    ComeBack(),
)
LOOKING_ZH = order_running("转一圈看看有没有人", *ROUND_ZH)
PATROL = order_running("patrol", Patrol(places=("kitchen", "bedroom", "study"), look=True))
SEEKING = order_running("go find my cup", Find(object="cup"))
ONE = order_running("go to the bedroom", GoTo(place="bedroom"))
GRANDPA = order_running("去卧室看看姥爷", GoTo(place="bedroom"))
TELLING = order_under_way(
    "greet all", GoTo(place="kitchen"), GoTo(place="bedroom"), Say(text="Hello")
)
LEFT_OUT = ("not the bedroom", "skip the bedroom", "don't go into the bedroom, Anna's asleep",
            "you can leave out the bedroom", "never mind the bedroom")  # fmt: skip
LEFT_OUT_ZH = ("卧室就别进了，孩子睡着呢", "卧室就别进了，大刘在换衣服", "卧室别进去", "别去卧室了",
               "卧室不用看了")  # fmt: skip
FIRST = ("do the bedroom first", "start with the bedroom, please", "the bedroom first")


def looks_for_a_cup(steps: tuple[Any, ...]) -> set[str | None]:
    """Return the rooms in which steps ask for a cup."""
    asked = "see if there is a cup"
    return {each.place for each in steps if isinstance(each, Look) and each.question == asked}


def takes(book: MissionState, text: str) -> bool:
    """Tell whether a sentence ends what runs, for an order without a stop."""
    taken = heard(book, text)
    return taken.takes_back == "g0" and not taken.stops


BUT_BEDROOM = {place.id for place in FACTS.targets.values() if place.room} - {"bedroom"}


@pytest.mark.parametrize(
    ("text", "left"),
    [("skip the bathroom", "go to the bedroom, then go to the hallway"),
     ("leave the bedroom out", "go to the bathroom, then go to the hallway"),
     ("skip the kitchen", None),
     ("you can leave out the bathroom", "go to the bedroom, then go to the hallway"),
     ("except the bathroom", "go to the bedroom, then go to the hallway"),
     ("except my dog", None),
     ("跳过卫生间，有人在洗澡", "go to the bedroom, then go to the hallway"),
     ("厨房别进去", None),
     ("除了卫生间", "go to the bedroom, then go to the hallway"),
     ("跳过卫生间", "go to the bedroom, then go to the hallway")],
)  # fmt: skip
def test_a_place_is_left_out_of_what_is_still_to_do(text: str, left: str | None) -> None:
    assert means(DRIVES, text, left)
    assert (heard(DRIVES, text).takes_back == "g0") is (left is not None)


@pytest.mark.parametrize("said", LEFT_OUT)
def test_the_rest_of_a_round_goes_on(said: str) -> None:
    assert steps_after(LOOKING, said) == (*ROUND[:2], *ROUND[4:])
    assert means(PATROL, said, "patrol the kitchen and the study")
    assert looks_for_a_cup(steps_after(SEEKING, said)) == BUT_BEDROOM
    assert all(takes(book, said) for book in (LOOKING, PATROL, SEEKING))


@pytest.mark.parametrize("said", LEFT_OUT_ZH)
def test_so_it_does_in_chinese(said: str) -> None:
    assert steps_after(LOOKING_ZH, said) == (*ROUND_ZH[:2], *ROUND_ZH[4:])
    assert takes(LOOKING_ZH, said)


@pytest.mark.parametrize("book", [ONE, TELLING, order_done("round", *ROUND)])
@pytest.mark.parametrize("said", [*LEFT_OUT, *LEFT_OUT_ZH])
def test_who_goes_to_that_place_alone_or_does_more_is_not_sent_elsewhere(
    book: MissionState, said: str
) -> None:
    assert changed_by(book, said) is None


@pytest.mark.parametrize("text", ["厨房别进去", "别进厨房", "不要进去", "别去厨房"])
def test_a_denial_that_leaves_no_place_out_stops(text: str) -> None:
    thinking, _ = advance(BARE, Submitted("g0", "把所有房间都转一圈", Language.ZH), NOW_S)
    assert (heard(thinking, text).stops, heard(thinking, text).takes_back) == (True, None)


@pytest.mark.parametrize("said", ["don't go into the bedroom", "卧室别进去"])
def test_a_denial_that_leaves_nothing_out_stops_first_and_sets_nothing_in_motion_that_stands(
    said: str,
) -> None:
    assert heard(ONE, said).stops
    paused = order_under_way("go round and see if anyone is there", *ROUND)
    assert newest(paused).state is GoalState.PAUSED
    assert changed_by(paused, said) is None


@pytest.mark.parametrize("said", FIRST)
def test_a_place_of_the_round_comes_first(said: str) -> None:
    assert steps_after(LOOKING, said) == (*ROUND[2:4], *ROUND[:2], *ROUND[4:])
    assert means(PATROL, said, "patrol the bedroom and the kitchen and the study")
    assert takes(LOOKING, said)
    assert steps_after(TELLING, said) != steps_after(LOOKING, said)


@pytest.mark.parametrize("said", ["先去卧室", "先看卧室吧", "从卧室开始"])
def test_so_it_comes_first_in_chinese(said: str) -> None:
    assert steps_after(LOOKING_ZH, said) == (*ROUND_ZH[2:4], *ROUND_ZH[:2], *ROUND_ZH[4:])
    assert changed_by(ONE, said) is None


@pytest.mark.parametrize(
    "said", ["it's not in the bedroom, I've just looked", "it isn't in the bedroom either"]
)
def test_where_it_is_not_nobody_looks_for_it(said: str) -> None:
    assert looks_for_a_cup(steps_after(SEEKING, said)) == BUT_BEDROOM
    drives = order_running("go", GoTo(place="kitchen"), GoTo(place="bedroom"))
    assert changed_by(drives, said) is None


@pytest.mark.parametrize(
    "said", ["not the bedroom", "no, not the bedroom", "I didn't say the bedroom", "不是卧室",
             "I never said the bedroom", "我说的不是卧室"],
)  # fmt: skip
def test_who_is_on_the_way_to_a_wrong_place_stops(said: str) -> None:
    assert heard(ONE, said).stops
    other = order_running("go to the study", GoTo(place="study"))
    assert heard(other, said).stops is parse(said).may_mean_stop


@pytest.mark.parametrize(
    ("book", "text"),
    [
        (ONE, "not the bedroom, he's in the study"),
        (GRANDPA, "不是卧室，他在书房看报呢"),
        (GRANDPA, "不是卧室，在书房"),
    ],
)
def test_a_wrong_destination_stops_whatever_is_said_behind_it(
    book: MissionState, text: str
) -> None:
    assert heard(book, text).stops or heard(book, text).takes_back == "g0"


SLOW = replace(LOOKING, missions={"g0": newest(LOOKING).model_copy(update={"speed_share": 0.5})})
COUNTING = order_under_way(
    "count the chairs in the kitchen and the bedroom",
    *(Count(object="chairs", place=place) for place in ("kitchen", "bedroom")),
)
COUNTING_ZH = order_under_way(
    "去厨房和客厅数椅子",
    *(Count(object="椅子", place=place) for place in ("kitchen", "living_room")),
)
SEARCH = order_under_way("find my red cup", Find(object="red cup"))
SEARCH_ZH = order_under_way("找红杯子", Find(object="红杯子"))
CORRIDOR = Patrol(places=("kitchen", "hallway"), look=True)
WIDENED = order_running("patrol the kitchen and the hallway", CORRIDOR)
WIDENED_ZH = order_running("巡逻厨房和走廊", CORRIDOR)
COUNTED = order_done("count the cups in the kitchen")
COUNTED_ZH = order_done("数一下厨房的杯子")
COUNTS = order_running("count the cups in the kitchen", Count(object="cup", place="kitchen"))
COUNTS_ZH = order_running("数一下厨房的杯子", Count(object="杯子", place="kitchen"))
SAID_ZH = order_done("去厨房说吃饭了", GoTo(place="kitchen"), Say(text="吃饭了"))
DAD = order_under_way("tell Dad in the study that tea is ready")
DAD_ZH = order_under_way("去书房叫爸爸吃饭")
DAD_HEARS_ZH = order_under_way("告诉爸爸饭好了")
MUM_ZH = order_under_way("跟卧室的妈妈说我出门了")
SAYS = order_under_way("go to the study and say tea is ready")
SAYS_ZH = order_under_way("去书房说吃饭了")
MUM_THERE = order_done("tell Mum in the kitchen lunch is ready")
MUM_BARE = order_done("tell Mum lunch is ready")
MUM_THERE_ZH = order_done("去厨房告诉妈妈吃饭了")
SEES_TO = "see to the kitchen and the study"
COUNTED_BOTH = order_done(
    SEES_TO, *(Count(object="cup", place=place) for place in ("kitchen", "study"))
)
PATROLLED_BOTH = order_done(SEES_TO, Patrol(places=("kitchen", "study"), look=True))
BACKPACK = order_under_way("look for my backpack in the kitchen")
ON_BED = order_under_way("go to the bedroom and see if the cat is on the bed")
GRANDMA = "tell Grandma in the study that tea is ready"
MUM_MOVED = "tell Mum in the study lunch is ready"
BACKPACK_MOVED = "look for the backpack in the study"
RED_CUP = "look for the red cup in the study"
CAT_MOVED = "go to the living room and see if the cat is on the sofa"


@pytest.mark.parametrize(
    ("book", "said", "order"),
    [
        # What was looked for is asked of one more place, and a search without a place narrowed.
        (COUNTING, "and in the study?", "count the chairs in the study"),
        *each(COUNTING, "count the chairs in the study", "what about the study?", "and the study?"),
        *each(SEARCH, RED_CUP, "and in the study?", "what about the study?", "and the study?"),
        (SEARCH, "no, the study", RED_CUP),
        *each(COUNTING_ZH, "数一下书房的椅子", "书房呢", "那书房里呢"),
        *each(SEARCH_ZH, "去书房找红杯子", "书房呢", "那书房里呢"),
        # A look that is asked for says nothing there.
        (SAID_ZH, "书房也瞅瞅", "去书房看看"),
        # What follows a place waits for what is done there.
        (COUNTS, "when you're done in the kitchen, go to the study", "go to the study"),
        (COUNTS, "when you're done, go to the study", "go to the study"),
        (COUNTS, "once you've finished the kitchen, come back", "come back"),
        (COUNTS, "when you're done in the bedroom, go to the study", None),
        (COUNTS_ZH, "数完厨房，顺便去书房看看", "去书房看看"),
        (COUNTS_ZH, "数完了去书房", "去书房"),
        (COUNTS_ZH, "数完卧室去书房", None),
        # One more place is counted in.
        *each(COUNTED_ZH, "数一下书房的杯子", "书房也数一下", "不够，书房的也数一下"),
        (COUNTED_ZH, "书房也帮我数一遍呗", "数一下书房的杯子"),
        # One more person is told the same.
        *each(DAD, GRANDMA, "and Grandma too", "Grandma as well"),
        *each(DAD_ZH, "去书房叫奶奶吃饭", "顺便叫上奶奶", "奶奶也叫一下", "还有奶奶"),
        (DAD_ZH, "也叫奶奶一声", "去书房叫奶奶吃饭"),
        *each(DAD_HEARS_ZH, "告诉奶奶饭好了", "跟奶奶也说一声", "也跟奶奶说一声"),
        *each(DAD_HEARS_ZH, "告诉奶奶饭好了", "再去跟奶奶也说一声", "奶奶那边也说一下"),
        (DAD_HEARS_ZH, "奶奶也告诉一声", "告诉奶奶饭好了"),
        # The same person is told more.
        (MUM_ZH, "还要讲晚上不回来吃饭", "跟卧室的妈妈说“晚上不回来吃饭”"),
        (MUM_ZH, "再跟她说一声晚上不回来吃饭", "跟卧室的妈妈说“晚上不回来吃饭”"),
        # Who else is meant waits until it is known where the first is.
        (order_asked_about("去叫爸爸吃饭"), "顺便叫上奶奶", None),
        # Another person is told in place of the first, or other words are said.
        *each(DAD, GRANDMA, "no, tell Grandma", "sorry, I meant Grandma", "tell Grandma instead"),
        *each(DAD_ZH, "去书房叫奶奶吃饭", "不对，是告诉奶奶", "我说的是奶奶", "错了，叫奶奶"),
        (SAYS, "say lunch is ready instead", "go to the study and say lunch is ready"),
        (SAYS, "no, say lunch is ready", "go to the study and say lunch is ready"),
        *each(SAYS_ZH, "去书房说开会了", "不，说“开会了”", "换成说开会了吧"),
        # Who is elsewhere is told there, and what is sought is sought there.
        *each(MUM_THERE_ZH, "去书房告诉妈妈吃饭了", "不对，她在书房呢", "她不在厨房，在书房"),
        (MUM_THERE_ZH, "不，她现在在书房", "去书房告诉妈妈吃饭了"),
        (BACKPACK, "no, it's in the study", BACKPACK_MOVED),
        (BACKPACK, "it's not in the kitchen, it's in the study", BACKPACK_MOVED),
        # A thing in a room is corrected with its room; a room without the thing is asked about.
        *each(ON_BED, CAT_MOVED, "no, the sofa", "I meant the sofa"),
        (ON_BED, "No, sorry, the living room, on the sofa.", CAT_MOVED),
        *each(ON_BED, None, "no, the kitchen", "no, the study, on the sofa"),
        # A correction of two places is no bare drive.
        (COUNTED_BOTH, "no, the bedroom", None),
        (PATROLLED_BOTH, "no, the bedroom", None),
        # A slow round is not made a fast one, and who has one place to go to leaves none out.
        (SLOW, "skip the bedroom", None),
        (BEDROOM, "skip the bedroom", None),
        (BARE, "skip the bedroom", None),
    ],
)
def test_an_order_is_widened_narrowed_or_corrected(
    book: MissionState, said: str, order: str | None
) -> None:
    assert means(book, said, order)


@pytest.mark.parametrize(
    "said",
    ["no, she's in the study", "No, she's in the study now, not the kitchen.",
     "she's not in the kitchen, she's in the study", "wait, she is actually in the study"],
)  # fmt: skip
def test_who_is_elsewhere_is_told_there(said: str) -> None:
    assert means(MUM_THERE, said, MUM_MOVED)
    assert means(MUM_BARE, said, MUM_MOVED)


@pytest.mark.parametrize(
    "said",
    ["and the study while you're at it", "do the study too", "and the study as well",
     "include the study", "take in the study as well, please"],
)  # fmt: skip
def test_one_more_place_joins_a_patrol_that_runs_and_is_counted_in(said: str) -> None:
    assert means(WIDENED, said, "patrol the kitchen and the hallway and the study")
    taken = heard(WIDENED, said)
    assert (taken.takes_back, taken.given.first, taken.stops) == ("g0", True, False)
    assert means(COUNTED, said, "count the cups in the study")


@pytest.mark.parametrize(
    "said", ["书房也去一下", "顺便把书房也看一下", "书房也加上", "书房也转一圈吧"]
)
def test_so_it_joins_in_chinese(said: str) -> None:
    assert means(WIDENED_ZH, said, "巡逻厨房、走廊、书房")


@pytest.mark.parametrize("said", ["and Grandma too", "Grandma as well"])
def test_who_is_told_too_waits_for_what_runs(said: str) -> None:
    assert (heard(DAD, said).takes_back, heard(DAD, said).given.first) == (None, True)


@pytest.mark.parametrize(
    ("books", "sayings"),
    [
        ((LOOKING,), ("not the bedroom or the study", "not the bedroom if she sleeps",
                      "don't go into the bedroom or the study", "not the garden")),
        ((COUNTED, COUNTED_ZH, WIDENED),
         ("do the dishes too", "add the milk", "别数书房", "书房别数了")),
        ((DAD,), ("me too", "and me", "and the robot too", "and Dad", "and Dad?")),
        ((DAD_ZH,), ("还要吃饭", "还要说什么", "爸爸呢", "顺便看看")),
        ((SAYS,), ("say lunch is ready", "if Dad is there, say lunch is ready")),
        ((MUM_THERE,),
         ("no, he's in the study", "she's in the study", "no, she's in the kitchen",
          "she's not in the bathroom, she's in the study", "no, she's asleep",
          "is she in the study?", "no, she's in the study if Dad is there", "她在书房")),
    ],
    ids=["two_places_or_none", "no_place", "nobody", "nobody_zh", "own_order", "nobody_elsewhere"],
)  # fmt: skip
def test_another_sentence_changes_nothing(
    books: tuple[MissionState, ...], sayings: tuple[str, ...]
) -> None:
    assert [said for book in books for said in sayings if changed_by(book, said)] == []
