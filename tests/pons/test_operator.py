"""An operator whose order is refused reads why, in English and Chinese."""

from __future__ import annotations

import pytest

from pons.bridge_client import refusal_lines
from wire import Answer, OpKind


def refused(kind: OpKind, code: str, detail: str) -> list[str]:
    return refusal_lines(kind, Answer(id="a", kind=kind, accepted=False, code=code, detail=detail))


@pytest.mark.parametrize(
    ("kind", "code", "detail", "said"),
    [
        ("arm", "not_disarmed", "mode is SELFTEST; arming starts from DISARMED", "still tests"),
        ("arm", "not_disarmed", "mode is HOLD; arming starts from DISARMED", "armed already"),
        ("reset", "not_latched", "mode is HOLD", "nothing to reset"),
    ],
)
def test_a_refusal_says_what_came_and_why_in_both_languages(
    kind: OpKind, code: str, detail: str, said: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    lines = refused(kind, code, detail)
    monkeypatch.setenv("LC_ALL", "zh_CN.UTF-8")
    lines += refused(kind, code, detail)[1:]
    assert lines[0] == f"{kind}: refused, {code}: {detail}"
    why = "\n".join(lines[1:])
    assert said in why
    assert any(ord(letter) > 0x2E80 for letter in why)


def test_a_code_without_words_is_still_said() -> None:
    assert refused("arm", "odd", "x") == ["arm: refused, odd: x"]
