"""An example with others' words in it is as whole an example, of the same plan otherwise."""

from __future__ import annotations

from itertools import islice
from random import Random

from planner.language.semantic_parser.linear_plan import read_actions
from planner.language.semantic_parser.plan_grammar import PlanNode, render_plan
from tools.train_reader.earlier_sentences import earlier_examples
from tools.train_reader.swapping import WordSwapper, quoted_spans


def _forms(plan: tuple[PlanNode, ...]) -> list[object]:
    return [
        (node.form, _forms(node.condition), [_forms(block) for block in node.blocks])
        for node in plan
    ]


def test_only_quoted_words_change_and_they_stay_between_their_borders() -> None:
    examples = list(islice(earlier_examples(), 400))
    swapper, random, changed = WordSwapper(examples), Random(3), 0
    for example in examples:
        made = swapper.swap(example, random)
        if made is example:
            continue
        changed += 1
        spans = [made.said.units[first : last + 1] for _, first, last in quoted_spans(made)]
        before = [example.said.units[a : b + 1] for _, a, b in quoted_spans(example)]
        assert len(spans) == len(before)
        rest = len(made.said.units) - sum(map(len, set(spans)))
        assert rest == len(example.said.units) - sum(map(len, set(before)))
        assert len(made.allowed) == len(made.actions) == len(made.parts)
        assert _forms(example.plan) == _forms(read_actions(example.actions, example.said))
        assert [a for a in made.actions if isinstance(a, str)] == [
            a for a in example.actions if isinstance(a, str)
        ], render_plan(example.plan)
    assert changed > 40
