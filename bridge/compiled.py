"""Find the compiled core made of exactly the sources on disk, and let Python import it.

The sources stay the one truth: a compiled core lies in ``.pons/compiled/<fingerprint>/``, never
beside them, and its fingerprint covers every source, the interpreter and the compiler's flags. Any
other one is not looked at. Only the bridge process uses it; whatever replays, tests or proves runs
the plain source, so every recording replayed compares the two. Imports the standard library alone,
because it must run before anything that could be compiled is imported.
"""

from __future__ import annotations

import os
import platform
import sys
from dataclasses import dataclass
from hashlib import sha256
from importlib.machinery import EXTENSION_SUFFIXES, ExtensionFileLoader, ModuleSpec
from importlib.util import spec_from_file_location
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence
    from types import ModuleType

ROOT = Path(__file__).resolve().parents[1]
GROUP = "bridge_core"
"""One shared library holds all compiled modules, so that calls between them are plain C calls."""
FLAGS = ("-O2", "-g0", "-ffp-contract=off")
"""A fused multiply-add rounds once where Python rounds twice: the two cores would differ."""
INTERPRETED = frozenset({"__init__", "codec", "docs", "fault_words", "hazards", "row_words"})
"""Words, and what no tick runs."""
COMPLETE = "complete"
"""Written last: without it a folder is no compiled core."""


@dataclass(frozen=True, slots=True)
class Core:
    """Say which core runs."""

    folder: Path | None
    """None: the plain source."""
    text: str
    """One line for the log and for ``pons doctor``."""

    @property
    def compiled(self) -> bool:
        """Tell whether it is a compiled one."""
        return self.folder is not None


def plain(why: str) -> Core:
    """Return the plain source, with the reason."""
    return Core(None, f"plain Python, because {why}")


def modules(root: Path = ROOT) -> dict[str, Path]:
    """Return the sources that are compiled, by module name."""
    found = {
        f"bridge.core.{path.stem}": path
        for path in sorted((root / "bridge" / "core").glob("*.py"))
        if path.stem not in INTERPRETED
    }
    return {"wire.geometry": root / "wire" / "geometry.py", **found}


def fingerprint(root: Path = ROOT) -> str:
    """Return 16 hex digits of all that a compiled core is made of.

    The types of everything in ``wire`` are compiled into it, so all of that counts.
    """
    digest = sha256(repr((sys.version, platform.machine(), FLAGS)).encode())
    sources = [*(root / "wire").glob("*.py"), *(root / "bridge" / "core").glob("*.py")]
    makers = [root / "scripts" / name for name in ("compile_core.py", "native_records.py")]
    for path in (*sorted(sources), root / "bridge" / "compiled.py", *makers):
        data = path.read_bytes()
        digest.update(f"\n{path.relative_to(root)} {len(data)}\n".encode() + data)
    return digest.hexdigest()[:16]


def find(root: Path = ROOT) -> Core:
    """Return the compiled core of these sources, or why the plain source must do."""
    if os.environ.get("PONS_CORE") == "plain":
        return plain("PONS_CORE says so")
    try:
        print_of_sources = fingerprint(root)
    except OSError as error:
        return plain(f"the sources cannot be read: {error}")
    folder = root / ".pons" / "compiled" / print_of_sources
    if not (folder / COMPLETE).is_file():
        return plain("none is compiled of these sources (`make core` compiles one)")
    return Core(folder, f"compiled {print_of_sources}")


def use(core: Core | None = None) -> Core:
    """Make the compiled core be what is imported, if there is one; say which core runs.

    A compiled core that cannot be loaded is left again, and the plain source runs.
    """
    core = find() if core is None else core
    if core.folder is None:
        return core
    early = [name for name in sys.modules if name == "wire.geometry" or _of_core(name)]
    if early:
        return plain(f"{early[0]} was imported before it could be chosen")
    before = set(sys.modules)
    finder = _Finder(core.folder)
    sys.meta_path.insert(0, finder)
    try:
        __import__("bridge.core")
    except (ImportError, AttributeError, TypeError, ValueError) as error:
        sys.meta_path.remove(finder)
        for name in set(sys.modules) - before:
            if _of_core(name) or name.partition(".")[0] in {"wire", f"{GROUP}__mypyc"}:
                del sys.modules[name]
        return plain(f"{core.folder} cannot be loaded: {type(error).__name__}: {error}")
    return core


def _of_core(name: str) -> bool:
    return name == "bridge.core" or name.startswith("bridge.core.")


class _Finder:
    """Find the compiled modules of one folder, by name."""

    def __init__(self, folder: Path) -> None:
        suffix = EXTENSION_SUFFIXES[0]
        self._paths = {
            str(path.relative_to(folder))[: -len(suffix)].replace("/", "."): path
            for path in folder.rglob(f"*{suffix}")
        }

    def find_spec(
        self, name: str, _path: Sequence[str] | None = None, _target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Return where a module is, if it is one of these."""
        path = self._paths.get(name)
        if path is None:
            return None
        return spec_from_file_location(name, path, loader=ExtensionFileLoader(name, str(path)))
