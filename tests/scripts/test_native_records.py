"""Hold that a rewritten record is the dataclass it was made of, without compiling anything."""

from __future__ import annotations

import ast
import sys
from dataclasses import fields
from types import ModuleType
from typing import TYPE_CHECKING, Any

import pytest
from pydantic import TypeAdapter

from bridge.compiled import modules
from scripts import native_records as rewriting

if TYPE_CHECKING:
    from collections.abc import Iterator

SOURCE = '''
from __future__ import annotations
from dataclasses import dataclass, field, replace
from typing import Annotated, ClassVar
from pydantic import ConfigDict, Field
from bridge.core.record_copy import copier

MOST = 3.0

@dataclass(frozen=True, slots=True)
class Inner:
    """Be inside."""
    x_m: Annotated[float, Field(le=5.0)]
    y_m: float = MOST
    """Aside."""
    __pydantic_config__: ClassVar[ConfigDict] = ConfigDict(extra="forbid", allow_inf_nan=False)

    @property
    def both_m(self) -> float:
        return self.x_m + self.y_m

@dataclass(slots=True)
class Outer:
    inner: Inner
    seen: tuple[int, ...] = ()
    rows: dict[str, Inner] = field(default_factory=dict)

copied = copier(Outer)

def moved(inner: Inner) -> Inner:
    return replace(inner, x_m=inner.x_m + 1.0)
'''


def run(source: str, name: str) -> ModuleType:
    made = ModuleType(name)
    sys.modules[name] = made
    exec(compile(source, name, "exec"), made.__dict__)
    return made


def known(*sources: str) -> dict[str, Any]:
    return {
        node.name: rewriting.fields_of(node)
        for source in sources
        for node in ast.parse(source).body
        if isinstance(node, ast.ClassDef) and rewriting.is_record(node)
    }


@pytest.fixture
def both() -> Iterator[tuple[ModuleType, ModuleType]]:
    text = rewriting.rewritten(SOURCE, known(SOURCE))
    text = text.replace("@mypyc_attr(allow_interpreted_subclasses=True)\n", "")
    text = text.replace("    __slots__ = ", "    _fields = ")  # beside defaults only C allows it
    yield run(SOURCE, "as_written"), run(text, "as_rewritten")
    del sys.modules["as_written"], sys.modules["as_rewritten"]


def test_it_has_the_same_fields_values_and_words(both: tuple[ModuleType, ModuleType]) -> None:
    written, rewritten = both
    for name in ("Inner", "Outer"):
        old, new = getattr(written, name), getattr(rewritten, name)
        assert [(f.name, f.type) for f in fields(old)] == [(f.name, f.type) for f in fields(new)]
    assert repr(rewritten.Outer(rewritten.Inner(1.0))) == repr(written.Outer(written.Inner(1.0)))
    assert rewritten.Inner(1.0) == rewritten.Inner(1.0, 3.0) != rewritten.Inner(1.0, 2.0)
    assert hash(rewritten.Inner(1.0)) == hash(written.Inner(1.0))
    assert rewritten.Inner(1.0).both_m == 4.0
    assert rewritten.moved(rewritten.Inner(1.0)) == rewritten.Inner(2.0)
    with pytest.raises(TypeError, match="unhashable"):
        hash(rewritten.Outer(rewritten.Inner(1.0)))


def test_a_default_made_anew_is_made_anew(both: tuple[ModuleType, ModuleType]) -> None:
    _, rewritten = both
    one, other = (rewritten.Outer(rewritten.Inner(1.0)) for _ in range(2))
    assert one.rows == {}
    assert one.rows is not other.rows
    copy = rewritten.copied(one)
    assert copy == one
    assert copy is not one


def test_its_bounds_still_hold(both: tuple[ModuleType, ModuleType]) -> None:
    for module in both:
        adapter = TypeAdapter(module.Inner)
        assert adapter.dump_json(module.Inner(2.0)) == b'{"x_m":2.0,"y_m":3.0}'
        for wrong in (b'{"x_m":6.0}', b'{"x_m":1.0,"z":1}', b'{"x_m":NaN}'):
            with pytest.raises(ValueError, match="validation error"):
                adapter.validate_json(wrong)


def test_every_module_of_the_core_can_be_rewritten() -> None:
    sources = {name: path.read_text() for name, path in modules().items()}
    records = known(*sources.values())
    for name, source in sources.items():
        compile(rewriting.rewritten(source, records), name, "exec")
    assert {"BridgeState", "Pose2", "Tick", "Inbox"} <= set(records)


@pytest.mark.parametrize(
    "body",
    ["x: int = field(init=False)", "x: int\n    y: ClassVar[int] = 3", "x: int\n    del x"],
)
def test_a_form_it_does_not_know_is_refused(body: str) -> None:
    source = f"@dataclass\nclass R:\n    {body}\n"
    with pytest.raises(rewriting.Unknown, match="line"):
        rewriting.rewritten(source, {})
