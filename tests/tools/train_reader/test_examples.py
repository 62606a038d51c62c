"""Sentences become examples whose actions write their plans; intents become plans."""

from __future__ import annotations

from itertools import islice
from pathlib import Path

import pytest

from planner.language.semantic_parser.linear_plan import TOKENS
from planner.language.semantic_parser.plan_grammar import parse_plan, render_plan
from planner.language.semantic_parser.units import Gazetteer, cut_units
from tests.known import known
from tools.train_reader.earlier_sentences import earlier_examples, home_names, label_of
from tools.train_reader.evaluation import Verdict, bare, motions
from tools.train_reader.examples import make_example, written_examples
from tools.train_reader.sentences import COLUMNS

NAMES = Gazetteer({"hall": "hall", "kitchen": "kitchen"})


@pytest.mark.parametrize(
    ("intent", "sentence", "slots", "label"),
    [
        ("go", "off to the kitchen with you", {}, "go(kitchen)"),
        ("find_at", "keys in the kitchen?", {"t": "keys"}, 'find("keys", in kitchen)'),
        ("person_at", "anyone in the kitchen", {}, 'check("anyone", in kitchen)'),
        ("turn", "left a bit", {}, "turn(left, a bit)"),
        ("turn", "thirty degrees left", {}, "turn(left, 30 deg)"),
        ("turn", "about turn", {}, "turn(around)"),
        ("backward", "back off a metre", {}, "move(backward, 1 m)"),
        ("go_back", "kitchen, two minutes, back", {}, "go(kitchen); wait(2 min); back"),
        ("go_back", "kitchen and back", {}, "go(kitchen); back"),
        ("none", "nice kitchen", {}, "none"),
        ("other", "kitchen, then the study", {}, None),
        ("find_at", "have you seen it?", {}, None),
    ],
)
def test_an_intent_with_its_slots_is_a_plan(
    intent: str, sentence: str, slots: dict[str, str], label: str | None
) -> None:
    assert label_of(intent, cut_units(sentence, home_names()), slots) == label


def test_the_earlier_sentences_give_plans_of_the_grammar() -> None:
    examples = list(islice(earlier_examples(), 200))
    assert len(examples) == 200
    for example in examples:
        assert parse_plan(render_plan(example.plan)) == example.plan
        assert len(example.actions) == len(example.allowed)


def test_an_example_allows_what_it_does() -> None:
    said = cut_units("to the hall, then find my red cup", NAMES)
    example = known(make_example("en1", "plain", said, 'go(hall); find("red cup")'))
    for action, (tokens, units) in zip(example.actions, example.allowed, strict=True):
        assert TOKENS.index(action) in tokens if isinstance(action, str) else action in units


def test_a_sentence_that_lacks_its_labels_words_is_no_example() -> None:
    said = cut_units("to the hall", NAMES)
    assert make_example("en1", "plain", said, "go(kitchen)") is None
    assert make_example("en1", "plain", cut_units("", NAMES), "home") is None


def test_faulty_rows_are_left_out(tmp_path: Path) -> None:
    rows = [
        ("en01-000-plain", "en", "p", "s", "hall | kitchen", "go(hall)", "hall, now"),
        ("en01-001-plain", "en", "p", "s", "hall | kitchen", "go(hall)", "kitchen, now"),
        ("en01-002-plain", "en", "p", "s", "hall | kitchen", "go(hall", "hall, now"),
    ]
    path = tmp_path / "en_01.tsv"
    path.write_text("\n".join("\t".join(row) for row in [COLUMNS, *rows]), "utf-8")
    assert [example.writer for example in written_examples(path)] == ["en_01"]


def test_articles_and_capitals_make_no_other_plan() -> None:
    assert bare(parse_plan('find("The Cup")')) == bare(parse_plan('find("cup")'))
    assert bare(parse_plan('find("cup")')) != bare(parse_plan('find("mug")'))


def test_a_motion_is_another_where_place_or_condition_differ() -> None:
    said = cut_units("if Dad is in the hall go to the kitchen", NAMES)
    label = 'if check("Dad", in hall) { go(kitchen) }'
    example = known(make_example("en1", "condition", said, label))
    assert Verdict(example, parse_plan(label), 1.0).same_motion
    for other in (
        "go(kitchen)",
        label.replace("if", "if not", 1),
        label.replace("kitchen", "hall"),
    ):
        assert not Verdict(example, parse_plan(other), 1.0).same_motion
    assert not list(motions(parse_plan("none")))
