"""The catalogue renders messages in every language that has a file, a made-up one included."""

from __future__ import annotations

import asyncio
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path
from string import Formatter

import pytest

from planner.brain import OfflineBrain, ThinkRequest
from planner.language.catalogue import (
    CATALOGUE,
    Catalogue,
    UnknownMessage,
    Words,
    join,
    list_names,
    load,
    message,
    place_name,
    say,
    say_or_quote,
    template,
    words,
)
from planner.language.place_lists import known_places
from planner.mission.errors import JournalDown
from planner.plan import AnswerPlan, Bilingual, Clarify, Code, Entry, Language, Vocabulary, say_same
from planner.plan.steps import CALLS, CONTROL, EVERY_KIND, GIVEN, TOOL_CALLS

KITCHEN = Entry(id="kitchen", kind="room", name=Bilingual(en="kitchen", zh="厨房"))
BLANK = re.compile(r"(\{[^}]*\})")


def upper(text: str) -> str:
    """Return a message in capitals, its blanks as they were."""
    return "".join(part if BLANK.fullmatch(part) else part.upper() for part in BLANK.split(text))


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Return a copy of the catalogue with one file more: a language in which all is in capitals."""
    copy = tmp_path / "catalogue"
    shutil.copytree(words.FOLDER, copy, ignore=shutil.ignore_patterns("__pycache__"))
    english = next(each.messages for each in CATALOGUE.words if each.language == "en")
    groups: dict[str, list[str]] = {}
    for code, text in {**english, "number.decimal": ","}.items():
        group, _, key = code.partition(".")
        groups.setdefault(group, []).append(f"{key} = {json.dumps(upper(text))}")
    tables = (f"[{group}]\n" + "\n".join(lines) for group, lines in groups.items())
    (copy / "xx.toml").write_text("\n".join(tables), "utf-8")
    return copy


@pytest.fixture
def shouting(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Catalogue:
    """Return the catalogue with one language more, in use."""
    loaded = load(folder)
    monkeypatch.setattr(words, "CATALOGUE", loaded)
    return loaded


def test_a_language_more_is_a_file_more(shouting: Catalogue) -> None:
    for each in set(shouting.words[0].messages) - {"number.decimal"}:
        raw = shouting.raw(each, "en")
        names = {name for _, name, _, _ in Formatter().parse(raw) if name}
        facts = dict.fromkeys(names, 3)
        said = shouting.say(each, **facts)
        assert said.of("en") == raw.format(**facts)
        assert said.of("xx") == upper(raw).format(**facts)


@pytest.mark.timeout(300)  # a process that loads the planner, on however slow a computer
def test_everything_said_comes_from_the_file_of_a_language_and_no_code_names_it(
    folder: Path, repository: Path
) -> None:
    """Things, colours, rooms, directions, figures and buttons among it; a person's words stay."""
    told = subprocess.run(
        [sys.executable, "-m", "tests.planner.language.catalogue.third_language", folder.parent],
        cwd=repository, capture_output=True, text=True, check=True,
    )  # fmt: skip
    pairs = [json.loads(line) for line in told.stdout.splitlines()]
    assert len(pairs) > 400
    quoted = re.compile(r"“[^”]*”|\btoy\b|" + BLANK.pattern)
    assert [xx for _, xx in pairs if re.search("[a-z]", quoted.sub("", xx))] == []
    assert ["1.25 m forward", "1,25 M FORWARD"] in pairs
    assert ["two red boxes", "TWO RED BOXES"] in pairs


def test_facts_in_many_languages_fill_each_with_its_own_words(shouting: Catalogue) -> None:
    place = shouting.say("place.more", more=2)
    said = message(Code.ARRIVED, place=place)
    assert said.of("xx") == "ARRIVED: AND 2 MORE."
    assert said.model_dump() == {"en": "Arrived: and 2 more.", "zh": "我到了：还有 2 处。"}


def test_whole_answers_come_in_the_third_language(shouting: Catalogue) -> None:
    home = Vocabulary(entries=(KITCHEN.model_copy(update={"name": place_name("kitchen", "厨房")}),))

    def think(text: str) -> Bilingual:
        request = ThinkRequest(text=text, vocabulary=home, language=Language.EN)
        plan = asyncio.run(OfflineBrain().think(request)).plan
        assert isinstance(plan, AnswerPlan | Clarify)
        return plan.text if isinstance(plan, AnswerPlan) else plan.question

    assert think("where can you go?").of("xx") == "I CAN DRIVE TO: KITCHEN."
    asked = think("go to the cellar").of("xx")
    assert asked == "I KNOW NO PLACE CALLED “cellar”. KNOWN PLACES: KITCHEN."
    assert known_places(home, 0).of("xx") == "AND 1 MORE"


def test_what_a_language_lacks_is_told_in_english() -> None:
    thin = Catalogue((Words("en", {"a.b": "yes {x}"}), Words("zh", {"a.b": "是 {x}"}),
                      Words("xx", {})))  # fmt: skip
    assert thin.say("a.b", x=say_same("1")).of("xx") == "yes 1"
    assert thin.say("a.b", x=1).of("zh") == "是 1"


def test_without_english_or_chinese_there_is_no_catalogue() -> None:
    with pytest.raises(ValueError, match="lacks zh"):
        Catalogue((Words("en", {}),))


def test_an_unknown_code_and_an_open_blank_are_refused() -> None:
    with pytest.raises(UnknownMessage, match=r"no\.such"):
        say("no.such")
    with pytest.raises(KeyError, match="place"):
        message(Code.ARRIVED)


def test_lists_and_joints_are_each_languages_own() -> None:
    names = [Bilingual(en="hall", zh="门厅"), KITCHEN.name, say_same("x")]
    assert list_names(names) == Bilingual(en="hall, kitchen, x", zh="门厅、厨房、x")
    assert list_names(names, "joint.and") == Bilingual(en="hall, kitchen and x", zh="门厅、厨房和x")
    assert list_names(names[:1], "joint.and") == names[0]
    assert list_names(()) == say_same("")
    assert join(names) == Bilingual(en="hall kitchen x", zh="门厅厨房x")


def test_words_from_elsewhere_are_quoted_where_none_are_ours() -> None:
    assert say_or_quote("paused", "operator").en == "a person paused it"
    assert say_or_quote("paused", "odd") == say_same("odd")
    assert template(Code.BLIND).en == "I can't see now ({why})."


def test_to_arm_is_one_chinese_word() -> None:
    chinese = next(each.messages for each in CATALOGUE.words if each.language == "zh")
    assert "解锁" in chinese["order_reason.disarmed"]
    assert not [code for code, text in chinese.items() if "上电" in text]


@pytest.mark.parametrize("group", ["blind", "step_kind", "goal_act", "goal_state", "plan"])
def test_what_is_put_into_a_chinese_sentence_is_chinese(group: str) -> None:
    for key in CATALOGUE.keys(group):
        assert not re.search("[a-z]{2}", CATALOGUE.raw(f"{group}.{key}", "zh")), key


def test_every_step_that_a_robot_may_lack_the_means_for_has_words() -> None:
    assert set(CATALOGUE.keys("step_kind")) == (EVERY_KIND | GIVEN | CALLS | TOOL_CALLS) - CONTROL


def test_a_journal_that_fails_is_told_in_each_language() -> None:
    assert JournalDown(None).message.zh == "任务日志无法写入（磁盘太慢）；恢复之前不接受任务"
    failed = JournalDown("disk I/O error").message
    assert "disk I/O error" in failed.en
    assert "error" not in failed.zh
