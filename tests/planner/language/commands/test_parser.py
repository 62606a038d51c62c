"""What is said to the planner itself is heard in whole sentences, and nothing else is."""

from __future__ import annotations

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from planner.language.commands import (
    BatteryCommand,
    CancelCommand,
    Doing,
    Faster,
    Forget,
    HereCommand,
    Intent,
    OutcomeCommand,
    PauseCommand,
    Remember,
    Replace,
    ResumeCommand,
    Slower,
    TeachFact,
    WhereCommand,
    intent_of,
)

ENGLISH: tuple[tuple[str, Intent], ...] = (
    ("remember this as charging dock", Remember("charging dock")),
    ("Remember this spot as “Grandma's Chair”, please.", Remember("Grandma's Chair")),
    ("call this place grandma's chair", Remember("grandma's chair")),
    ("ok robot, save this location as the printer", Remember("printer")),
    ("this place is called the quiet corner", Remember("quiet corner")),
    ("remember this as 奶奶的椅子", Remember("奶奶的椅子")),
    ("remember this as dangerous goods store", Remember("dangerous goods store")),
    ("forget the place charging dock", Forget("charging dock")),
    ("you are in the kitchen", HereCommand("kitchen")),
    ("You're now at the charging dock.", HereCommand("charging dock")),
    ("你在厨房", HereCommand("厨房")),
    ("你现在在客厅里", HereCommand("客厅")),
    ("delete the place called printer", Forget("printer")),
    ("forget where the printer is", Forget("printer")),
    ("continue", ResumeCommand()),
    ("Ok, please continue!", ResumeCommand()),
    ("can you continue?", ResumeCommand()),
    ("go on with the current job", ResumeCommand()),
    ("keep going", ResumeCommand()),
    ("fine, carry on then", ResumeCommand()),
    ("okay, off you go", ResumeCommand()),
    ("不用找了，就在我手上", CancelCommand()),
    ("right then, go on please", ResumeCommand()),
    ("you can go on now", ResumeCommand()),
    ("right, carry on", ResumeCommand()),
    ("Right then, you can carry on", ResumeCommand()),
    ("ok, keep looking", ResumeCommand()),
    ("that's better, carry on", ResumeCommand()),
    ("hold on a second", PauseCommand()),
    ("just a moment, please", PauseCommand()),
    ("wait a second", PauseCommand()),
    ("a bit slower please", Slower()),
    ("Drive slowly, if you please, my feet hurt", Slower()),
    ("can you go a bit faster? you're so slow", Faster()),
    ("why did you just stop?", Doing()),
    ("tell me what she said", OutcomeCommand()),
    ("remember I lent my red backpack to Sam", TeachFact("I lent my red backpack to Sam")),
    (
        "remember the keys are on the desk, in case I ask you later",
        TeachFact("the keys are on the desk"),
    ),
    ("ok, you can speed up again", Faster()),
    ("are you running low on battery?", BatteryCommand()),
    ("你是不是快没电了", BatteryCommand()),
    ("你现在在干嘛", Doing()),
    ("did you find it?", OutcomeCommand()),
    ("how many were there?", OutcomeCommand()),
    ("and what did she say?", OutcomeCommand()),
    ("was it there?", OutcomeCommand()),
    ("找到了吗？", OutcomeCommand()),
    ("有几个", OutcomeCommand()),
    ("那他怎么说", OutcomeCommand()),
    ("结果怎么样", OutcomeCommand()),
    ("what's next?", Doing()),
    ("why?", Doing()),
    ("下一个去哪", Doing()),
    ("到了没", Doing()),
    ("走吧", ResumeCommand()),
    ("never mind, I've got it", CancelCommand()),
    ("forget it, it's already here", CancelCommand()),
    ("不用找了，我找到了", CancelCommand()),
    ("算了，没关系", CancelCommand()),
    ("don't trouble yourself", CancelCommand()),
    ("wrong way, go to the study", Replace("go to the study", now=True)),
    ("don't trouble, I've found it. Just come back", Replace("come back", now=True)),
    (
        "never mind, I can hear her in the kitchen, go to the study",
        Replace("go to the study", now=True),
    ),
    ("forget it, if she is in go to the study", Replace("if she is in go to the study", now=True)),
    ("不用去了，我听到她在客厅讲话了，去书房", Replace("去书房", now=True)),
    ("never mind, I have to go to work", Replace("I have to go to work", now=True)),
    ("pause for a moment", PauseCommand()),
    ("pause for now", PauseCommand()),
    ("one moment", PauseCommand()),
    ("pause the current trip", PauseCommand()),
    ("cancel this order", CancelCommand()),
    ("never mind", CancelCommand()),
    ("NEVERMIND.", CancelCommand()),
    ("forget about it", CancelCommand()),
    ("don't go there any more", CancelCommand()),
    ("don't go to the kitchen any more", CancelCommand()),
    ("no need to look for the cup any more", CancelCommand()),
    ("there is no need to search", CancelCommand()),
    ("You don't need to follow me.", CancelCommand()),
    ("drop the search", CancelCommand()),
    ("resume the search", ResumeCommand()),
    ("no need to look for it, go to the kitchen", Replace("go to the kitchen", now=True)),
    ("forget that, come here", Replace("come here", now=True)),
    ("never mind, go to the Kitchen", Replace("go to the Kitchen", now=True)),
    ("forget that go to the kitchen", Replace("go to the kitchen", now=True)),
    ("scratch that and come back", Replace("come back", now=True)),
    ("cancel it and come back", Replace("come back", now=True)),
    ("don't go. come back", Replace("come back", now=True)),
    ("drop it, come back", Replace("come back", now=True)),
    ("forget that, stop", Replace("stop", now=True)),
    ("go to the kitchen instead", Replace("go to the kitchen", now=False)),
    ("how is your battery doing?", BatteryCommand()),
    ("what is your battery at?", BatteryCommand()),
    ("do you have enough charge for a patrol", BatteryCommand()),
    ("have you finished yet?", Doing()),
    ("that's enough, quit it", CancelCommand()),
    ("where are you?", WhereCommand()),
    ("What is your location", WhereCommand()),
    ("what are you doing right now?", Doing()),
    ("where are you going?", Doing()),
    ("status", Doing()),
)
CHINESE: tuple[tuple[str, Intent], ...] = (
    ("记住这里是充电桩", Remember("充电桩")),
    ("请记住，这里是充电桩。", Remember("充电桩")),
    ("记住这里是危险品仓库", Remember("危险品仓库")),
    ("請記住這裡是充電樁", Remember("充電樁")),
    ("这里叫奶奶的椅子", Remember("奶奶的椅子")),
    ("把这个地方命名为“阅读角”吧", Remember("阅读角")),
    ("给这里起个名字叫打印机", Remember("打印机")),
    ("忘记奶奶的椅子这个地方", Forget("奶奶的椅子")),
    ("把充电位这个地方忘了吧", Forget("充电位")),
    ("删除地点：打印机", Forget("打印机")),
    ("继续", ResumeCommand()),
    ("好的，继续吧", ResumeCommand()),
    ("可以继续吗？", ResumeCommand()),
    ("继续执行刚才的任务", ResumeCommand()),
    ("恢复任务", ResumeCommand()),
    ("等一下", PauseCommand()),
    ("稍等片刻", PauseCommand()),
    ("暂停一下", PauseCommand()),
    ("算了", CancelCommand()),
    ("算了吧", CancelCommand()),
    ("不用去了，谢谢", CancelCommand()),
    ("别去厨房了", CancelCommand()),
    ("不用找了", CancelCommand()),
    ("不用再找杯子了", CancelCommand()),
    ("不用看了", CancelCommand()),
    ("不需要跟着我", CancelCommand()),
    ("不找了", CancelCommand()),
    ("不用找了，去厨房", Replace("去厨房", now=True)),
    ("不要去厨房了，去卧室", Replace("去卧室", now=True)),
    ("继续搜索", ResumeCommand()),
    ("撤销刚才的指令", CancelCommand()),
    ("别去了，去厨房", Replace("去厨房", now=True)),
    ("算了去厨房", Replace("去厨房", now=True)),
    ("算了，还是回来吧", Replace("还是回来", now=True)),
    ("改去卧室", Replace("去卧室", now=False)),
    ("你还有多少电？", BatteryCommand()),
    ("电还够巡逻一趟不", BatteryCommand()),
    ("干嘛呢你", Doing()),
    ("你在哪里？", WhereCommand()),
    ("现在在哪个房间呢", WhereCommand()),
    ("你在干什么呢？", Doing()),
    ("你要去哪儿", Doing()),
)
NONE = (
    *("你能做什么", "你能干啥", "你可以做些什么？", "你好，你能做什么"),
    # English: goes on, is denied, asks, or speaks of something else.
    "don't continue",
    "do not continue to the kitchen",
    "don't continue to the kitchen",
    "continue to the kitchen",
    "continue?",
    "continue when I say so",
    "go on the carpet",
    "keep going left",
    "carry on the bag",
    "resume speed",
    "pause for 5 seconds",
    "pause for one minute",
    "hold on to the box",
    "a bit",
    "moment",
    "wait",
    "cancel my subscription",
    "never mind the gap between the rooms",
    "never mind, continue",
    "never mind, remember this as home",
    "forget the keys",
    "don't forget the place charging dock",
    "forget",
    "remember this",
    "remember this as",
    "remember this as you drive",
    "remember this as soon as possible",
    "remember this as a warning",
    "mark this place as off limits",
    "mark this spot as dangerous",
    "remember this as no-go",
    "save this location as a no go zone",
    "remember this as dock and go to the kitchen",
    "remember this for later",
    "remember to charge",
    "don't remember this as dock",
    "can I call this place home?",
    "call this place what?",
    "call this number",
    "this place is nice",
    "this place is called what",
    "where are you from",
    "where are your keys",
    "tell me where you are happy",
    "what are you doing tomorrow",
    "don't go to the kitchen instead",
    "don't go and turn left",
    "do not go and turn around",
    "please don’t go there then drive to the kitchen",
    "don't go, and turn left",
    "do not go or turn left",
    "don't bother and go to the kitchen",
    "drop it and come back",
    "no need to look for the cup, continue",
    "do you need to look for it",
    "go to the kitchen",
    "stop",
    "",
    "  ",
    "?!",
    "contin\u200bue",
    "continue\u202e",
    "continue " * 60,
    # Chinese.
    "记住带钥匙",
    "把这里设为禁区",
    "把这里标记为危险区域",
    "把这里标为禁止进入",
    "记住这里是什么",
    "这里叫什么",
    "这里叫什么名字？",
    "这里叫奶奶的椅子吗",
    "这里是厨房",
    "这里叫人很难受",
    "记住这里是我放的",
    "记住这里不是充电桩",
    "别忘记奶奶的椅子这个地方",
    "忘记带钥匙",
    "继续去厨房",
    "不要继续",
    "先别继续",
    "继续吗？",
    "继续什么",
    "等一下再去厨房",
    "算了一下账",
    "别去厨房",
    "不用找去厨房",
    "不找了吗",
    "不看到人就不算了",
    "别去了厨房再回来",
    "你在哪买的",
    "你在干什么活",
    "去厨房",
    "停",
)


