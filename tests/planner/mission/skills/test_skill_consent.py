"""Check what counts as a plain yes and a plain no: nothing else may set a robot off."""

from __future__ import annotations

import pytest

from planner.mission.skills.consent import consents

YES = (
    "yes", "Yes!", "YES, PLEASE.", "yeah", "ok", "Okay, go ahead", "sure, thank you", "please do",
    "yes go there", "Pons, yes", "y", "是", "是的。", "好", "好的，谢谢", "好吧", "可以的",
    "行", "对对对", "那就去吧", "沒問題", "请开过去", "當然可以", "要",
)  # fmt: skip
NO = (
    "no", "No, thanks.", "nope", "don't", "don’t go there", "Please do not", "no no", "not now",
    "不", "不要", "不用，谢谢", "不是的", "别去", "別過去", "不行不行", "请不要", "否",
)  # fmt: skip
NEITHER = (
    "", " ", "please", "yes?", "yes no", "no, yes", "ok no", "yes but slowly", "yesterday", "maybe",
    "what is there?", "the kitchen", "if it is a guitar, yes", "yes\u200b", "y" * 81,
    "go to the sofa", "好不好", "是不是", "好了", "行了", "对了", "要是", "要不",
    "去不去", "不用谢", "可能是", "是吗", "好的，不要",
)  # fmt: skip


@pytest.mark.parametrize(
    ("answers", "meaning"), [(YES, True), (NO, False), (NEITHER, None)], ids=["yes", "no", "else"]
)
def test_only_what_says_it_wholly_is_a_yes_or_a_no(
    answers: tuple[str, ...], meaning: bool | None
) -> None:
    assert {answer: consents(answer) for answer in answers} == dict.fromkeys(answers, meaning)
