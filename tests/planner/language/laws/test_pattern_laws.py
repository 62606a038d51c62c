"""Laws of every pattern that reads a person's words: no text makes one try ever more ways.

All modules are imported, sentences of all suites are read, and what is compiled for it is collected
where it is compiled, so that a pattern in a table is found as one at the top. From each its own
words are taken, one of each alternative, and said sixty times, bare and with a blank behind each,
with and without something behind that does not fit. A pattern that can read
such a text in two ways has a number of ways that doubles with each word; what fails is an alarm.
The times are no speeds: what is linear or quadratic takes a thousandth of them.
"""

from __future__ import annotations

import json
import random
import re
import signal
import subprocess
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from functools import cache
from itertools import islice
from re import _constants as kinds  # type: ignore[attr-defined]
from re import _parser as parser  # type: ignore[attr-defined]
from types import FrameType
from typing import Any

import pytest

from planner.language.changes.reader import read_changes
from planner.language.grammar.parser import plan
from planner.language.grammar.sentence_text import MOST_READ
from planner.language.motion_guard.clauses import read_clauses
from planner.language.recall import read_recall
from planner.language.sentence import parse
from planner.language.stop import calls_stop, read_stop
from planner.site import Site
from planner.site.site_view import vocabulary_of
from pons_assets import ROOT

HANGS_S, WORD_HANGS_S = 2.0, 1.0
TIMES = 60
MOST_WORDS = 150
"""Of one pattern: the longest and the shortest of its words."""
LENGTHS = (60, 400, 4_000)
EACH = 20
"""Of the suites' sentences one in so many is read, so that all patterns are compiled."""
VOCABULARY = vocabulary_of(Site.load(ROOT / "sites" / "home"))
COLLECT = """
import importlib, json, pkgutil, re, sys
found, compile_ = {}, re._compile
def collect(pattern, flags):
    if isinstance(pattern, str):
        frame = sys._getframe(1)
        while frame.f_code.co_filename.endswith("re/__init__.py"):
            frame = frame.f_back
        name = frame.f_globals.get("__name__", "")
        if name.split(".")[0] in PACKAGES:
            found[pattern, int(flags)] = name
    return compile_(pattern, flags)
PACKAGES = ("planner", "pons", "processes", "wire")
re._compile = collect
for package in PACKAGES:
    path = importlib.import_module(package).__path__
    for module in pkgutil.walk_packages(path, package + "."):
        if not module.name.endswith("__main__"):
            importlib.import_module(module.name)
from pathlib import Path
from tests.planner.language.laws.test_pattern_laws import at_the_door
from tests.planner.language.laws.test_suite_replies import sentences
for said in sentences(Path())[::EACH]:  # much is compiled when it is first needed
    at_the_door(said)
json.dump([(name, *key) for key, name in found.items()], sys.stdout)
"""


class Hangs(Exception):
    """A text has been tried for too long."""


@contextmanager
def alarm(what: str) -> Iterator[None]:
    """Raise where the lines within hang; the engine looks for signals while it tries.

    The processor's time counts, so that a busy machine rings nothing.
    """

    def ring(_number: int, _frame: FrameType | None) -> None:
        raise Hangs(what)

    before = signal.signal(signal.SIGVTALRM, ring)
    wind()
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)


def wind(limit_s: float = HANGS_S) -> None:
    """Give what follows its time anew."""
    signal.setitimer(signal.ITIMER_VIRTUAL, limit_s)


@cache
def patterns() -> list[tuple[str, re.Pattern[str]]]:
    told = subprocess.run(
        [sys.executable, "-c", f"EACH = {EACH}\n{COLLECT}"],
        capture_output=True,
        check=True,
        cwd=ROOT,
        text=True,
    )
    return [(name, re.compile(text, flags)) for name, text, flags in json.loads(told.stdout)]


def _one(kind: Any, of: Any) -> list[str] | None:
    """Return characters that a part of one character stands for; None: it is a longer part."""
    if kind is kinds.LITERAL:
        return [chr(of)]
    if kind in (kinds.NOT_LITERAL, kinds.ANY):
        return ["x"]
    if kind is not kinds.IN:
        return None
    if of[0][0] is kinds.NEGATE:
        return ["x", " ", "中"]
    categories = {kinds.CATEGORY_SPACE: " ", kinds.CATEGORY_DIGIT: "1", kinds.CATEGORY_WORD: "a"}
    return [
        chr(each) if op is kinds.LITERAL
        else chr(each[0]) if op is kinds.RANGE
        else categories.get(each, "!")
        for op, each in of
    ]  # fmt: skip


