"""Hold that whatever a model writes is a plan of the closed vocabulary, or is refused in words."""

from __future__ import annotations

import contextlib
import json
from math import radians

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.brain.endpoint import Unusable, judge
from planner.brain.endpoint.reply_object import MAX_CHARACTERS, NoObject, one_object
from planner.plan import (
    EVERY_KIND,
    AnswerPlan,
    Bilingual,
    Clarify,
    Code,
    Entry,
    Find,
    GoTo,
    Refuse,
    Say,
    StepPlan,
    Vocabulary,
    check_plan,
    places_of,
)
from pons.mock_llm.replies import GARBAGE
from tests.planner.brain.conftest import HOME
from tests.planner.brain.endpoint.servers import GO
from tests.pons.mock_llm.bad_replies import HOSTILE_COUNT, hostile

NO = '{"kind":"refuse","code":"unsafe","en":"No.","zh":"不。"}'
KITCHEN = StepPlan(steps=(GoTo(place="kitchen"),))


@pytest.mark.parametrize(
    "text",
    [
        GO,
        f"  {GO}\n",
        f"Sure:\n```json\n{GO}\n```\nBye {{friend}}",
        f"```\n{GO}```",
        f"<think>maybe {{\"kind\":\"refuse\"}}</think>{GO}",
        f"maybe {{\"kind\":\"refuse\"}}</think>\n{GO}",
        f"{GO}\n{GO}",
        f"{GO}<think>was that right? {{\"kind\":\"answer\"}}",
        GO[:-3] + ',"text":null,"seconds":null}],"en":"","zh":null,"options":[],"code":null}',
        f"\ufeff{GO}",
        f"<think>a</think>{GO}<thinking>b {{}}</thinking>",
        f"<think>a<think>b</think>{GO}",
        f"<think>{'hm ' * 50_000}</think>{GO}",
        f"`{{x}}` ``` {GO} ``` {{y}}",
        '{"kind":"go_to","place":"kitchen"}',
        '[{"kind":"go_to","place":"kitchen"}]',
        'Sure:\n```json\n[{"kind":"go_to","place":"kitchen"}]\n```',
        '{"steps":[{"kind":"go_to","place":"kitchen"}]}',
        '{"kind":"plan","steps":[{"kind":"go_to","place":"Kitchen"}]}',
        '{"kind":"plan","steps":[{"kind":"go_to","place":"the kitchen"}]}',
        '{"kind":"plan","steps":[{"kind":"go_to","place":"厨房"}]}',
        '[{"kind":"go_to","place":"廚房"}]',
    ],
)  # fmt: skip
def test_one_plan_is_found_in_what_surrounds_it(text: str) -> None:
    assert judge(text, HOME) == KITCHEN


@pytest.mark.parametrize(
    "text",
    [
        "",
        "   ",
        "I will drive to the kitchen.",
        GO[:-3],
        GO + '{"kind":"plan","steps":[{"kind":"return_home"}]}',
        "<think>" + GO,
        '{"note":"never do this","example":' + GO + ',"more":',
        '{"kind":"refuse","code":"unsafe","en":"no" oops ' + GO,
        f"{NO}\n```json\n{GO}\n```",
        f"```json\n{GO}\n```\n{NO}",
        f"```\n{NO}\n```\n```\n{GO}\n```",
        f"```\n{GO}\n```\n" + GO[:-3],
        '{"kind":"refuse",' + GO[1:],
        GO[:-3] + ',"place":"study"}]}',
        '{"kind":"refuse","kind":"answer","en":"no","zh":"不"}',
        '{"kind":"plan"}',
        '{"kind":"plan","steps":[]}',
        '{"kind":"plan","steps":"kitchen"}',
        '{"kind":"plan","steps":[7]}',
        '{"kind":["plan"],"steps":[]}',
        '{"kind":"answer"}',
        '{"kind":"answer","en":3,"zh":"三"}',
        '{"kind":"answer","en":"\\u202e","zh":"\\u200b"}',
        '{"kind":"refuse","en":"no","zh":"不"}',
        '{"kind":"refuse","code":"arrived","en":"no","zh":"不"}',
        '{"kind":"clarify","code":"ambiguous","en":"a","zh":"b","options":"x"}',
        "x" * (MAX_CHARACTERS + 1),
        "{" * 60_000,
        '{"a":' * 12_000,
        ('{"a":' * 900 + "1" + "}" * 900) * 2,
        f"{GO}</think>",
        f"<think>{GO}</think>",
        f"</think><think>{GO}</think></think>",
        "<think>" * 9000,
        "```" + "a" * 60_000,
    ],
)
def test_what_is_no_plan_says_why(text: str) -> None:
    judged = judge(text, HOME)
    assert isinstance(judged, Unusable), judged
    assert str(judged)
    assert len(str(judged)) < 2000