@pytest.mark.parametrize(("text", "intent"), [*ENGLISH, *CHINESE])
def test_whole_sentences_are_heard(text: str, intent: Intent) -> None:
    assert intent_of(text) == intent


@pytest.mark.parametrize(
    "text",
    ["oh it's here under my chair, forget it", "he missed his train, never mind",
     "哎呀他在我背后呢，不用找了", "他说还要加班，别等了", "never mind, leave it", "算了，不用了",
     "到了，不用跟了"],
)  # fmt: skip
def test_a_reason_before_it_takes_back_as_well(text: str) -> None:
    assert intent_of(text) == CancelCommand()


@pytest.mark.parametrize(
    "text",
    ["go to the kitchen, never mind", "去厨房，算了", "if she is there, never mind",
     "not he missed his train, never mind", "别找他，不用找了"],
)  # fmt: skip
def test_an_order_before_it_is_no_reason(text: str) -> None:
    assert not isinstance(intent_of(text), CancelCommand)


@pytest.mark.parametrize("text", NONE)
def test_other_sentences_are_left_to_the_brain(text: str) -> None:
    assert intent_of(text) is None


@settings(max_examples=50)
@example(("don't go there any more", CancelCommand()), "别")
@given(st.sampled_from([*ENGLISH, *CHINESE]), st.sampled_from(["not", "kitchen", "别", "厨房去"]))
def test_a_word_more_before_a_sentence_makes_it_another(
    said: tuple[str, Intent], more: str
) -> None:
    heard = intent_of(f"{more} {said[0]}")
    assert heard is None or isinstance(heard, Replace | Remember)
    if isinstance(heard, Remember):  # a name may grow at its front, no other sentence may
        assert more not in ("not", "别")


