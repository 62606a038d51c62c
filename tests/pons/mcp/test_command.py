"""``pons mcp`` says how it is started."""

from __future__ import annotations

import subprocess
import sys


def test_the_help_has_a_sentence_and_examples() -> None:
    words = [sys.executable, "-m", "pons", "mcp", "--help"]
    told = subprocess.run(words, capture_output=True, text=True, check=True, timeout=60).stdout
    assert "Serve this robot over MCP" in told
    assert "\nexamples:\n  pons mcp" in told
