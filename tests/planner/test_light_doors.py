"""Hold the planner's own process to what it needs: arrays live in its children alone."""

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
