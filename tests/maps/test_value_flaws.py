"""What is wrong with a value is said in words that know neither Python nor pydantic."""

from __future__ import annotations

from pathlib import Path

import pytest

from maps import SiteError
from maps.map_file import MapRecord
from maps.yaml_records import parse_yaml

WHERE = Path("map.yaml")
GOOD = {
    "image": "map.pgm",
    "resolution": "0.05",
    "origin": "[0, 0, 0]",
    "occupied_thresh": "0.65",
    "free_thresh": "0.196",
}


def refusal(**changed: str) -> SiteError:
    lines = [f"{key}: {value}" for key, value in {**GOOD, **changed}.items() if value]
    with pytest.raises(SiteError) as caught:
        parse_yaml("\n".join(lines).encode(), MapRecord, WHERE)
    return caught.value


@pytest.mark.parametrize(
    ("changed", "en", "zh"),
    [
        (
            {"image": ""},
            "the key 'image' is missing; known keys of the file: free_",
            "缺少键 'image'",
        ),
        (
            {"resolution": "0"},
            "resolution: expected at least 0.005, got 0",
            "应为不小于 0.005，收到 0",
        ),
        ({"resolution": "10"}, "expected at most 1.0, got 10", "应为不大于 1.0，收到 10"),
        ({"resolution": ".nan"}, "expected a finite number, got nan", "应为有限的数，收到 nan"),
        ({"resolution": "wide"}, "expected a number, got 'wide'", "应为数字，收到 'wide'"),
        ({"resolution": "yes"}, "expected a number, got True", "应为数字，收到 True"),
        ({"origin": "[0, 0]"}, "origin: value 3 is missing; got [0, 0]", "缺少第 3 个值"),
        (
            {"origin": "[0, 0, 0, 0]"},
            "expected a list of at most 3, got [0, 0, 0, 0]",
            "至多含 3 项",
        ),
        ({"origin": "here"}, "origin: expected a list, got 'here'", "应为列表"),
        ({"mode": "maps"}, "expected 'trinary', 'scale' or 'raw', got 'maps'", "应为 'trinary'"),
        ({"negate": "2"}, ": negate: expected 0 or 1, got 2", "：negate：应为 0"),
    ],
)
def test_each_says_what_came_and_what_was_expected(
    changed: dict[str, str], en: str, zh: str
) -> None:
    refused = refusal(**changed)
    assert refused.code == "value_malformed"
    assert en in refused.message["en"]
    assert zh in refused.message["zh"]
    for words in refused.message.values():
        assert "map.yaml" in words
        assert "Input should" not in words


@pytest.mark.parametrize("text", [b"", b"- 1\n", b"words\n"])
def test_a_file_that_holds_no_keys_says_so(text: bytes) -> None:
    with pytest.raises(SiteError) as caught:
        parse_yaml(text, MapRecord, WHERE)
    assert "the file: expected keys with their values" in caught.value.message["en"]
    assert "文件：应为键和值" in caught.value.message["zh"]


def test_an_unknown_key_names_those_that_exist() -> None:
    refused = refusal(resolutoin="1")
    assert refused.code == "unknown_key"
    assert "resolution" in refused.message["zh"]
    assert "未知的键" in refused.message["zh"]
