"""Test that whatever the system refuses is told in Chinese."""

from __future__ import annotations

import errno
from pathlib import Path

import pytest

from maps.file_errors import system_reason_zh, unwritable
from tests.site_sentences import english_in, flaws_of


@pytest.mark.parametrize("number", sorted(errno.errorcode))
def test_every_error_of_the_system_is_told_without_english(number: int) -> None:
    error = OSError(number, "No such thing in there")
    assert english_in(system_reason_zh(error)) == ""
    assert flaws_of(unwritable(Path("/tmp/site"), error)) == []
