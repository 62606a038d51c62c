"""The mutator changes one thing, says which, and knows a line again that has moved."""

from __future__ import annotations

import ast

import pytest

from tools.mutants.line_tests import diverse, move_lines
from tools.mutants.mutations import mutants_of

SOURCE = '''\
"""A module."""
LIMIT = 2.0
TABLE = {"a": 1, "b": 2}

def passes(x: int, tick: object) -> bool:
    """Tell."""
    tick.say("word", 3)
    tick.count = 0
    if x <= LIMIT and not x < 0:
        return True
    return False
'''


def test_it_changes_numbers_bounds_signs_and_statements_but_no_words() -> None:
    _, made = mutants_of(SOURCE)
    told = {(one.line, one.where, one.what) for one, _ in made}
    assert (2, "", "2.0 -> 2.2") in told
    assert (3, "", "without 'b'") in told
    assert (9, "passes", "LtE -> Lt") in told
    assert (9, "passes", "LtE -> Gt") in told
    assert (9, "passes", "And -> Or") in told
    assert (9, "passes", "not dropped") in told
    assert (8, "passes", "left out: tick.count = 0") in told
    assert (10, "passes", "True -> False") in told
    assert {line for line, _, _ in told}.isdisjoint({1, 5, 6, 7})
    assert len({one.key for one, _ in made}) == len(made)


@pytest.mark.parametrize(
    ("what", "text"),
    [("LtE -> Gt", "if x > LIMIT"), ("without 'b'", "{'a': 1}"), ("2.0 -> 2.2", "LIMIT = 2.2")],
)
def test_a_change_changes_the_tree_in_one_place(what: str, text: str) -> None:
    tree, made = mutants_of(SOURCE)
    [change] = [change for one, change in made if one.what == what]
    change()
    now = ast.unparse(ast.fix_missing_locations(tree)).splitlines()
    before = ast.unparse(ast.parse(SOURCE)).splitlines()
    [differs] = [line for line, old in zip(now, before, strict=True) if line != old]
    assert text in differs


def test_lines_that_moved_are_found_again_and_new_ones_are_not() -> None:
    walked = {1: ["a"], 2: ["b"], 3: ["c"]}
    assert move_lines(walked, "x\ny\nz\n", "new\nx\nother\nz\n") == {2: ["a"], 4: ["c"]}


def test_the_cheapest_come_first_and_then_the_one_that_differs() -> None:
    took = {"cheap": 0.001, "long": 0.02, "same": 0.019, "dear": 50.0}
    lines = {"m": {1: ["long", "same", "dear"], 2: ["long"], 3: ["cheap"], 4: ["dear"]}}
    order = diverse(took, lines, set(took))
    assert sorted(order, key=order.__getitem__) == ["cheap", "long", "same", "dear"]
