"""Say in plain words of both languages what is wrong with a value in a site's file. Pure.

pydantic finds what is wrong; its own words speak of tuples and models, which no site's owner knows.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from maps.errors import BilingualError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from pydantic_core import ErrorDetails

_LONGEST = 80
_UNFIT = "这个值不合要求"
_NUMBER = ("a number", "数字")
_KEYS = ("keys with their values", "键和值")
_EXPECTED: Mapping[str, tuple[str, str]] = {
    "greater_than_equal": ("at least {ge}", "不小于 {ge}"),
    "less_than_equal": ("at most {le}", "不大于 {le}"),
    "greater_than": ("more than {gt}", "大于 {gt}"),
    "finite_number": ("a finite number", "有限的数"),
    "float_parsing": _NUMBER,
    "float_type": _NUMBER,
    "int_parsing": ("a whole number", "整数"),
    "int_type": ("a whole number", "整数"),
    "int_from_float": ("a whole number", "整数"),
    "literal_error": ("{expected}", "{expected}"),
    "string_type": ("text", "文字"),
    "string_too_short": ("at least {min_length} characters", "至少 {min_length} 个字符"),
    "string_too_long": ("at most {max_length} characters", "至多 {max_length} 个字符"),
    "string_pattern_mismatch": ("text like {pattern}", "符合 {pattern} 的文字"),
    "tuple_type": ("a list", "列表"),
    "model_type": _KEYS,
    "dataclass_type": _KEYS,
    "dict_type": _KEYS,
    "too_short": ("a list of at least {min_length}", "至少含 {min_length} 项的列表"),
    "too_long": ("a list of at most {max_length}", "至多含 {max_length} 项的列表"),
}
"""By pydantic's kind of error. Source: docs.pydantic.dev, "Validation Errors"."""

_KINDS = frozenset({"bool", "int", "float", "str"})
"""What pydantic sets behind the key of a value of several kinds; no file has such a key."""


def describe(flaw: ErrorDetails, known: tuple[str, ...]) -> tuple[str, str]:
    """Return where a flaw is and what was expected, in English and in Chinese.

    Args:
        flaw: one of pydantic's errors.
        known: the keys that stand at the file's top.
    """
    loc = tuple(part for part in flaw["loc"] if not _names_a_kind(part))
    at = ".".join(map(str, loc))
    kind, last = flaw["type"], loc[-1] if loc else None
    came = repr(flaw.get("input"))[:_LONGEST]
    if kind == "missing":
        if isinstance(last, int):
            above = ".".join(map(str, loc[:-1]))
            return f"{above}: value {last + 1} is missing; got {came}", (
                f"{above}：缺少第 {last + 1} 个值，收到 {came}"
            )
        keys = ", ".join(known) if len(loc) == 1 else ""
        return f"the key {at!r} is missing" + (
            f"; known keys of the file: {keys}" if keys else ""
        ), (f"缺少键 {at!r}" + (f"；文件可用的键：{keys}" if keys else ""))
    if kind == "value_error":  # one of our own laws, which says what came
        told = flaw["msg"].removeprefix("Value error, ")
        return _at(at, told, expected_zh(flaw))
    english, _ = _EXPECTED.get(kind, (flaw["msg"], ""))
    facts: dict[str, Any] = dict(flaw.get("ctx", {}))
    return (
        f"{at or 'the file'}: expected {english.format_map(facts)}, got {came}",
        f"{at or '文件'}：{expected_zh(flaw)}，收到 {came}",
    )


def _names_a_kind(part: int | str) -> bool:
    """Return whether pydantic means one of a value's kinds by it, as in ``literal[0,1]``."""
    return isinstance(part, str) and (part in _KINDS or "[" in part)


def expected_zh(flaw: Mapping[str, Any]) -> str:
    """Return in Chinese what pydantic expected in a value's place, or which law it breaks."""
    facts: dict[str, Any] = dict(flaw.get("ctx", {}))
    law = facts.get("error")
    if isinstance(law, BilingualError):
        return law.zh
    _, chinese = _EXPECTED.get(flaw["type"], ("", ""))
    if not chinese:
        return _UNFIT
    facts["expected"] = str(facts.get("expected", "")).replace(" or ", " 或 ")
    return f"应为{_set_apart(chinese.format_map(facts))}"


def _at(at: str, told: str, told_zh: str) -> tuple[str, str]:
    return f"{at or 'the file'}: {told}", f"{at or '文件'}：{told_zh}"


def _set_apart(chinese: str) -> str:
    """Set Latin text apart from the Chinese before it."""
    return f" {chinese}" if chinese[:1].isascii() else chinese