@pytest.mark.parametrize(
    "text",
    ['[{"kind":"go_to","place":"kitchen"}]' + NO, NO + '[{"kind":"go_to","place":"kitchen"}]',
     '[{"kind":"go_to","place":"kitchen"}, 7]', '[{"kind":"go_to","place":"kitchen"}',
     '[[{"kind":"go_to","place":"kitchen"}]]', "[]", '[{"place":"kitchen"}]',
     '[{"kind":"refuse","code":"unsafe","en":"No.","zh":"不。"}]',
     *GARBAGE, *(hostile(number, "kitchen") for number in range(HOSTILE_COUNT))],
)  # fmt: skip
def test_a_list_that_is_not_steps_alone_garbage_and_a_hostile_reply_are_no_plan(text: str) -> None:
    assert isinstance(judge(text, HOME), Unusable)


@pytest.mark.parametrize("place", ["Kitchin", "kitchen or study", "厨", "the", "KITCHEN!"])
def test_what_is_no_exact_name_is_told_with_those_that_are(place: str) -> None:
    judged = judge(json.dumps({"kind": "go_to", "place": place}), HOME)
    assert isinstance(judged, Unusable)
    assert "known places: " in str(judged)
    assert "kitchen" in str(judged)


def test_every_name_of_every_place_is_its_id_wherever_it_stands() -> None:
    for entry in HOME.entries:
        for name in entry.spellings:
            inner = {"kind": "repeat", "times": 2, "do": [{"kind": "go_to", "place": name}]}
            judged = judge(json.dumps([inner]), HOME)
            assert isinstance(judged, StepPlan), (name, judged)
            assert next(iter(judged.model_dump()["steps"][0]["steps"]))["place"] == entry.id


def test_a_name_of_two_places_is_neither() -> None:
    twins = Vocabulary(
        entries=tuple(
            Entry(id=f"bed_{n}", kind="place", name=Bilingual(en="bed", zh="床")) for n in (1, 2)
        )
    )
    judged = judge('{"kind":"go_to","place":"bed"}', twins)
    assert isinstance(judged, Unusable)
    assert "bed_1, bed_2" in str(judged)


def test_a_step_that_needs_a_camera_is_left_to_the_mission() -> None:
    text = '{"kind":"plan","steps":[{"kind":"find","object":"cup","place":"kitchen"}]}'
    assert judge(text, HOME) == StepPlan(steps=(Find(object="cup", place="kitchen"),))


def test_words_for_people_are_cleaned_and_cut() -> None:
    words = "a\u202eb\ud800c\x00d\ne" + "x" * 5000
    judged = judge(json.dumps({"kind": "answer", "en": words}), HOME)
    assert isinstance(judged, AnswerPlan)
    assert judged.text.en.startswith("abcd e")
    assert len(judged.text.en) <= 600
    assert judged.text.zh == judged.text.en
    judged.model_dump_json()  # a broken character would end here
    said = judge('{"kind":"plan","steps":[{"kind":"say","text":"hi\\u202e there"}]}', HOME)
    assert said == StepPlan(steps=(Say(text="hi there"),))


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ('{"kind":"answer","en":"…","zh":"…"}', "answer needs words of your own"),
        ('{"kind":"answer","en":"Hello.","zh":"……。"}', "answer needs words of your own"),
        ('{"kind":"refuse","code":"unsafe","en":"...","zh":"…"}', "refuse needs words of your own"),
        ('{"kind":"plan","steps":[{"kind":"say","text":"…"}]}', "text needs words of your own"),
        ('{"kind":"plan","steps":[{"kind":"find","object":"…"}]}', "object needs words"),
        (
            '{"kind":"plan","steps":[{"kind":"repeat","steps":[{"kind":"ask","question":"…"}]}]}',
            "question needs words of your own",
        ),
    ],
)
def test_the_prompts_own_blank_is_no_words(text: str, told: str) -> None:
    """A model of 135 million parameters copied it as its answer to nearly every order."""
    judged = judge(text, HOME)
    assert isinstance(judged, Unusable)
    assert told in str(judged)


