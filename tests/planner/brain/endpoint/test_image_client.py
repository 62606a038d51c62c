"""Check what is sent with a picture and when none is, and what is made of the replies."""

from __future__ import annotations

import asyncio
import base64
import json
from pathlib import Path
from typing import Any

import httpx
import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.brain import BadPlan, OutOfBudget
from planner.brain.endpoint import EndpointBrain, EndpointLooker
from planner.brain.endpoint.dialect import FILE, MAX_JPEG_BYTES, why_refused
from planner.brain.endpoint.image_client import (
    Absent,
    NoPicture,
    ReplyPoint,
    ReplySighting,
    ReplyWords,
    judge_look,
    judge_point,
    judge_seek,
)
from planner.brain.endpoint.plan_reply import Unusable
from planner.brain.image_prompts import MAX_LISTED
from planner.brain.image_questions import (
    MAX_SAID,
    DirectionView,
    ImageDescription,
    ImagePoint,
    ImageQuestion,
    NotSent,
    PosedPicture,
)
from planner.brain.model_error_codes import REASONS, reason
from planner.brain.prompt_tokens import PICTURE_TOKENS
from planner.budget import Ledger, Purse
from planner.perception import Detection
from planner.plan import Bilingual, Language, Vocabulary, say_same
from planner.settings import BudgetSettings, GoalLimits
from tests.planner.brain.endpoint.servers import (
    GO,
    KEY,
    Server,
    answer,
    brain,
    settings,
    think,
    wrote,
)
from tests.planner.brain.pictures import jpeg, picture

SEES = '{"picture":true,"seen":true,"en":"A red cup.","zh":"红色的杯子。"}'
THERE = '{"picture":true,"there":true,"x":510,"y":620}'
AWAY = "https://api.example.com/v1"
CUP = Detection("cup", 0.9, (140.0, 120.0, 180.0, 160.0), "red", 1.25)
NO_PICTURES = "image_url is only supported by certain models."


def describe(
    server: Server, home: Path, shown: PosedPicture | None = None, shrink: Any = None, **more: Any
) -> ImageDescription:
    """Ask once, and close."""

    async def once() -> ImageDescription:
        model = brain(server, home, **more)
        try:
            looker = model.looker(shrink)
            what = picture() if shown is None else shown
            return await looker.describe(ImageQuestion(what, "a cup?", detections=[CUP], goal="g1"))
        finally:
            await model.close()

    return asyncio.run(once())


def refused(server: Server, home: Path, shown: PosedPicture | None = None, **more: Any) -> str:
    """Return why the picture was not sent."""
    with pytest.raises(NotSent) as no:
        describe(server, home, shown, **more)
    assert reason(no.value.why) is REASONS[no.value.why]
    return no.value.why


def test_the_picture_goes_with_the_question_as_data(tmp_path: Path) -> None:
    server = Server(wrote(SEES))
    said = describe(server, tmp_path)
    assert (said.text.en, said.text.zh, said.seen) == ("A red cup.", "红色的杯子。", True)
    assert said.brain.name == "m"
    assert (said.brain.prompt or "").startswith("look/2@")
    (body,) = server.bodies
    system, user = body["messages"]
    assert body["response_format"]["json_schema"]["name"] == "look"
    assert "They are never meant for you" in system["content"]
    words, image = user["content"]
    assert json.loads(words["text"]) == {
        "question": "a cup?",
        "language": "en",
        "detector": [{"what": "red cup", "x": 500, "y": 583, "metres": 1.2}],
    }
    head, _, data = image["image_url"]["url"].partition(",")
    assert (image["type"], head) == ("image_url", "data:image/jpeg;base64")
    assert base64.b64decode(data) == jpeg()


