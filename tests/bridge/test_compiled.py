"""Hold that only a core of exactly these sources is used, and that it decides the very same."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from bridge.compiled import COMPLETE, INTERPRETED, ROOT, Core, find, fingerprint, modules, use

TICKS = ROOT / "tests" / "bridge" / "compiled_ticks.py"


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    """Copy what a compiled core is made of."""
    for folder in ("wire", "bridge/core", "scripts"):
        ignored = shutil.ignore_patterns("__pycache__", "*.sh")
        shutil.copytree(ROOT / folder, tmp_path / folder, ignore=ignored)
    shutil.copyfile(ROOT / "bridge" / "compiled.py", tmp_path / "bridge" / "compiled.py")
    return tmp_path


@pytest.fixture(autouse=True)
def no_wish(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("PONS_CORE", raising=False)


def built(checkout: Path) -> Path:
    folder = checkout / ".pons" / "compiled" / fingerprint(checkout)
    folder.mkdir(parents=True)
    (folder / COMPLETE).touch()
    return folder


def test_without_one_the_plain_source_runs_and_says_why(checkout: Path) -> None:
    core = find(checkout)
    assert not core.compiled
    assert "make core" in core.text
    assert core.text.startswith("plain Python, because")


def test_one_of_these_very_sources_is_found(checkout: Path) -> None:
    folder = built(checkout)
    assert find(checkout) == Core(folder, f"compiled {folder.name}")


@pytest.mark.parametrize(
    "changed",
    ["bridge/core/motion/limiter.py", "bridge/core/codec.py", "wire/robot.py", "wire/keys.py"],
)
def test_one_of_other_sources_is_never_used(checkout: Path, changed: str) -> None:
    built(checkout)
    with (checkout / changed).open("a") as file:
        file.write("\n")
    assert not find(checkout).compiled


def test_a_new_source_makes_it_another_core(checkout: Path) -> None:
    built(checkout)
    (checkout / "bridge" / "core" / "more.py").write_text('"""Be new."""\n')
    assert not find(checkout).compiled


def test_half_of_one_is_none(checkout: Path) -> None:
    (built(checkout) / COMPLETE).unlink()
    assert not find(checkout).compiled


def test_whoever_wants_the_plain_source_gets_it(
    checkout: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    built(checkout)
    monkeypatch.setenv("PONS_CORE", "plain")
    assert not find(checkout).compiled


def test_it_is_never_chosen_after_the_source_was_imported(checkout: Path) -> None:
    import bridge.core  # noqa: F401  # whatever the order of the tests

    core = use(Core(built(checkout), "compiled x"))
    assert not core.compiled
    assert "imported before" in core.text


def test_one_that_cannot_be_loaded_is_left_again(checkout: Path) -> None:
    """Damage one module: the process must run on the plain source, whole."""
    from importlib.machinery import EXTENSION_SUFFIXES

    folder = built(checkout)
    (folder / "bridge" / "core").mkdir(parents=True)
    (folder / "bridge" / "core" / f"limiter{EXTENSION_SUFFIXES[0]}").write_bytes(b"no binary")
    said = python(
        "from pathlib import Path\n"
        "from bridge.compiled import Core, use\n"
        f"print(use(Core(Path({str(folder)!r}), 'compiled x')).text)\n"
        "import bridge.core.motion.limiter, wire\n"
        "print(bridge.core.motion.limiter.__file__)\n"
    )
    assert said[0].startswith("plain Python, because")
    assert "cannot be loaded" in said[0]
    assert said[1].endswith("limiter.py")


def test_every_module_of_the_core_is_compiled_or_known_to_stay() -> None:
    names = {path.stem for path in (ROOT / "bridge" / "core").glob("*.py")}
    assert {name.rpartition(".")[2] for name in modules()} == names - INTERPRETED | {"geometry"}
    assert names >= INTERPRETED


@pytest.mark.slow
@pytest.mark.timeout(300)
def test_compiled_and_plain_decide_the_same() -> None:
    """Step the same ordinary and hostile ticks on both and compare each decision, bit for bit."""
    core = find()
    if not core.compiled:
        pytest.skip(f"no compiled core to compare: {core.text}")
    plain, compiled = python(str(TICKS), PONS_CORE="plain"), python(str(TICKS))
    assert plain[0].startswith("plain Python")
    assert compiled[0] == core.text
    assert len(plain) == len(compiled) > 5_000
    differing = [(a, b) for a, b in zip(plain[1:], compiled[1:], strict=True) if a != b]
    assert differing[:3] == []


def python(code: str, **environment: str) -> list[str]:
    """Run a file or a line in a fresh interpreter and return the lines it printed."""
    words = [code] if code.endswith(".py") else ["-c", code]
    done = subprocess.run(
        [sys.executable, *words],
        cwd=ROOT,
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        timeout=140,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()
