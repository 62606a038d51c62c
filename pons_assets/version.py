"""Tell which version of Pons this is, with its commit where that is known: ``pons --version``.

Late to import: it asks git, and ``pons stop`` imports its package.
"""

from __future__ import annotations

import subprocess
import tomllib
from contextlib import suppress

from pons_assets import COMMIT_FILE, IS_INSTALLED, ROOT

PACKAGE = "pons-robot"


def version_line() -> str:
    """Return the line for a person and a bug report."""
    commit = _commit()
    return f"pons {version_number()}" + (f" ({commit})" if commit else "")


def version_number() -> str:
    """Return the release, without asking anybody; the planner tells it to the page."""
    if not IS_INSTALLED:  # a checkout may have been installed at another version
        return str(tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["version"])
    from importlib import metadata

    return metadata.version(PACKAGE)


def _commit() -> str:
    """Return the commit in short; empty where nobody knows it."""
    with suppress(OSError, subprocess.TimeoutExpired):
        if IS_INSTALLED:
            return f"commit {COMMIT_FILE.read_text('ascii').strip()}"
        asked = ["git", "-C", str(ROOT), "rev-parse", "--short=12", "HEAD"]
        told = subprocess.run(asked, capture_output=True, text=True, check=False, timeout=5.0)
        if told.returncode == 0:
            return f"commit {told.stdout.strip()}"
    return ""
