"""Check what is kept of a model's replies: how much, how clean, and never a key."""

from __future__ import annotations

from datetime import UTC, datetime

import pytest

from planner.brain.model_replies import (
    CUT_OFF,
    KEY_CUT,
    MOST_CHARACTERS,
    MOST_READ,
    MOST_REPLIES,
    KeptReply,
    ReplyCollector,
    ReplyTurn,
)

KEY = "abc123-the-robots-own"
NOON = datetime(2026, 1, 1, 12, tzinfo=UTC)


def keep(collector: ReplyCollector, goal: str = "g1", text: str = "{}") -> None:
    collector.keep(goal, text, model="m", turn=ReplyTurn.PLAN, used=True)


def shown(text: str, *keys: str) -> KeptReply:
    collector = ReplyCollector(1, keys)
    keep(collector, text=text)
    (reply,) = collector.replies_of("g1").replies
    return reply


def test_nothing_is_kept_unless_that_is_set() -> None:
    collector = ReplyCollector(0)
    keep(collector)
    found = collector.replies_of("g1")
    assert (found.kept, found.replies) == (0, ())


def test_a_reply_is_kept_as_it_came() -> None:
    collector = ReplyCollector(3, clock=lambda: NOON)
    collector.keep("g1", '{\n\t"kind": 1}', model="m", turn=ReplyTurn.REPAIR, used=False)
    found = collector.replies_of("g1")
    assert found.kept == 3
    assert found.model_dump(mode="json")["replies"] == [
        {"at": "2026-01-01T12:00:00Z", "model": "m", "turn": "repair",
         "text": '{\n  "kind": 1}', "cut": False, "used": False}
    ]  # fmt: skip


def test_what_no_goal_asked_for_is_not_kept() -> None:
    collector = ReplyCollector(3)
    keep(collector, goal="")
    assert collector.replies_of("").replies == ()


def test_the_goals_that_a_model_wrote_about_last_are_kept() -> None:
    collector = ReplyCollector(2)
    for goal in ("g1", "g2", "g1", "g3"):
        keep(collector, goal)
    counts = [len(collector.replies_of(goal).replies) for goal in ("g1", "g2", "g3")]
    assert counts == [2, 0, 1]


def test_of_a_goal_the_newest_are_kept() -> None:
    collector = ReplyCollector(1)
    for number in range(MOST_REPLIES + 3):
        keep(collector, text=str(number))
    texts = [reply.text for reply in collector.replies_of("g1").replies]
    assert texts == [str(number) for number in range(3, MOST_REPLIES + 3)]


@pytest.mark.parametrize("size", [MOST_CHARACTERS + 1, MOST_READ + 1, 1_000_000])
def test_a_long_reply_is_cut_and_says_so(size: int) -> None:
    reply = shown("去" * size)
    assert (len(reply.text), reply.cut) == (MOST_CHARACTERS, True)
    assert reply.text.endswith(CUT_OFF)
    whole = shown("去" * MOST_CHARACTERS)
    assert (len(whole.text), whole.cut) == (MOST_CHARACTERS, False)


@pytest.mark.parametrize(
    "text",
    [
        KEY,
        f"the key is {KEY}.",
        f'{{"en": "{KEY}"}}',
        KEY.replace("a", "\\u0061"),
        KEY.replace("b", "\u200bb"),
        KEY.replace("c", "\x00c"),
        "\u200b" * (MOST_READ - 10) + KEY,
    ],
)
def test_a_key_that_is_set_is_cut_however_it_is_written(text: str) -> None:
    reply = shown(text, KEY, "robots")
    assert "abc123" not in reply.text
    assert "own" not in reply.text


def test_a_key_that_a_model_was_cut_off_in_is_cut() -> None:
    assert shown(f"it is {KEY[:12]}", KEY).text == f"it is {KEY_CUT}"
    assert shown("it is abc", KEY).text == "it is abc", "three characters may be a word"


@pytest.mark.parametrize(
    "secret",
    [
        "sk-proj-1a2b3c4d",
        "Bearer eyJhbGciOi.J9",
        "bearer  a1b2c3d4e5",
        "0123456789abcdef" * 2,
        "QUJDREVGR0hJSktMTU5PUFFSU1RVVldYWVo+/w==",
        "QUJDREVGR0hJSktM\\/TU5PUFFSU1RVVldYWVo",
    ],
)
def test_what_looks_like_a_key_is_cut(secret: str) -> None:
    assert shown(f'{{"en":"use {secret}"}}').text == f'{{"en":"use {KEY_CUT}"}}'


@pytest.mark.parametrize(
    "text",
    [
        '{"kind":"plan","steps":[{"kind":"go_to","place":"living_room_door"}]}',
        "The bearer of news waits; ask-someone, 去厨房看看有没有人在家里做饭或者打扫卫生吧谢谢你",
        '{"en": "It says \\u201cno\\u201d.", "zh": "a\\/b"}',
    ],
)
def test_plain_words_stay(text: str) -> None:
    assert shown(text).text == text


def test_what_hides_or_turns_text_is_taken_out() -> None:
    assert shown("a\x1b[31mb\u202ec\ud800d\u2028e\r\nf\u200b").text == "a[31mbcde\nf"


@pytest.mark.parametrize("text", ["", " \n\x00"])
def test_an_empty_reply_is_kept_too(text: str) -> None:
    assert shown(text).text == ""
