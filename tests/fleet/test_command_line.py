"""``pons fleet`` is spoken to as other commands are: help with examples, JSON when asked for."""

from __future__ import annotations

import re

import pytest

from fleet.__main__ import grammar, main
from pons.completion import _commands

COMMANDS = sorted(_commands(grammar()))


@pytest.mark.parametrize("command", ["", *COMMANDS])
def test_each_help_has_a_sentence_and_an_example(
    command: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as ended:
        main([*command.split(), "--help"])
    told = capsys.readouterr().out
    assert ended.value.code == 0
    assert re.search(r"\n\n[A-Z][^\n]*(\n[^\n]+)*\.\n", told), told
    assert f"\nexamples:\n  pons fleet {command}" in told


@pytest.mark.parametrize(
    "words",
    ["list", "say x", "stop r1", "answer m yes", "cancel m --give-up", "resume m", "pause m",
     "to m r2", "house", "every 19:00 x", "orders"],
)  # fmt: skip
def test_json_is_asked_for_before_or_behind_the_command(words: str) -> None:
    name, *rest = words.split()
    for given, is_asked in (
        ([name, *rest], False), ([name, *rest, "--json"], True), (["--json", name, *rest], True),
    ):  # fmt: skip
        assert grammar().parse_args(given).json is is_asked


def test_a_wrong_command_is_answered_by_the_nearest(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["lst"])
    assert ended.value.code == 2
    assert "did you mean list" in capsys.readouterr().err
