"""Check what is made of replies about a picture, and of a server's words about it."""

from __future__ import annotations

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.brain.endpoint.image_content import why_refused
from planner.brain.endpoint.image_reply import (
    Absent,
    NoPicture,
    Point,
    Words,
    judge_look,
    judge_point,
)
from planner.brain.endpoint.reply_validation import Unusable
from planner.brain.image_questions import MAX_SAID
from planner.plan import Bilingual, same

LOOK = {"picture": True, "seen": True, "en": "A cup.", "zh": "一个杯子。"}
POINT = {"picture": True, "there": True, "x": 0, "y": 1000}


@pytest.mark.parametrize(
    ("reply", "found"),
    [
        (LOOK, Words(Bilingual(en="A cup.", zh="一个杯子。"), seen=True)),
        ({"en": "A cup."}, Words(same("A cup."), seen=None)),
        ({"zh": "杯子", "seen": False}, Words(same("杯子"), seen=False)),
        ({**LOOK, "picture": False}, NoPicture()),
        ({"en": "\u202eg\x00.", "zh": " a\n b "}, Words(Bilingual(en="g.", zh="a b"), seen=None)),
        ({"en": "\u200b"}, "words"),
        ({"en": 7, "zh": "x"}, "texts"),
        ({**LOOK, "seen": "yes"}, "seen"),
        ({**LOOK, "seen": 1}, "seen"),
        ({**LOOK, "steps": [{"kind": "go_to", "place": "kitchen"}]}, "not steps"),
        ({"kind": "plan", "steps": []}, "not kind, steps"),
        ("I see a cup.", "no JSON object"),
        (f"{json.dumps(LOOK)} {json.dumps(POINT)}", "2 JSON objects"),
        ("[" * 5000, "no JSON object"),
        ("", "empty"),
    ],
)  # fmt: skip
def test_an_answer_is_words_and_a_yes_or_no(reply: object, found: object) -> None:
    check(judge_look(reply if isinstance(reply, str) else json.dumps(reply)), found)


def check(judged: object, found: object) -> None:
    if isinstance(found, str):
        assert isinstance(judged, Unusable)
        assert found in str(judged)
    else:
        assert judged == found


def test_a_long_answer_is_cut() -> None:
    judged = judge_look(json.dumps({"en": "y" * 5000}))
    assert isinstance(judged, Words)
    assert len(judged.text.en) == MAX_SAID


@pytest.mark.parametrize(
    ("reply", "found"),
    [
        (POINT, Point(0, 1000)),
        ({"there": False}, Absent()),
        ({**POINT, "there": False}, Absent()),
        ({**POINT, "picture": False}, NoPicture()),
        ({**POINT, "x": -1}, "0 to 1000"),
        ({**POINT, "y": 1001}, "0 to 1000"),
        ({**POINT, "x": 500.0}, "0 to 1000"),
        ({**POINT, "x": "500"}, "0 to 1000"),
        ({**POINT, "x": True}, "0 to 1000"),
        ({**POINT, "x": [500]}, "0 to 1000"),
        ({"there": True, "x": 5}, "0 to 1000"),
        ({"x": 5, "y": 5}, "there"),
        ({**POINT, "there": "yes"}, "there"),
        ({**POINT, "place": "kitchen"}, "not place"),
        ('{"there": true, "x": NaN, "y": 5}', "malformed"),
        ('{"there": true, "x": 1e999, "y": 5}', "0 to 1000"),
    ],
)
def test_a_point_is_two_whole_numbers_in_their_range(reply: object, found: object) -> None:
    check(judge_point(reply if isinstance(reply, str) else json.dumps(reply)), found)


json_values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=8),
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(st.sampled_from(["picture", "there", "seen", "x", "y", "en"]), inner)
    ),
    max_leaves=8,
)


@given(json_values)
def test_whatever_is_written_nothing_else_comes_of_it(value: object) -> None:
    text = json.dumps(value)
    point, words = judge_point(text), judge_look(text)
    if isinstance(point, Point):
        assert {type(point.x), type(point.y)} == {int}
        assert 0 <= point.x <= 1000
        assert 0 <= point.y <= 1000
    else:
        assert isinstance(point, Absent | NoPicture | Unusable)
    assert isinstance(words, Words | NoPicture | Unusable)


@pytest.mark.parametrize(
    ("said", "why"),
    [
        ("status 500: image input is not supported - hint: … you may need to provide the mmproj",
         "no_pictures"),
        ("status 400: this model does not support image input", "no_pictures"),
        ("image_url is only supported by certain models.", "no_pictures"),
        ("messages[1]: unknown variant `image_url`, expected `text`", "no_pictures"),
        ('unsupported content part type: "image_url"', "no_pictures"),
        ("no endpoints found that support image input", "no_pictures"),
        ("at most 0 image(s) may be provided in one request.", "no_pictures"),
        ("messages[1].content must be a string", "no_pictures"),
        ("qwen3-8b is not a multimodal model", "no_pictures"),
        ("invalid image data: could not decode", "bad_picture"),
        ("illegal base64 data at input byte 5", "bad_picture"),
        ("the image is too large", "bad_picture"),
        ("response_format is not supported", None),
        ("this response_format is no text content", None),
        ("temperature must be 1", None),
        ("invalid 'messages[0].content': string too long", None),
        ("bad request", None),
    ],
)  # fmt: skip
def test_a_server_s_words_tell_what_it_refuses(said: str, why: str | None) -> None:
    assert why_refused(said) == why