@settings(max_examples=50)
@given(st.text("conti uremb,.?!'…İßﬁ继续忘了去这里叫，。？「\u200b\u202e\ue000\n", max_size=60))
def test_any_text_is_read_the_same_twice(text: str) -> None:
    assert intent_of(text) == intent_of(text)


@pytest.mark.parametrize(
    "text", ["you are in the kitchen?", "you are in the kitchen, go to the study", "我在客厅"]
)
def test_what_asks_or_goes_on_or_is_of_another_tells_no_place(text: str) -> None:
    assert not isinstance(intent_of(text), HereCommand)


@pytest.mark.parametrize(
    "before", ["remember that ", "please remember: ", "记住，", "帮我记一下："]
)
@pytest.mark.parametrize("length", [10, 290, 310, 900, 1900])
def test_a_fact_is_one_however_long_it_is(before: str, length: int) -> None:
    """It is told to be too long where it is kept; "not understood" would tell nobody why."""
    fact = ("the blue box holds cables " if before.isascii() else "蓝色的箱子里有电线") * length
    made = intent_of(before + fact[:length].strip())
    assert isinstance(made, TeachFact)
    assert made.words == fact[:length].strip()


@pytest.mark.parametrize(
    "order", ["go to the kitchen and then ", "去厨房，然后", "remember to go and "]
)
@pytest.mark.parametrize("length", [400, 1500])
def test_a_long_order_is_no_fact(order: str, length: int) -> None:
    assert intent_of((order * length)[:length]) is None