def test_a_symbol_says_something_and_a_blank_option_is_dropped() -> None:
    smile = judge('{"kind":"plan","steps":[{"kind":"say","text":"🙂"}]}', HOME)
    assert smile == StepPlan(steps=(Say(text="🙂"),))
    asked = {"kind": "clarify", "code": "ambiguous", "en": "Which?", "zh": "哪个？"}
    judged = judge(json.dumps({**asked, "options": ["…", "go to the kitchen"]}), HOME)
    assert isinstance(judged, Clarify)
    assert [option.text for option in judged.options] == ["go to the kitchen"]


def test_question_and_refusal_keep_code_and_options() -> None:
    asked = judge('{"kind":"clarify","code":"ambiguous","en":"Which?","zh":"哪个？",'
                  '"options":["go to the bed","go to the desk"]}', HOME)  # fmt: skip
    assert isinstance(asked, Clarify)
    assert [option.text for option in asked.options] == ["go to the bed", "go to the desk"]
    no = judge('{"kind":"refuse","code":"unsafe","en":"No.","zh":"不。"}', HOME)
    assert isinstance(no, Refuse)
    assert (no.code, no.reason.zh) == (Code.UNSAFE, "不。")


_JSON = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=12)
    | st.sampled_from(["plan", "go_to", "kitchen", "refuse", "unsafe", "nowhere"]),
    lambda inner: st.lists(inner, max_size=4)
    | st.dictionaries(
        st.sampled_from(["kind", "steps", "place", "en", "zh", "code", "options", "seconds", "x"]),
        inner, max_size=5,
    ),
    max_leaves=20,
)  # fmt: skip


@given(_JSON, st.text(max_size=20))
def test_any_json_is_a_valid_plan_or_refused(content: object, around: str) -> None:
    judged = judge(around + json.dumps(content) + around, HOME)
    if isinstance(judged, StepPlan):
        again = check_plan(judged, HOME)
        assert again is None or not again.repairable
        assert all(place in HOME for step in judged.steps for place in places_of(step))


@given(st.text(alphabet='{}[]":,think<>/`kind plan\\u0e1', max_size=300))
def test_any_text_is_read_without_a_fault(text: str) -> None:
    with contextlib.suppress(NoObject):
        assert isinstance(one_object(text), dict)


@pytest.mark.parametrize("words", ["yes", "No.", "好的", "不用了", "OK"])
def test_a_yes_or_no_is_no_order_to_offer(words: str) -> None:
    reply = {"kind": "clarify", "code": "ambiguous", "en": "Which?", "zh": "哪个？"}
    judged = judge(json.dumps(reply | {"options": [words, "go to the kitchen"]}), HOME)
    assert isinstance(judged, Clarify)
    assert [option.text for option in judged.options] == ["go to the kitchen"]


def _turn(**angle: object) -> str:
    return json.dumps({"kind": "plan", "steps": [{"kind": "turn", **angle}]})


@given(st.floats(-720.0, 720.0))
def test_degrees_are_kept_as_radians(deg: float) -> None:
    plan = judge(_turn(angle_deg=deg), HOME, EVERY_KIND)
    assert plan == judge(_turn(angle_rad=radians(deg)), HOME, EVERY_KIND)
    assert isinstance(plan, StepPlan)


@pytest.mark.parametrize(
    "angle",
    [
        {"angle_deg": 721},
        {"angle_deg": -1e9},
        {"angle_deg": "90"},
        {"angle_deg": True},
        {"angle_deg": 90, "angle_rad": 1.0},
        {"angle_deg": [90]},
    ],
)
def test_no_other_angle_in_degrees_is_taken(angle: dict[str, object]) -> None:
    told = judge(_turn(**angle), HOME, EVERY_KIND)
    assert isinstance(told, Unusable)
    assert "angle" in str(told)
    step = {"kind": "repeat", "times": 2, "steps": [{"kind": "turn", **angle}]}
    held = judge(json.dumps({"kind": "plan", "steps": [step]}), HOME, EVERY_KIND)
    assert isinstance(held, Unusable)
