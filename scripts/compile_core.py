"""Compile the bridge's pure core: ``python scripts/compile_core.py`` (``make core``).

Copies the sources, rewrites their records (native_records.py), lets mypyc make C of them and a C
compiler one library, and puts that under ``.pons/compiled/<fingerprint>/``. A failure is said in
one line and changes nothing: the plain source runs. Exit status: 0 compiled, 1 not.
"""

from __future__ import annotations

import ast
import os
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from bridge.compiled import (  # noqa: E402  # the path comes first
    COMPLETE,
    FLAGS,
    GROUP,
    fingerprint,
    modules,
)
from scripts.native_records import (  # noqa: E402
    Field,
    Unknown,
    fields_of,
    is_record,
    rewritten,
)

CONFIG = """[mypy]
plugins = pydantic.mypy
explicit_package_bases = True
namespace_packages = True
"""
LIMIT_S = 1_800
KEPT = 3
"""Compiled cores of other sources that stay: a person goes back and forth between branches."""


def main() -> int:
    """Compile, unless it is there."""
    lacks = _lacks()
    if lacks:
        print(f"core: not compiled, because {lacks}; the plain source runs", file=sys.stderr)
        return 1
    store = ROOT / ".pons" / "compiled"
    store.mkdir(parents=True, exist_ok=True)
    began_s = time.monotonic()
    with tempfile.TemporaryDirectory(prefix=".build-", dir=store) as name:
        work = Path(name)
        _copy(work)
        made = fingerprint(work)
        if (store / made / COMPLETE).is_file():
            print(f"core: compiled {made} is there")
            return 0
        try:
            _rewrite(work)
            _build(work)
        except (Unknown, subprocess.SubprocessError, SyntaxError) as error:
            print(f"core: not compiled: {error}; the plain source runs", file=sys.stderr)
            return 1
        _publish(work, store / made)
    _tidy(store, made)
    print(f"core: compiled {made} in {time.monotonic() - began_s:.0f} s")
    return 0


def _lacks() -> str | None:
    """Say what this machine lacks to compile."""
    compiler = (sysconfig.get_config_var("CC") or "cc").split()[0]
    if shutil.which(compiler) is None:
        return f"there is no C compiler ({compiler})"
    headers = Path(sysconfig.get_path("include")) / "Python.h"
    if not headers.is_file():
        return f"Python's headers are missing ({headers})"
    try:
        __import__("mypyc.build")
    except ImportError:
        return "mypyc is not installed (`make dev` brings it)"
    return None


def _copy(work: Path) -> None:
    """Take the sources as they are now; whoever edits them meanwhile makes another core."""
    wanted = ["wire", "bridge/core", "bridge/compiled.py", "bridge/__init__.py"]
    wanted += ["scripts/compile_core.py", "scripts/native_records.py"]
    for name in wanted:
        source, target = ROOT / name, work / name
        target.parent.mkdir(parents=True, exist_ok=True)
        if source.is_dir():
            shutil.copytree(source, target, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copyfile(source, target)


def _rewrite(work: Path) -> None:
    sources = {path: path.read_text() for path in modules(work).values()}
    known: dict[str, list[Field]] = {}
    for source in sources.values():
        for node in ast.parse(source).body:
            if isinstance(node, ast.ClassDef) and is_record(node):
                known[node.name] = fields_of(node)
    for path, source in sources.items():
        try:
            path.write_text(rewritten(source, known))
        except Unknown as error:
            raise Unknown(f"{path.relative_to(work)}, {error}") from error


def _build(work: Path) -> None:
    """Run mypyc and the compiler on what was rewritten.

    Raises:
        subprocess.SubprocessError: with the last lines that they said.
    """
    (work / "mypy.ini").write_text(CONFIG)
    paths = [str(path.relative_to(work)) for path in modules(work).values()]
    script = f"""
from mypyc.build import mypycify
from setuptools import setup
made = mypycify(["--config-file", "mypy.ini", *{paths!r}], only_compile_paths={paths!r},
                opt_level="2", debug_level="0", group_name={GROUP!r})
for one in made:
    one.extra_compile_args = [*one.extra_compile_args, *{FLAGS!r}]
setup(name={GROUP!r}, packages=[], py_modules=[], ext_modules=made,
      script_args=["-q", "build_ext", "--inplace"])
"""
    said = subprocess.run(
        [sys.executable, "-c", script],
        cwd=work,
        env={**os.environ, "PYTHONPATH": str(work), "CFLAGS": ""},
        capture_output=True,
        text=True,
        timeout=LIMIT_S,
        check=False,
    )
    if said.returncode != 0:
        lines = [*said.stdout.splitlines(), *said.stderr.splitlines()]
        errors = [line for line in lines if "error" in line] or lines
        raise subprocess.SubprocessError(" | ".join(errors[-3:]))


def _publish(work: Path, target: Path) -> None:
    """Move the binaries to their place, all or nothing."""
    ready = work / "ready"
    for path in sorted(work.rglob("*.so")):
        relative = path.relative_to(work)
        if relative.parts[0] != "build":
            (ready / relative).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, ready / relative)
    (ready / COMPLETE).touch()
    shutil.rmtree(target, ignore_errors=True)
    ready.rename(target)


def _tidy(store: Path, newest: str) -> None:
    others = [path for path in store.iterdir() if path.name != newest and path.name[0] != "."]
    for path in sorted(others, key=lambda one: one.stat().st_mtime)[: -KEPT or None]:
        shutil.rmtree(path, ignore_errors=True)


if __name__ == "__main__":
    sys.exit(main())