def words_of(tree: Iterable[Any], found: set[str]) -> list[str]:
    """Collect the words of a pattern and of its parts; return some texts of the whole."""
    texts = [""]
    for kind, of in tree:
        more = _one(kind, of)
        if more is not None:
            found.update(more)
        elif kind is kinds.BRANCH:
            more = [text for branch in of[1] for text in words_of(branch, found)]
        elif kind is kinds.SUBPATTERN:
            more = words_of(of[3], found)
        elif kind is kinds.ATOMIC_GROUP:
            more = words_of(of, found)
        elif kind in (kinds.MAX_REPEAT, kinds.MIN_REPEAT, kinds.POSSESSIVE_REPEAT):
            more = words_of(of[2], found)
            more = ["", *more] if more and of[0] == 0 else more
        elif kind in (kinds.ASSERT, kinds.ASSERT_NOT):
            words_of(of[1], found)
        if more:
            texts = [text + end for text in texts[:3] for end in more[:4]]
    found.update(text for text in texts if text)
    return [text for text in texts if text]


def spread(words: set[str]) -> list[str]:
    """Return at most so many words, of all lengths."""
    by_length = sorted(words, key=lambda word: (len(word), word))
    return list(islice(by_length[:: max(1, len(by_length) // MOST_WORDS)], MOST_WORDS))


def hangs(name: str, pattern: re.Pattern[str]) -> str | None:
    """Return the word that makes a pattern hang; None where none does.

    Searching begins at each character anew, which costs what it costs; it is not what doubles.
    """
    found: set[str] = set()
    words_of(parser.parse(pattern.pattern, pattern.flags), found)
    words = spread(found)
    draw = random.Random(1)
    pairs = ["".join(draw.choices(words, k=2)) for _ in range(10)] if words else []
    spaced = [word + " " for word in words]
    pairs += ["".join(draw.choices(spaced, k=2)) for _ in range(10)] if words else []
    word = ""
    try:
        with alarm(name):
            for word in (*words, *pairs, *spaced):
                wind(WORD_HANGS_S)
                said = (word * TIMES)[:MOST_READ]
                pattern.fullmatch(said)  # it goes every way that a match of the beginning goes
                pattern.fullmatch(said + "☃")
    except Hangs:
        return word
    return None


@pytest.mark.timeout(600)
def test_no_pattern_has_two_ways_to_read_its_own_words() -> None:
    all_patterns = patterns()
    assert len(all_patterns) > 800, "what is compiled in the tree is found"
    bad = [(n, p.pattern[:100], w) for n, p in all_patterns if (w := hangs(n, p)) is not None]
    assert not bad, bad


@pytest.mark.nightly(keep=1)
@pytest.mark.timeout(600)
@pytest.mark.parametrize("seed", range(4))
def test_no_repeated_words_hang_at_the_door(seed: int) -> None:
    found: set[str] = set()
    for name, pattern in patterns():
        if name.startswith("planner."):
            words_of(parser.parse(pattern.pattern, pattern.flags), found)
    draw, words = random.Random(seed), sorted(found)
    for _ in range(50):
        word = "".join(draw.choices(words, k=draw.choice((1, 1, 2, 3))))
        said = (word * TIMES * 70)[: draw.choice(LENGTHS)]
        for end in ("", "☃"):
            with alarm(word):
                at_the_door(said + end)


@pytest.mark.parametrize(
    "word",
    [*["喂", "哎", "诶", "啊哎呀", "先给我", "去", "到", "回", "在", "去找", "然后去", "劳驾你"],
     *["麻烦你", "刚", "刚刚", "真的", "那就", "多少个", "and ", "in the ", "x, unless x", " "],
     *["\t", ", aa", ",", "停", "stop ", "wait no ", "no wait ", "not that ", "and then "],
     *["please ", "again ", "i meant ", "不是", "不对，", "不，", "去厨房再", "你好", "找", "等"],
     *["go to the kitchen and ", "from ", "go from a to ", 'say "', "再", "the ", "get get "],
     *["i want you to ", "能吗", "( ", "1", "a in "]],
)  # fmt: skip
@pytest.mark.parametrize("length", LENGTHS)
def test_words_that_people_shout_over_and_over_are_read(word: str, length: int) -> None:
    with alarm(word):
        at_the_door((word * length)[:length])


def at_the_door(said: str) -> None:
    """Read a sentence as the planner does: for a stop, as a command, a change, then as an order."""
    read_stop(said)
    calls_stop(said)
    sentence = parse(said)
    for part in ("stays_put", "statement", "may_mean_stop", "consent"):
        getattr(sentence, part)
    read_changes(said, VOCABULARY)
    read_clauses(said, VOCABULARY)
    read_recall(said, VOCABULARY)
    plan(said, VOCABULARY)


def test_the_alarm_rings_for_a_pattern_with_two_ways() -> None:
    assert hangs("shown here", re.compile("(?:刚|刚刚)*才")) is not None
    assert hangs("shown here", re.compile("(?:and ?,? ?)*go")) is not None
    assert hangs("shown here", re.compile("(?:刚)*才")) is None