@pytest.mark.parametrize("before", ["remember that ", "记住，"])
def test_nothing_endless_is_read(before: str) -> None:
    assert intent_of(before + "x" * 2000) is None


@pytest.mark.parametrize(
    "reason",
    [
        *("she just came out", "Dad's already gone", "my sister found it", "he's on his way down"),
        *("the postman has already been", "she's asleep", "somebody answered"),
    ],
)
def test_news_behind_it_takes_back_as_well(reason: str) -> None:
    assert intent_of(f"never mind, {reason}") == CancelCommand()
    assert not isinstance(intent_of(f"{reason} and then go there"), CancelCommand)


@pytest.mark.parametrize("reason", ["她出来了", "妈妈已经回来了", "宝宝醒了"])
def test_so_it_does_in_chinese(reason: str) -> None:
    assert intent_of(f"算了，{reason}") == CancelCommand()
    assert intent_of(f"算了，{reason}你再去") != CancelCommand()


@pytest.mark.parametrize(
    ("said", "order"),
    [
        ("not yet actually, come with me first", "come with me first"),
        ("no, not now, go to the study", "go to the study"),
        ("等会再去，先跟我来", "先跟我来"),
    ],
)
def test_what_is_put_off_makes_way_for_an_order(said: str, order: str) -> None:
    assert intent_of(said) == Replace(order, now=True)


@pytest.mark.parametrize(
    "said",
    ["not yet", "not now, the baby is asleep", "not yet, if you can", "先别去，等我", "等会再去"],
)
def test_what_is_put_off_alone_makes_way_for_nothing(said: str) -> None:
    assert not isinstance(intent_of(said), Replace)


@pytest.mark.parametrize(
    "said",
    ["hold on, somebody's at the door", "hang on, my phone is ringing", "等一下，有客人来了"],
)
def test_a_reason_behind_it_pauses_as_well(said: str) -> None:
    assert intent_of(said) == PauseCommand()


@pytest.mark.parametrize(
    "said", ["hold on, go to the study", "hang on, the study", "hold on, is somebody there?",
             "hold on, he is there so go back", "等一下，去书房"],
)  # fmt: skip
def test_an_order_or_a_place_behind_it_pauses_nothing(said: str) -> None:
    assert intent_of(said) != PauseCommand()


def test_enough_before_going_on_goes_on() -> None:
    assert intent_of("行了，接着走吧") == ResumeCommand()
    assert intent_of("行了，不用找了") == CancelCommand()
