"""Make a throw-away environment for the peers, apart from ours: never in our locks.

It is kept below ``$PONS_HOME/bench`` for the next run and may be deleted at any time.
"""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

WANTED = ("pydantic-ai-slim[openai]", "langchain", "langchain-openai")
PATIENCE_S = 900.0


class NoPeers(Exception):
    """The peers can't be installed here; the message says why."""


def peers_python(folder: Path) -> Path:
    """Return the Python that has the peers; makes the environment at the first call.

    Raises:
        NoPeers: it could not be made.
    """
    python, mark = folder / "bin" / "python", folder / "wanted.txt"
    wanted = "\n".join([sys.version.split()[0], *WANTED])
    if mark.is_file() and mark.read_text("utf-8") == wanted and python.exists():
        return python
    shutil.rmtree(folder, ignore_errors=True)
    try:
        _run(sys.executable, "-m", "venv", str(folder))
        _run(str(python), "-m", "pip", "install", "-q", "--disable-pip-version-check", *WANTED)
    except (OSError, subprocess.SubprocessError) as error:
        shutil.rmtree(folder, ignore_errors=True)
        raise NoPeers(str(error).splitlines()[0][:200]) from None
    mark.write_text(wanted, "utf-8")
    return python


def _run(*words: str) -> None:
    done = subprocess.run(words, capture_output=True, text=True, timeout=PATIENCE_S, check=False)
    if done.returncode:
        last = (done.stderr.strip().splitlines() or ["no word"])[-1]
        raise subprocess.SubprocessError(f"{words[2]}: {last}")
