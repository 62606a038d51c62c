"""Rewrite a module of the core for the compiler: records become plain classes with constructors.

The compiler makes C structs of plain classes, but calls a dataclass's generated methods through the
interpreter, and keeps a module's constant in a dictionary unless it is final. Knows the few forms
that the core uses and refuses any other. What it makes is proven equal, tick for tick.
"""

from __future__ import annotations

import ast
import re
from dataclasses import dataclass

CONSTANT = re.compile(r"_?[A-Z][A-Z0-9_]+$")
FUTURE = "from __future__ import annotations\n"
HEAD = """
from typing import TYPE_CHECKING, Final
from wire.native import dress
if TYPE_CHECKING:
    from mypy_extensions import mypyc_attr
"""


class Unknown(Exception):
    """A form that the rewriting does not know: ours to teach it, or to write otherwise."""


@dataclass(frozen=True, slots=True)
class Field:
    """Give one field of a record."""

    name: str
    type: str
    default: str | None = None
    factory: str | None = None


def rewritten(source: str, known: dict[str, list[Field]]) -> str:
    """Return a module for the compiler.

    Args:
        source: of the module.
        known: the fields of all records of all modules, by class name.

    Raises:
        Unknown: it uses a form that is not known here.
    """
    tree = ast.parse(source)
    edits: list[tuple[int, int, list[str]]] = []
    dressing: list[str] = []
    for node in tree.body:
        if isinstance(node, ast.ClassDef) and is_record(node):
            lines, dressed = _record(node)
            edits.append((min(d.lineno for d in node.decorator_list), _end(node), lines))
            dressing.append(dressed)
        elif lines := _statement(node, known):
            edits.append((node.lineno, _end(node), lines))
    text = source.splitlines()
    for first, last, lines in sorted(edits, reverse=True):
        text[first - 1 : last] = lines
    whole = "\n".join((*text, *dressing)) + "\n"
    if FUTURE not in whole:
        return whole
    return whole.replace(FUTURE, FUTURE + HEAD, 1)


def is_record(node: ast.ClassDef) -> bool:
    """Tell whether a class is a dataclass or a value."""
    names = [ast.unparse(decorator).partition("(")[0] for decorator in node.decorator_list]
    return bool({"value", "dataclass"} & set(names))


def fields_of(node: ast.ClassDef) -> list[Field]:
    """Return a record's fields.

    Raises:
        Unknown: a default of a form that is not known here.
    """
    return [
        _field(item.target.id, ast.unparse(item.annotation), item.value)
        for item in node.body
        if isinstance(item, ast.AnnAssign)
        and isinstance(item.target, ast.Name)
        and not _is_class_var(item)
    ]


def _field(name: str, type_text: str, value: ast.expr | None) -> Field:
    if value is None:
        return Field(name, type_text)
    if not (isinstance(value, ast.Call) and ast.unparse(value.func) == "field"):
        return Field(name, type_text, default=ast.unparse(value))
    keywords = {keyword.arg: ast.unparse(keyword.value) for keyword in value.keywords}
    if set(keywords) == {"default_factory"} and not value.args:
        return Field(name, type_text, factory=keywords["default_factory"])
    raise Unknown(f"line {value.lineno}: field({', '.join(map(str, keywords))}) of {name}")


def _is_class_var(item: ast.AnnAssign) -> bool:
    return ast.unparse(item.annotation).startswith("ClassVar")


def _end(node: ast.stmt) -> int:
    return node.end_lineno or node.lineno


