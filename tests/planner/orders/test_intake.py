"""Orders corrected, snoozed, paused and asked about by sentences, at the desk that keeps them."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path

import pytest

from planner.language.schedule import OrderCommand
from planner.language.sentence import parse
from planner.mission.effects import AskBrain
from planner.mission.state import Mission
from planner.orders.decision import SPOKEN_S
from planner.orders.order import StandingOrder
from planner.plan import (
    AnswerPlan,
    Clarify,
    GoalState,
    Language,
    Plan,
    QuietHours,
    Refuse,
    words_of,
)
from planner.plan.timing import AtRule, CronRule
from tests.planner.orders.fakes import BERLIN, NOON_UNIX_S, Kept, MovedClocks, kept_in

HOUR_S, DAY_S = 3600.0, 86_400.0


async def take(kept: Kept, text: str) -> Plan | None:
    command = parse(text).intent
    assert isinstance(command, OrderCommand), text
    given = Mission(
        id="g-1", order=0, text=text, language=parse(text).language, state=GoalState.PLANNING,
        created_unix_s=kept.clock.unix_s, updated_unix_s=kept.clock.unix_s,
    )  # fmt: skip
    ask = AskBrain("g-1", text, parse(text).language, order=text)
    planned = await kept.orders.intake.take(command, ask, given)
    return None if planned is None else planned.plan


async def say(kept: Kept, text: str) -> str:
    plan = await take(kept, text)
    assert isinstance(plan, AnswerPlan | Refuse), (text, plan)
    words = words_of(plan)
    assert words is not None
    return words.zh if parse(text).language is Language.ZH else words.en


def orders(kept: Kept) -> dict[str, StandingOrder]:
    return {name: o for name, o in kept.orders.keeper.book.orders.items() if not o.ended}


def cron(kept: Kept, name: str = "o1") -> str:
    rule = orders(kept)[name].rule
    assert isinstance(rule, CronRule)
    return rule.cron


def due(kept: Kept, name: str) -> str:
    due_s = kept.orders.keeper.book.due[name]
    return datetime.fromtimestamp(due_s, BERLIN).strftime("%m-%d %H:%M")


async def test_an_order_just_given_is_corrected_step_by_step(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    await say(kept, "every evening at eight say hello")
    told = await say(kept, "make it nine instead")
    assert told == 'Changed. Every day at 21:00 I will say "hello". Next: today 21:00.'
    assert "Every day except Sunday" in await say(kept, "not on Sundays")
    assert "On weekdays at 21:00" in await say(kept, "only on weekdays")
    assert cron(kept) == "0 21 * * 1-5"
    assert "工作日 20:30" in await say(kept, "不是九点，是八点半")
    await say(kept, "every hour instead")
    assert (cron(kept), due(kept, "o1")) == ("0 * * * *", "01-15 13:00")
    assert len(orders(kept)) == 1


async def test_a_corrected_order_is_on_disk_and_fires_at_its_new_time_alone(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    await say(kept, "every day at 12:10 say hello")
    await say(kept, "make it ten minutes later")
    again = await kept_in(tmp_path, MovedClocks(), kept.missions)
    assert cron(again) == "20 12 * * *"
    await kept.run_s(700.0, 5.0)
    assert kept.missions.given == []
    await kept.run_s(700.0, 5.0)
    assert [text for _, text, _, _ in kept.missions.given] == ["say hello"]


async def test_what_is_put_before_now_is_not_caught_up(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    await say(kept, "every day at one in the afternoon say hello")
    await say(kept, "make it eleven in the morning")
    await kept.run_s(7200.0, 10.0)
    assert kept.missions.given == []
    assert kept.missions.told() == []
    assert due(kept, "o1") == "01-16 11:00"


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("make it eight", "so already"), ("make it every minute", "too often"),
        ("make it tomorrow", "can't change that"),
    ],
)  # fmt: skip
async def test_a_refused_correction_changes_nothing(tmp_path: Path, text: str, part: str) -> None:
    kept = await kept_in(tmp_path)
    await say(kept, "every evening at eight say hello")
    before = orders(kept)
    assert part in await say(kept, text)
    assert orders(kept) == before


async def test_a_correction_into_the_quiet_hours_is_refused(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path, quiet=QuietHours.read("22:00-07:00"))
    await say(kept, "every evening at eight say hello")
    assert "quiet hours" in await say(kept, "make it half past ten")
    assert cron(kept) == "0 20 * * *"


async def test_the_order_that_was_spoken_of_last_is_meant(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    await say(kept, "every evening at eight say hello")
    await kept.turn(5.0)
    await say(kept, "every morning at eight say good morning")
    await kept.turn(5.0)
    await say(kept, "make it nine")
    assert (cron(kept, "o1"), cron(kept, "o2")) == ("0 20 * * *", "0 9 * * *")
    await kept.turn(5.0)
    await say(kept, "at seven in the evening, not eight")
    assert (cron(kept, "o1"), cron(kept, "o2")) == ("0 19 * * *", "0 9 * * *")
    await say(kept, "make it six")
    assert cron(kept, "o1") == "0 18 * * *"


async def test_a_while_later_a_person_is_asked_which_and_the_offer_does_it(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    await say(kept, "every evening at eight say hello")
    await say(kept, "every morning at eight say good morning")
    await kept.turn(SPOKEN_S + 1.0)
    before = orders(kept)
    plan = await take(kept, "make it nine")
    assert isinstance(plan, Clarify)
    offers = [option.text for option in plan.options]
    assert offers == ["change order o1: make it nine", "change order o2: make it nine"]
    assert orders(kept) == before
    await say(kept, offers[1])
    assert (cron(kept, "o1"), cron(kept, "o2")) == ("0 20 * * *", "0 9 * * *")


async def test_a_named_order_is_corrected_and_several_are_asked_about(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    await say(kept, "every evening at eight say hello")
    await say(kept, "every morning at eight say good morning")
    await kept.turn(SPOKEN_S + 1.0)
    assert "every day at 21:00" in (await say(kept, "move the hello one to nine")).lower()
    await say(kept, "change the good morning one to half past seven")
    assert (cron(kept, "o1"), cron(kept, "o2")) == ("0 21 * * *", "30 7 * * *")
    await say(kept, "每天早上八点提醒我吃药")
    await say(kept, "把吃药的提醒改成九点")
    assert cron(kept, "o3") == "0 9 * * *"


@pytest.mark.parametrize(
    "text", ["make it nine", "not on Sundays", "five more minutes", "snooze", "delete the red one",
             "how long have I got left", "改成九点", "周日不用", "再睡五分钟", "还有多久",
             "把早上那个取消", "at nine as well", "and at half past six too", "八点也要"],
)  # fmt: skip
async def test_what_fits_no_order_is_left_to_a_brain(tmp_path: Path, text: str) -> None:
    kept = await kept_in(tmp_path)
    assert await take(kept, text) is None
    assert orders(kept) == {}


@pytest.mark.parametrize("text", ["five more minutes", "remind me again in five minutes",
                                  "再过五分钟叫我", "snooze for five minutes"])  # fmt: skip
async def test_a_reminder_that_came_comes_again(tmp_path: Path, text: str) -> None:
    kept = await kept_in(tmp_path)
    await say(kept, "remind me in 20 minutes to take the cake out")
    await kept.run_s(1210.0, 10.0)
    assert kept.missions.told() == [("reminder", "reminder")]
    kept.missions.end(kept.missions.given[0][0])
    assert "take the cake out" in await say(kept, text)
    assert [o.reminder for o in orders(kept).values()] == ["take the cake out"]
    await say(kept, text)
    [again] = orders(kept).values()
    assert isinstance(again.rule, AtRule)
    assert again.rule.unix_s == pytest.approx(kept.clock.unix_s + 600.0)
    await kept.run_s(620.0, 10.0)
    assert kept.missions.told() == [("reminder", "reminder")] * 2


async def test_a_reminder_that_waits_comes_later(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    await say(kept, "remind me in 20 minutes to take the cake out")
    assert "12:25" in await say(kept, "another five minutes")
    assert len(orders(kept)) == 1
    assert due(kept, "o1") == "01-15 12:25"


async def test_nothing_came_so_a_reminder_of_its_own_is_kept(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    await say(kept, "再过五分钟叫我")
    assert due(kept, "o1") == "01-15 12:05"


async def test_the_reminder_is_one_and_the_reminders_are_all(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    await say(kept, "remind me at eight in the evening to call Tom")
    await say(kept, "every day at nine in the evening remind me to take my pills")
    for text in ("cancel the reminder", "取消提醒"):
        plan = await take(kept, text)
        assert isinstance(plan, Clarify)
        assert [o.text for o in plan.options] == ["remove order o1", "remove order o2"]
    assert "o1" in await say(kept, "cancel the one at eight")
    assert list(orders(kept)) == ["o2"]
    await say(kept, "cancel all my reminders")
    assert orders(kept) == {}


@pytest.mark.parametrize(
    ("given", "text"),
    [
        ("when somebody comes in, say hello", "stop saying hello when somebody comes in"),
        ("whenever you see a person say hello", "stop saying hello when somebody comes in"),
        ("every evening at eight patrol all rooms", "no more patrols in the evening"),
        ("every evening at eight patrol all rooms", "stop patrolling in the evening"),
        ("every morning at eight say good morning", "delete the good morning one"),
        ("every day at 8 am say hello", "cancel the one at eight"),
        ("每天晚上八点检查门口", "晚上别再检查门口了"), ("每天早上八点说早上好", "把早上那个取消"),
    ],
)  # fmt: skip
async def test_the_order_that_these_words_name_is_removed(
    tmp_path: Path, given: str, text: str
) -> None:
    kept = await kept_in(tmp_path)
    await say(kept, given)
    await say(kept, "every day at three in the afternoon go to the study")
    assert "o1" in await say(kept, text)
    assert list(orders(kept)) == ["o2"]


@pytest.mark.parametrize(
    ("text", "until_s"),
    [
        ("pause the evening hello until Monday", 2.5 * DAY_S),
        ("pause o1 until tomorrow", HOUR_S * 12),
        ("pause o1 for two hours", 2 * HOUR_S), ("把o1暂停到周一", 2.5 * DAY_S),
    ],
)  # fmt: skip
async def test_a_pause_ends_by_itself(tmp_path: Path, text: str, until_s: float) -> None:
    kept = await kept_in(tmp_path)
    await say(kept, "every evening at eight say hello")
    await say(kept, text)
    order = orders(kept)["o1"]
    assert order.paused
    assert order.resume_unix_s == NOON_UNIX_S + until_s
    await kept.turn(until_s - 1.0)
    assert orders(kept)["o1"].paused
    assert kept.missions.given == []
    await kept.turn(2.0)
    again = await kept_in(tmp_path, MovedClocks(NOON_UNIX_S + until_s + 2.0), kept.missions)
    for desk in (kept, again):
        assert not orders(desk)["o1"].paused
    assert kept.missions.told() == []
    await kept.run_s(DAY_S, 30.0)
    assert len(kept.missions.given) == 1


async def test_a_pause_until_a_day_that_is_over_is_refused(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    await say(kept, "every evening at eight say hello")
    assert "over already" in await say(kept, "pause o1 until 5 January")
    assert not orders(kept)["o1"].paused


async def test_questions_are_answered_by_what_is_kept(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    assert await say(kept, "when is my reminder?") == "I have no reminders for you."
    await say(kept, "every evening at eight say hello")
    await say(kept, "remind me in 20 minutes to take the cake out")
    await say(kept, "remind me tomorrow at nine to call Tom")
    left = await say(kept, "How long have I got left?")
    assert left.startswith("Next: o2: today 12:20 (in 20 min)")
    assert "o1" not in left
    assert "（还有 20 分钟）" in await say(kept, "还有多久")
    assert "o3: tomorrow 09:00" in await say(kept, "when is the Tom reminder?")
    tomorrow = await say(kept, "what's on for tomorrow?")
    assert tomorrow.startswith("For tomorrow: o3: 09:00")
    assert tomorrow.index("o3") < tomorrow.index("o1: 20:00")
    assert "o2" not in tomorrow
    assert "o2" in await say(kept, "what's on today?")
    every = await say(kept, "what have I asked you to do every evening?")
    assert "o1" in every
    assert "o2" not in every
    assert "星期天" not in await say(kept, "周日有什么安排")
    assert await say(kept, "remove order o1")
    assert await say(kept, "what's on for Sunday?") == ("Nothing is planned for Sunday 2027-01-17.")


@pytest.mark.parametrize("deed", ["去厨房说“吃饭”2遍", "如果客厅有人就说该睡觉了"])
async def test_steps_that_hold_others_are_told_in_the_words_of_the_order(
    tmp_path: Path, deed: str
) -> None:
    kept = await kept_in(tmp_path)
    assert f"今天 22:00，我会按您说的做：“{deed}”" in await say(kept, f"今晚十点{deed}")
