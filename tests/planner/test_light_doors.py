"""Hold each process to what it needs: arrays live in the planner's children, words in it."""

from __future__ import annotations

import subprocess
import sys

CODE = """
import sys
import planner.navigation, planner.perception, planner.voice, planner.site
heavy = ("numpy", "cv2", "onnxruntime", "pocketsphinx", "sherpa_onnx")
print([name for name in heavy if name in sys.modules])
"""


def test_the_planners_own_process_loads_no_array_library() -> None:
    done = subprocess.run(
        [sys.executable, "-c", CODE], check=True, capture_output=True, text=True, timeout=30
    )
    assert done.stdout.strip() == "[]"


READS_WORDS = """
import sys
import planner.navigation.process_main
print([name for name in sys.modules if name.startswith("planner.language.grammar")])
"""


def test_the_route_process_does_not_load_what_reads_sentences() -> None:
    """It knows places by their ids; the grammar costs half of a second of a processor."""
    done = subprocess.run(
        [sys.executable, "-c", READS_WORDS], check=True, capture_output=True, text=True, timeout=30
    )
    assert done.stdout.strip() == "[]"