def _record(node: ast.ClassDef) -> tuple[list[str], str]:
    """Return the class as the compiler likes it, and the line that dresses it."""
    fields, name = fields_of(node), node.name
    given = "".join(f", {_parameter(field)}" for field in fields)
    equal = "".join(f" and self.{field.name} == other.{field.name}" for field in fields)
    lines = [
        # Else its __new__ would want the arguments too, and pydantic gives it none.
        "@mypyc_attr(allow_interpreted_subclasses=True)",
        f"class {name}:",
        f"    __slots__ = ({''.join(f'{field.name!r}, ' for field in fields)})",
        f"    def __init__(self{given}) -> None:",
        *(f"        self.{field.name}: {field.type} = {_initial(field)}" for field in fields),
        "    def __eq__(self, other: object) -> bool:",
        f"        return isinstance(other, {name}){equal}",
    ]
    if not _is_plain_dataclass(node):
        key = "".join(f"self.{field.name}, " for field in fields)
        lines += ["    def __hash__(self) -> int:", f"        return hash(({key}))"]
    config = "None"
    for item in node.body:
        if isinstance(item, ast.FunctionDef):
            lines += [f"    {line}" for line in ast.unparse(item).splitlines()]
        elif isinstance(item, ast.AnnAssign) and _is_class_var(item):
            config = _config(item)
        elif not isinstance(item, (ast.AnnAssign, ast.Expr)):
            raise Unknown(f"line {item.lineno}: {type(item).__name__} in the record {name}")
    return lines, _dressing(name, fields, config)


def _is_plain_dataclass(node: ast.ClassDef) -> bool:
    """Tell whether it may be written to, and so has no hash."""
    texts = [ast.unparse(decorator) for decorator in node.decorator_list]
    return all("frozen=True" not in text and text != "value" for text in texts)


def _config(item: ast.AnnAssign) -> str:
    if ast.unparse(item.target) == "__pydantic_config__" and item.value is not None:
        return ast.unparse(item.value)
    raise Unknown(f"line {item.lineno}: class variable {ast.unparse(item.target)}")


def _parameter(field: Field) -> str:
    if field.factory is not None:
        return f"{field.name}: {field.type} | None = None"
    default = "" if field.default is None else f" = {field.default}"
    return f"{field.name}: {field.type}{default}"


def _initial(field: Field) -> str:
    if field.factory is None:
        return field.name
    return f"{field.factory}() if {field.name} is None else {field.name}"


def _dressing(name: str, fields: list[Field], config: str) -> str:
    types = {field.name: field.type for field in fields}
    defaults = ", ".join(f"{f.name!r}: {f.default}" for f in fields if f.default is not None)
    factories = ", ".join(f"{f.name!r}: {f.factory}" for f in fields if f.factory is not None)
    return f"dress({name}, {types!r}, {{{defaults}}}, {{{factories}}}, {config})"


def _statement(node: ast.stmt, known: dict[str, list[Field]]) -> list[str]:
    """Return what replaces a statement of a module; nothing for most."""
    match node:
        case ast.ImportFrom(module="dataclasses", names=names):
            kept = ", ".join(name.name for name in names if name.name != "replace")
            lines = [f"from dataclasses import {kept}"] if kept else []
            wants = any(name.name == "replace" for name in names)
            return [*lines, "from wire.native import replace"] if wants else []
        case ast.Assign(targets=[ast.Name(id=name)], value=ast.Call(func=ast.Name(id="copier"))):
            return _copier(name, ast.unparse(node.value.args[0]), known)  # type: ignore[attr-defined]  # matched
        case ast.Assign(targets=[ast.Name(id=name)], value=value) if CONSTANT.match(name):
            return [f"{name}: Final = {ast.unparse(value)}"] if _is_scalar(value) else []
        case _:
            return []


def _is_scalar(value: ast.expr) -> bool:
    """Tell whether it is a number or a text; a final tuple is at times taken for unset (2.4)."""
    match value:
        case ast.Constant():
            return True
        case ast.UnaryOp(operand=inner):
            return _is_scalar(inner)
        case ast.BinOp(left=left, right=right):
            return _is_scalar(left) and _is_scalar(right)
        case ast.Call(func=ast.Name(id="radians")):
            return True
        case _:
            return False


def _copier(name: str, record: str, known: dict[str, list[Field]]) -> list[str]:
    if record not in known:
        raise Unknown(f"{name} copies {record}, which is no record")
    given = ", ".join(f"record.{field.name}" for field in known[record])
    return [f"def {name}(record: {record}) -> {record}:", f"    return {record}({given})"]
