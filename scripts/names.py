"""Find names and first lines that the house does not allow: ``python -m scripts.names [--write]``.

CONTRIBUTING.md has the rules. What stood when the lint came is listed, with how often, in
tests/scripts/known_names.txt; that list may only shrink. ``--write`` takes out of it what is gone,
and never puts anything in.
"""

from __future__ import annotations

import ast
import subprocess
import sys
from collections import Counter, defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
KNOWN = ROOT / "tests" / "scripts" / "known_names.txt"
EVENTS = "events.py"
"""Here a participle names what has happened (`Submitted`), which is its one good use."""


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


_IRREGULAR = _words("""
    become beaten begun bent bitten blown bound born bought broken brought built caught
    chosen come cut dealt done drawn driven dug eaten fallen fed felt flown forgotten fought
    found given gone got grown had heard held hidden hung hurt kept known laid lain led left
    lent let lit lost made meant met paid ridden risen rung said seen sent shaken shot shown
    slept slid sold sought spent split spoken spread stolen stood struck stuck sung sunk
    swept sworn swum taken taught thought thrown told took torn understood woken won worn
    wound written wrung
""")
_VERBS_TOO = _words("come cut hurt let split spread found")
"""Their present has the same form, so that a function may bear them."""
_LOOSE = _words("""
    again all always another any apart aside away beside beyond both down each early else
    enough ever few here hers his how inside it its late least less many more most much
    never none now off once other others out outside over past same so some soon still such
    that their them then there these they this those thus together too under up upon very
    what when where whether which who whoever whom whose why within without yet
""")
_NOUNS_IN_ED = _words("bed embed exceed feed need proceed seed shed speed")
_SUBJECTLESS = frozenset({"who", "what", "whoever", "whatever", "whom", "whose"})


def is_odd(name: str) -> bool:
    """Return whether a name is a bare participle, pronoun or adverb."""
    word = name.strip("_").lower()
    if not word.isalpha() or word in _NOUNS_IN_ED or word in _VERBS_TOO:
        return False
    return word in _IRREGULAR or word in _LOOSE or (word.endswith("ed") and len(word) > 4)


def findings(sources: dict[str, str]) -> dict[str, list[str]]:
    """Return what is not allowed, as ``rule name``, with where each stands.

    Args:
        sources: Python text by path.
    """
    found: dict[str, list[str]] = defaultdict(list)
    classes: dict[str, list[str]] = defaultdict(list)
    for path, text in sources.items():
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.ClassDef):
                classes[node.name].append(f"{path}:{node.lineno}")
                if is_odd(node.name) and Path(path).name != EVENTS:
                    found[f"class {node.name}"].append(f"{path}:{node.lineno}")
            elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                if is_odd(node.name):
                    found[f"def {node.name}"].append(f"{path}:{node.lineno}")
            elif not isinstance(node, ast.Module):
                continue
            first = (ast.get_docstring(node) or "").split(maxsplit=1)
            if first and first[0].lower().strip(",:") in _SUBJECTLESS:
                name = getattr(node, "name", Path(path).stem)
                found[f"docstring {name}"].append(f"{path}:{getattr(node, 'lineno', 1)}")
    for name, places in classes.items():
        if len(places) > 1:
            found[f"twice {name}"] = places
    return dict(found)


def counts(found: dict[str, list[str]]) -> Counter[str]:
    """Return how often each stands; a file that moves changes nothing."""
    return Counter({what: len(places) for what, places in found.items()})


def read_known(text: str) -> Counter[str]:
    """Return the list's counts: one ``rule name count`` a line."""
    lines = (line.rsplit(" ", 1) for line in text.splitlines() if not line.startswith("#"))
    return Counter({what: int(count) for what, count in lines})


def read_tracked(root: Path = ROOT) -> dict[str, str]:
    """Return the Python sources but tests that git tracks; a test is named by what it says."""
    return {p: text for p, text in list_sources(root).items() if not p.startswith("tests/")}


def list_sources(root: Path = ROOT) -> dict[str, str]:
    """Return the text of each Python file that git tracks, by its path."""
    listed = subprocess.run(
        ["git", "ls-files", "-z", "*.py"], cwd=root, capture_output=True, text=True, check=True
    ).stdout
    names = [name for name in listed.split("\0") if name]
    return {name: (root / name).read_text("utf-8") for name in names if (root / name).is_file()}


def main(arguments: list[str]) -> int:
    """Print what is new, and with ``--write`` shrink the list; 1 where something is new."""
    found = findings(read_tracked())
    here, known = counts(found), read_known(KNOWN.read_text("utf-8"))
    for what in sorted(here - known):
        print(f"new: {what}: {', '.join(found[what])}")
    if "--write" in arguments:
        head = [line for line in KNOWN.read_text("utf-8").splitlines() if line.startswith("#")]
        lines = [f"{what} {count}" for what, count in sorted((known & here).items())]
        KNOWN.write_text("\n".join([*head, *lines]) + "\n", "utf-8")
    print(f"{sum(here.values())} names that the house does not allow")
    return int(bool(here - known))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
