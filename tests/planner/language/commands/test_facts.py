"""A newer word on where a thing is takes the place of the older one, and of no other."""

from __future__ import annotations

import pytest

from planner.language.commands import name_subject, read_fact_correction

KEYS, KEYS_ZH = "the keys are on the sofa", "车钥匙在餐桌上"


@pytest.mark.parametrize(
    ("told", "said", "now", "thing"),
    [
        (KEYS, "No wait, they're on the dining table, I just saw them.",
         "the keys are on the dining table", "keys"),
        (KEYS, "no, on the dining table", "the keys are on the dining table", "keys"),
        ("I've put the spare cable under the bed", "sorry, it's in the study",
         "the spare cable is in the study", "spare cable"),
        (KEYS_ZH, "哎讲错了，在沙发上", "车钥匙在沙发上", "车钥匙"),
        (KEYS_ZH, "不对，在沙发上", "车钥匙在沙发上", "车钥匙"),
        (KEYS_ZH, "不对不对，车钥匙在沙发上", "车钥匙在沙发上", "车钥匙"),
        (KEYS, "no, wait, the keys are in the study", "the keys are in the study", "keys"),
        (KEYS_ZH, "不对不对，钥匙在沙发上", "车钥匙在沙发上", "车钥匙"),
        (KEYS_ZH, "说错了，我的车钥匙是在沙发上", "车钥匙在沙发上", "车钥匙"),
    ],
)  # fmt: skip
def test_a_pronoun_means_the_thing_told_of_just_before(
    told: str, said: str, now: str, thing: str
) -> None:
    fact = read_fact_correction(said, told)
    assert fact is not None
    assert (fact.words, fact.instead_of) == (now, thing)
    assert name_subject(told) == name_subject(now) == thing
    assert read_fact_correction(said, None) is None


@pytest.mark.parametrize(
    ("said", "thing"),
    [
        ("the passports aren't on the desk any more, I moved them to the bedroom", "passports"),
        ("I've moved the ladder to the hallway", "ladder"),
        ("护照不在书桌上了，我放到卧室了", "护照"), ("钥匙不在沙发上了，我挂门后头了", "钥匙"),
    ],
)  # fmt: skip
def test_a_thing_that_was_moved_is_named(said: str, thing: str) -> None:
    fact = read_fact_correction(said, None)
    assert fact is not None
    assert fact.instead_of == thing


@pytest.mark.parametrize(
    ("told", "said"),
    [
        (KEYS, "no, the study"), (KEYS, "no, go to the kitchen"),
        (KEYS, "it's hot in here, go home"),
        (KEYS, "no, look on the dining table"), (KEYS, "are they on the dining table?"),
        ("Dad's working in the study today", "no wait, he's in the kitchen"),
        (KEYS_ZH, "不对，雨伞在沙发上"), (KEYS, "no, the umbrella is on the sofa"),
        (KEYS_ZH, "在沙发上"), (KEYS_ZH, "不对，去沙发"), (KEYS_ZH, "在沙发上吗"),
    ],
)  # fmt: skip
def test_an_order_a_question_or_another_thing_corrects_no_fact(told: str, said: str) -> None:
    assert read_fact_correction(said, told) is None