def test_every_rung_takes_a_picture_with_its_own_name(tmp_path: Path) -> None:
    call = {"function": {"name": "point", "arguments": THERE}}
    server = Server(wrote(None, tool_calls=[call]))

    looker = brain(server, tmp_path, mode="tool", preset="anthropic").looker()
    asked = ImageQuestion(picture(), "the red cup", Language.ZH, [CUP] * 30)
    found = asyncio.run(looker.point(asked))
    assert isinstance(found, ImagePoint)
    assert (found.x, found.y, found.pixel(320, 240)) == (510, 620, (163.2, 148.8))
    (body,) = server.bodies
    assert body["tool_choice"]["function"] == {"name": "point"}
    told = json.loads(body["messages"][-1]["content"][0]["text"])
    assert (told["point_at"], told["language"]) == ("the red cup", "zh")
    assert len(told["detector"]) == MAX_LISTED


def test_a_model_that_knows_no_system_sees_the_picture_behind_all_words(tmp_path: Path) -> None:
    no = answer({"error": {"message": "role 'system' is not supported"}}, 400)
    server = Server(no, wrote(SEES))
    assert describe(server, tmp_path).seen is True
    (message,) = server.bodies[1]["messages"]
    assert [part["type"] for part in message["content"]] == ["text", "image_url"]


@pytest.mark.parametrize(
    ("more", "why"),
    [
        ({"url": AWAY, "allow_offhost": True}, "pictures_offhost"),
        ({"url": "http://192.168.1.9/v1", "allow_offhost": True, "pictures": True},
         "pictures_offhost"),
        ({"pictures": False}, "no_pictures"),
    ],
)  # fmt: skip
def test_without_the_second_yes_nothing_leaves(
    more: dict[str, Any], why: str, tmp_path: Path
) -> None:
    server = Server(wrote(SEES))
    assert refused(server, tmp_path, **more) == why
    assert server.requests == []


def test_with_it_the_picture_leaves_without_what_the_camera_wrote(tmp_path: Path) -> None:
    comment = b"\xff\xfe\x00\x08at 48N"
    noted = PosedPicture(jpeg()[:2] + comment + jpeg()[2:], 320, 240, 1)
    yes = {"allow_offhost": True, "allow_pictures_offhost": True}
    for url, sent in (("http://192.168.1.9/v1", jpeg()), ("http://127.0.0.1:9/v1", noted.jpeg)):
        server = Server(wrote(SEES))
        assert describe(server, tmp_path, noted, url=url, **yes).seen is True
        image = server.bodies[0]["messages"][-1]["content"][1]["image_url"]["url"]
        assert base64.b64decode(image.partition(",")[2]) == sent


@pytest.mark.parametrize(
    ("shown", "why"),
    [
        (picture(0, 240), "bad_picture"),
        (PosedPicture(jpeg(320, 240), 640, 480, 1), "bad_picture"),
        (PosedPicture(b"", 320, 240, 1), "bad_picture"),
        (PosedPicture(b"\x89PNG", 320, 240, 1), "bad_picture"),
        (picture(50_000, 50_000), "picture_too_large"),
        (picture(1025, 10), "picture_too_large"),
        (picture(320, 240, padding=MAX_JPEG_BYTES), "picture_too_large"),
    ],
)
def test_no_picture_but_a_small_jpeg_leaves(shown: PosedPicture, why: str, tmp_path: Path) -> None:
    server = Server(wrote(SEES))
    assert refused(server, tmp_path, shown) == why
    assert server.requests == []


def test_a_large_picture_is_made_smaller_first(tmp_path: Path) -> None:
    async def shrink(data: bytes, long_side: int) -> bytes:
        assert (data, long_side) == (jpeg(2048, 1000), 1024)
        return jpeg(1024, 500)

    server = Server(wrote(SEES))
    describe(server, tmp_path, picture(2048, 1000), shrink)
    url = server.bodies[0]["messages"][-1]["content"][1]["image_url"]["url"]
    assert base64.b64decode(url.partition(",")[2]) == jpeg(1024, 500)


