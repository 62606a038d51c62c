"""Print the test files that a change can reach: ``python -m scripts.changed [SINCE]``, a line each.

Owns which files changed since a revision (HEAD: what is not committed) and who imports them. A file
that is no module (a site, a prompt, robot.toml) may be read by any test: then `tests` is printed.
"""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
ALL = "tests"
UNREAD = ".md"
"""The end of files that no module reads: the gate judges them in steps of its own."""


def main(words: list[str]) -> int:
    """Print the tests that what changed since a revision reaches."""
    changed = changed_files(words[0] if words else "HEAD")
    files = list_files("git", "ls-files", "--cached", "--others", "--exclude-standard", "*.py")
    sources = {name: (ROOT / name).read_text("utf-8") for name in files if (ROOT / name).is_file()}
    print("\n".join(sorted(reached_tests(changed, sources))))
    return 0


def changed_files(since: str) -> set[str]:
    """Return what changed since a revision, and what is new and not ignored."""
    new = list_files("git", "ls-files", "--others", "--exclude-standard")
    return {*list_files("git", "diff", "--name-only", since), *new}


def list_files(*command: str) -> list[str]:
    """Return the lines that a command of git prints."""
    return subprocess.check_output(command, cwd=ROOT, text=True).splitlines()


def reached_tests(changed: Iterable[str], sources: dict[str, str]) -> set[str]:
    """Return the test files that import what changed, however many modules lie between.

    Args:
        changed: paths below the root.
        sources: the text of every module, by its path below the root.
    """
    read = {name for name in changed if not name.endswith(UNREAD)}
    if any(not name.endswith(".py") for name in read):
        return {ALL}
    importers: dict[str, set[str]] = {}
    for name, text in sources.items():
        for imported in imports(text):
            importers.setdefault(imported, set()).add(name)
    reached, open_ends = set[str](), list(read)
    while open_ends:
        name = open_ends.pop()
        if name not in reached:
            reached.add(name)
            open_ends += importers.get(module_of(name), ())
            if name.startswith("tests/") and name.endswith("/conftest.py"):
                folder = name.removesuffix("conftest.py")
                open_ends += [each for each in sources if each.startswith(folder)]
    return {name for name in reached & set(sources) if is_test(name)}


def imports(text: str) -> Iterator[str]:
    """Yield all that a module may import, anywhere in it: a name from a package may be a module."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield from above(alias.name)
        elif isinstance(node, ast.ImportFrom) and node.module is not None:
            yield from above(node.module)
            for alias in node.names:
                yield f"{node.module}.{alias.name}"


def above(module: str) -> Iterator[str]:
    """Yield a module and the packages that it lies in: importing it runs their doors."""
    while module:
        yield module
        module = module.rpartition(".")[0]


def module_of(name: str) -> str:
    """Return the dotted name of a file below the root."""
    return name.removesuffix(".py").removesuffix("/__init__").replace("/", ".")


def is_test(name: str) -> bool:
    """Tell whether pytest collects a file."""
    return name.startswith("tests/") and Path(name).name.startswith("test_")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
