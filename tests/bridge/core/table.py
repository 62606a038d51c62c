"""Try all rows of a table in one test: pytest's own parametrize costs a millisecond a row.

The quick suite has some 1 700 rows, most of which take a few microseconds.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

Test = Callable[..., None]


def table(names: str | tuple[str, ...], rows: Iterable[Any]) -> Callable[[Test], Test]:
    """Return a decorator that calls a test with each row, and names the row that fails."""
    several = (names,) if isinstance(names, str) else names
    listed = [(row,) if isinstance(names, str) else row for row in rows]

    def decorated(test: Test) -> Test:
        def each(**others: Any) -> None:
            for row in listed:
                given = dict(zip(several, row, strict=True))
                try:
                    test(**given, **others)
                except BaseException as error:
                    error.add_note(f"in the row {given}")
                    raise

        each.__name__, each.__doc__ = test.__name__, test.__doc__
        each.__module__, each.__qualname__ = test.__module__, test.__qualname__
        return each

    return decorated