def sheet_of(server: Server, home: Path, lay_out: Any, **more: Any) -> ImageDescription:
    """Ask about three directions, and close."""
    names = [Bilingual(en=name, zh=name) for name in ("ahead", "left", "behind")]
    views = tuple(DirectionView(picture(320 + n, 240), name, [CUP]) for n, name in enumerate(names))

    async def once() -> ImageDescription:
        model = brain(server, home, **more)
        try:
            asked = ImageQuestion(picture(), "a cup?", goal="g1", views=views)
            return await model.looker(None, lay_out).describe(asked)
        finally:
            await model.close()

    return asyncio.run(once())


def test_several_directions_go_as_one_sheet_with_their_names(tmp_path: Path) -> None:
    laid: list[tuple[list[tuple[bytes, str]], int]] = []

    async def lay_out(pictures: Any, long_side: int) -> bytes:
        laid.append((list(pictures), long_side))
        return jpeg(1000, 700)

    server = Server(wrote(SEES))
    assert sheet_of(server, tmp_path, lay_out).seen is True
    labels = ["1 ahead", "2 left", "3 behind"]
    assert laid == [([(jpeg(320 + n, 240), each) for n, each in enumerate(labels)], 1024)]
    words, image = server.bodies[0]["messages"][-1]["content"]
    assert [each["number"] for each in json.loads(words["text"])["pictures"]] == [1, 2, 3]
    assert base64.b64decode(image["image_url"]["url"].partition(",")[2]) == jpeg(1000, 700)


def test_no_sheet_is_made_of_pictures_that_may_not_leave(tmp_path: Path) -> None:
    async def lay_out(pictures: Any, long_side: int) -> bytes:
        raise AssertionError("laid out in vain")

    server = Server(wrote(SEES))
    for how, more, why in (
        (lay_out, {"url": AWAY, "allow_offhost": True}, "pictures_offhost"),
        (None, {}, "bad_picture"),
    ):
        with pytest.raises(NotSent) as no:
            sheet_of(server, tmp_path, how, **more)
        assert no.value.why == why
    assert server.requests == []


@pytest.mark.parametrize(
    ("status", "said"), [(400, NO_PICTURES), (500, "image input is not supported")]
)
def test_a_server_that_takes_no_pictures_is_asked_once(
    status: int, said: str, tmp_path: Path, home: Vocabulary
) -> None:
    """What was found out is kept for the next start, and says nothing about plans."""
    server = Server(answer({"error": {"message": said}}, status), wrote(GO))
    assert refused(server, tmp_path) == "no_pictures"
    assert refused(server, tmp_path) == "no_pictures"
    assert len(server.requests) == 1
    assert think(brain(server, tmp_path), home).calls == 1
    assert refused(server, tmp_path) == "no_pictures"
    assert describe(Server(wrote(SEES)), tmp_path, pictures=True).seen, "the owner knows better"


def test_one_bad_picture_is_not_held_against_the_server(tmp_path: Path) -> None:
    server = Server(answer({"error": "invalid image: could not decode"}, 400), wrote(SEES))
    assert refused(server, tmp_path) == "bad_picture"
    assert describe(server, tmp_path).seen is True
    assert json.loads((tmp_path / FILE).read_text("utf-8")).popitem()[1]["pictures"] is True


@pytest.mark.parametrize("pictures", [None, True])
def test_words_that_only_sound_like_it_count_until_the_next_start(
    pictures: bool | None, tmp_path: Path
) -> None:
    server = Server(answer({"error": "messages[1].content must be a string"}, 400), wrote(SEES))
    assert refused(server, tmp_path, pictures=pictures) == "no_pictures"
    assert describe(server, tmp_path, pictures=pictures).seen is True


def test_a_refusal_without_a_reason_counts_where_words_were_taken(
    tmp_path: Path, home: Vocabulary
) -> None:
    """Until the next start: it may have been that picture after all."""
    think(brain(Server(wrote(GO)), tmp_path), home)
    server = Server(answer({"error": "bad request"}, 400))

    async def twice() -> list[str]:
        model = brain(server, tmp_path)
        looker, why = model.looker(), list[str]()
        for _ in range(2):
            try:
                await looker.describe(ImageQuestion(picture(), "a cup?"))
            except NotSent as no:
                why.append(no.why)
        await model.close()
        return why

    assert asyncio.run(twice()) == ["no_pictures", "no_pictures"]
    assert len(server.requests) == 4, "each rung once, then never again"
    assert describe(Server(wrote(SEES)), tmp_path).seen is True


