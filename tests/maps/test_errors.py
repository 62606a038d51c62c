"""Test the judge of Chinese sentences, and that an error keeps both of its sentences."""

from __future__ import annotations

import pytest

from maps.errors import BilingualError, SiteError
from tests.site_sentences import english_in


@pytest.mark.parametrize(
    ("chinese", "english"),
    [
        ("无法读取 /tmp/a b/map.pgm（没有权限）", ""),
        ("请写成 'image: the map.pgm here'", ""),
        ("新建：`pons site import MAP.yaml NAME`", ""),
        ("新建：pons map attic --mend", ""),
        ("请说明：--unknown unknown 或 --unknown free", ""),
        ("地图格式错误：the key is given twice", "the key is given twice"),
    ],
)
def test_english_is_found_beside_names_and_commands(chinese: str, english: str) -> None:
    assert english_in(chinese) == english


def test_an_error_keeps_both_sentences() -> None:
    error = SiteError("site_missing", "no site", "没有站点")
    assert error.message == {"en": "no site", "zh": "没有站点"}
    inner = BilingualError("no area", "没有面积")
    assert (str(inner), inner.zh) == ("no area", "没有面积")
