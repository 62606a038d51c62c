"""Make mutants of a module's source: one small change each. Pure; knows no tests.

Changed are comparisons, boolean and arithmetic operators, conditions, numbers, truth values,
statements (left out), and entries of tables outside functions (left out). Not changed: imports,
annotations, decorators, words, and what only tells (``say``, ``drop``, evidence).
"""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

SWAPS: dict[type[ast.AST], tuple[type[ast.AST], ...]] = {
    ast.Lt: (ast.LtE, ast.GtE),
    ast.LtE: (ast.Lt, ast.Gt),
    ast.Gt: (ast.GtE, ast.LtE),
    ast.GtE: (ast.Gt, ast.Lt),
    ast.Eq: (ast.NotEq,),
    ast.NotEq: (ast.Eq,),
    ast.Is: (ast.IsNot,),
    ast.IsNot: (ast.Is,),
    ast.In: (ast.NotIn,),
    ast.NotIn: (ast.In,),
    ast.And: (ast.Or,),
    ast.Or: (ast.And,),
    ast.Add: (ast.Sub,),
    ast.Sub: (ast.Add,),
    ast.Mult: (ast.Div,),
    ast.Div: (ast.Mult,),
}


@dataclass(frozen=True)
class Mutant:
    """Name one change of a module."""

    number: int
    key: str
    """Stays the same while the changed line does."""
    line: int
    where: str
    """Qualified name of the function; empty outside of any."""
    what: str


Change = tuple[str, int, Callable[[], None]]
"""What, its line (0: the node's own), do it."""


def mutants_of(source: str) -> tuple[ast.Module, list[tuple[Mutant, Callable[[], None]]]]:
    """Return a module's tree, and all its mutants in the order of its lines.

    Each comes with a function that makes its change in the tree, once and for good.
    """
    lines = source.splitlines()
    tree = ast.parse(source)
    found: list[tuple[Mutant, Callable[[], None]]] = []
    seen: Counter[str] = Counter()
    for number, (node, where, change) in enumerate(_all_changes(tree)):
        what, at, do = change
        line: int = at or getattr(node, "lineno", 0)
        key = f"{where}:{lines[line - 1].strip() if line else ''}:{what}"
        found.append((Mutant(number, f"{key}:{seen[key]}", line, where, what), do))
        seen[key] += 1
    return tree, sorted(found, key=lambda one: (one[0].line, one[0].number))


def _all_changes(tree: ast.Module) -> Iterator[tuple[ast.AST, str, Change]]:
    for node, where in _walk(tree.body, ""):
        for change in _changes(node, where):
            yield node, where, change


def _walk(nodes: list[ast.stmt], where: str) -> Iterator[tuple[ast.AST, str]]:
    """Yield what may be changed, with the function that it is in."""
    for node in nodes:
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            inner = f"{where}.{node.name}" if where else node.name
            yield node, inner
            yield from _walk(node.body, inner)
        elif isinstance(node, ast.Import | ast.ImportFrom) or _only_tells(node):
            continue
        else:
            if not isinstance(node, ast.If) or ast.unparse(node.test) != "TYPE_CHECKING":
                yield from _walk_fields(node, where)


def _walk_fields(node: ast.AST, where: str) -> Iterator[tuple[ast.AST, str]]:
    yield node, where
    for name, value in ast.iter_fields(node):
        if name in {"annotation", "decorator_list", "returns"}:
            continue
        for child in value if isinstance(value, list) else [value]:
            if isinstance(child, ast.AST) and not isinstance(child, ast.JoinedStr):
                if isinstance(child, ast.stmt) and _only_tells(child):
                    continue
                yield from _walk_fields(child, where)


def _only_tells(node: ast.stmt) -> bool:
    if not isinstance(node, ast.Expr):
        return False
    value = node.value
    if isinstance(value, ast.Constant) or ast.unparse(value).startswith("tick.reasons."):
        return True  # a docstring, or a reason for the record
    called = value.func if isinstance(value, ast.Call) else None
    return isinstance(called, ast.Attribute) and called.attr in {"say", "drop"}


def _changes(node: ast.AST, where: str) -> Iterator[Change]:
    yield from _other_operators(node)
    yield from _other_values(node)
    if not where or where.rpartition(".")[2][:1].isupper():  # in no function: tables
        yield from _entries_left_out(node)
    else:
        yield from _left_out(node)


def _other_operators(node: ast.AST) -> Iterator[Change]:
    if isinstance(node, ast.Compare):
        for index, op in enumerate(node.ops):
            for other in SWAPS.get(type(op), ()):
                yield _put(node.ops, index, other(), f"{_name(op)} -> {other.__name__}")
    elif isinstance(node, ast.BoolOp | ast.BinOp):
        for other in SWAPS.get(type(node.op), ()):
            yield _set(node, "op", other(), f"{_name(node.op)} -> {other.__name__}")


def _other_values(node: ast.AST) -> Iterator[Change]:
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        yield _set(node, "op", ast.UAdd(), "minus dropped")
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
        yield _set(node, "operand", ast.UnaryOp(ast.Not(), node.operand), "not dropped")
    elif isinstance(node, ast.If | ast.IfExp | ast.While):
        yield _set(node, "test", ast.UnaryOp(ast.Not(), node.test), "condition negated")
    elif isinstance(node, ast.Constant) and isinstance(node.value, bool):
        yield _set(node, "value", not node.value, f"{node.value} -> {not node.value}")
    elif isinstance(node, ast.Constant) and isinstance(node.value, int | float):
        old = node.value
        new = old + 1 if isinstance(old, int) else old * 1.1 if old else 1.0
        yield _set(node, "value", new, f"{old} -> {new}")


def _entries_left_out(node: ast.AST) -> Iterator[Change]:
    if isinstance(node, ast.Dict):
        for index, key in enumerate(node.keys):
            if key is not None:
                yield _without_entry(index, node.keys, node.values)
    elif isinstance(node, ast.Tuple | ast.Set) and len(node.elts) > 1:
        for index in range(len(node.elts)):
            yield _without_entry(index, node.elts)


def _left_out(node: ast.AST) -> Iterator[Change]:
    """Leave out one statement of a body; assignments of plain names are needed by the next line."""
    for field in ("body", "orelse"):
        body = getattr(node, field, None)
        if isinstance(body, list):
            for index, one in enumerate(body):
                plain = isinstance(one, ast.Assign) and isinstance(one.targets[0], ast.Name)
                whole = isinstance(one, ast.Expr | ast.Assign | ast.AugAssign) and not plain
                if whole and not _only_tells(one):
                    yield _put(
                        body, index, ast.Pass(), f"left out: {ast.unparse(one)[:60]}", one.lineno
                    )


def _put(items: list[Any], index: int, new: ast.AST, what: str, line: int = 0) -> Change:
    return what, line, lambda: items.__setitem__(index, new)


def _set(node: ast.AST, field: str, new: object, what: str) -> Change:
    return what, 0, lambda: setattr(node, field, new)


def _without_entry(index: int, *lists: list[Any]) -> Change:
    entry = lists[0][index]

    def do() -> None:
        for items in lists:
            del items[index]

    line: int = getattr(entry, "lineno", 0)
    return f"without {ast.unparse(entry)[:50]}", line, do


def _name(op: ast.AST) -> str:
    return type(op).__name__