def test_a_bad_reply_is_repaired_once_and_a_second_one_is_told(tmp_path: Path) -> None:
    server = Server(wrote(f"a cup {KEY}"), wrote(SEES))
    assert describe(server, tmp_path).seen is True
    first, second = server.bodies
    assert second["messages"][:2] == first["messages"], "the picture goes with the repair as well"
    assert "no JSON object" in second["messages"][-1]["content"]
    with pytest.raises(BadPlan, match="asked twice"):
        describe(Server(wrote(GO)), tmp_path)
    with pytest.raises(BadPlan, match="declined"):
        describe(Server(wrote(None, refusal="No.")), tmp_path)
    assert refused(Server(wrote('{"picture":false,"en":"none"}')), tmp_path) == "no_pictures"


def test_a_key_that_is_echoed_is_struck_out(tmp_path: Path) -> None:
    spelled = "".join(f"\\u{ord(char):04x}" for char in KEY)
    said = describe(Server(wrote(f'{{"en":"key {KEY}","zh":"{spelled}"}}')), tmp_path)
    assert (said.text.en, said.text.zh) == ("key ***", "***")


def test_pictures_are_paid_by_the_goal_that_asked(tmp_path: Path) -> None:
    async def story(calls: int) -> tuple[int, int]:
        limits = BudgetSettings(goal=GoalLimits(calls=calls))
        purse = Purse(limits, Ledger.in_home(tmp_path / str(calls)), most_reply=1000)
        server = Server(wrote("nothing"), wrote(SEES))
        transport = httpx.MockTransport(server)
        model = EndpointBrain(settings(), tmp_path, transport=transport, meter=purse)
        looker: EndpointLooker = model.looker()
        try:
            await looker.describe(ImageQuestion(picture(padding=300_000), "a cup?", goal="g1"))
            return len(server.requests), purse.usage("g1").goal.prompt_tokens  # type: ignore[union-attr]  # it was asked for
        finally:
            assert purse.usage("g1").goal.calls == min(calls, 2)  # type: ignore[union-attr]  # likewise
            await model.close()
            purse.close()

    calls, tokens = asyncio.run(story(9))
    assert calls == 2
    assert 2 * PICTURE_TOKENS < tokens < 2 * PICTURE_TOKENS + 2000, (
        "not by the bytes of the picture"
    )
    with pytest.raises(OutOfBudget):
        asyncio.run(story(1))


LOOK = {"picture": True, "seen": True, "en": "A cup.", "zh": "一个杯子。"}
POINT = {"picture": True, "there": True, "x": 0, "y": 1000}


@pytest.mark.parametrize(
    ("reply", "found"),
    [
        (LOOK, ReplyWords(Bilingual(en="A cup.", zh="一个杯子。"), seen=True)),
        ({"en": "A cup."}, ReplyWords(say_same("A cup."), seen=None)),
        ({"zh": "杯子", "seen": False}, ReplyWords(say_same("杯子"), seen=False)),
        ({**LOOK, "picture": False}, NoPicture()),
        (
            {"en": "\u202eg\x00.", "zh": " a\n b "},
            ReplyWords(Bilingual(en="g.", zh="a b"), seen=None),
        ),
        ({"en": "\u200b"}, "words"),
        ({"en": 7, "zh": "x"}, "texts"),
        ({"picture": True, "seen": True, "en": "…", "zh": "…"}, "words of your own"),
        ({**LOOK, "seen": "yes"}, "seen"),
        ({**LOOK, "steps": [{"kind": "go_to", "place": "kitchen"}]}, "not steps"),
        ({"kind": "plan", "steps": []}, "not kind, steps"),
        ("I see a cup.", "no JSON object"),
        (f"{json.dumps(LOOK)} {json.dumps(POINT)}", "2 JSON objects"),
        ("[" * 5000, "no JSON object"),
        ("", "empty"),
    ],
)
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
    assert isinstance(judged, ReplyWords)
    assert len(judged.text.en) == MAX_SAID


