"""Every code of a site that can't be used has a Chinese sentence without an English tail."""

from __future__ import annotations

import re

import pytest

from maps.errors import REASONS, SiteError

_COMMANDS = re.compile(r"pons (?:map|up)|--mend|--without|YAML|JSON|CARMEN")


@pytest.mark.parametrize("code", REASONS)
def test_a_refusal_without_a_chinese_sentence_of_its_own_has_that_of_its_code(code: str) -> None:
    refused = SiteError(code, "/tmp/den: is a directory")
    assert refused.message["en"] == "/tmp/den: is a directory"
    assert not re.search("[a-z]{2}", _COMMANDS.sub("", refused.message["zh"]))


def test_a_chinese_sentence_of_its_own_is_kept() -> None:
    assert SiteError("site_exists", "it exists", "已存在").message["zh"] == "已存在"