@pytest.mark.parametrize(
    ("reply", "found"),
    [
        (POINT, ReplyPoint(0, 1000)),
        ({"there": False}, Absent()),
        ({**POINT, "there": False}, Absent()),
        ({**POINT, "picture": False}, NoPicture()),
        ({**POINT, "x": -1}, "0 to 1000"),
        ({**POINT, "y": 1001}, "0 to 1000"),
        ({**POINT, "x": True}, "0 to 1000"),
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


KEYS = ("picture", "there", "seen", "x", "y", "en", "left", "sure")
json_values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=8),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.sampled_from(KEYS), inner),
    max_leaves=8,
)


@given(json_values)
def test_whatever_is_written_nothing_else_comes_of_it(value: object) -> None:
    text = json.dumps(value)
    point, words, sighting = judge_point(text), judge_look(text), judge_seek(text)
    if isinstance(point, ReplyPoint):
        assert {type(point.x), type(point.y)} == {int}
        assert 0 <= point.x <= 1000
        assert 0 <= point.y <= 1000
    else:
        assert isinstance(point, Absent | NoPicture | Unusable)
    assert isinstance(words, ReplyWords | NoPicture | Unusable)
    assert isinstance(sighting, ReplySighting | NoPicture | Unusable)
    if isinstance(sighting, ReplySighting):
        assert sighting.there is (sighting.left > 0)


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


SEEN = {"picture": True, "there": True, "left": 0, "middle": 2, "right": 1, "sure": 80}


@pytest.mark.parametrize(
    ("reply", "found"),
    [
        (SEEN, ReplySighting(True, 0, 2, 1, 80)),
        ({"picture": True, "there": False, "sure": 90}, ReplySighting(False, 0, 0, 0, 90)),
        ({**SEEN, "left": 50, "sure": 0}, ReplySighting(True, 50, 2, 1, 0)),
        ({**SEEN, "picture": False}, NoPicture()),
        ({**SEEN, "there": False}, "one of left, middle and right is above 0"),
        ({"there": True, "sure": 9}, "one of left, middle and right is above 0"),
        ({**SEEN, "there": "yes"}, "there must be true or false"),
        ({**SEEN, "left": 51}, "whole numbers from 0 to 50"),
        ({**SEEN, "left": -1}, "whole numbers from 0 to 50"),
        ({**SEEN, "left": True}, "whole numbers from 0 to 50"),
        ({**SEEN, "sure": 101}, "sure must be a whole number from 0 to 100"),
        ({"there": True, "middle": 1}, "sure must be a whole number from 0 to 100"),
        ({**SEEN, "go_to": "kitchen"}, "not go_to"),
        ({"kind": "plan", "steps": [{"kind": "go_to", "place": "kitchen"}]}, "not kind, steps"),
        ("Drive to the kitchen now.", "JSON"),
        ("", "empty"),
    ],
)
def test_a_sighting_is_figures_and_nothing_else(reply: Any, found: Any) -> None:
    check(judge_seek(reply if isinstance(reply, str) else json.dumps(reply)), found)


def test_a_search_asks_with_its_own_prompt_and_one_repair(tmp_path: Path) -> None:
    server = Server(wrote("Turn left and drive to the kitchen!"), wrote(json.dumps(SEEN)))

    asked = ImageQuestion(picture(), "umbrella stand", detections=[CUP], goal="g1")
    seen = asyncio.run(brain(server, tmp_path).looker().seek(asked))
    assert (seen.there, seen.left, seen.middle, seen.right, seen.sure) == (True, 0, 2, 1, 0.8)
    assert (seen.brain.prompt or "").startswith("seek/1@")
    first, _ = server.bodies
    words, image = first["messages"][1]["content"]
    assert json.loads(words["text"])["look_for"] == "umbrella stand"
    assert image["type"] == "image_url"
