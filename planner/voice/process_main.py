"""Run the voice process: ``planner.voice.process_main``.

The first frame carries the site's names, each later one a recording. Decoding holds the interpreter
for its whole length (measured: 0.1 s for each second of speech), which is why it is a process.
"""

from __future__ import annotations

from dataclasses import asdict
from functools import partial
from typing import TYPE_CHECKING

from processes.worker_main import ParentPipes, run_worker
from processes.worker_protocol import Frame

if TYPE_CHECKING:
    from planner.voice.sphinx import Sphinx


def main(parent: ParentPipes) -> int:
    """Load the recogniser, say ready, and answer until the input ends."""
    first = parent.read()
    if first is None:
        return 0
    try:
        from planner.voice.sphinx import Sphinx

        sphinx = Sphinx([str(name) for name in first[0]["names"]])
    except (ImportError, OSError, RuntimeError, ValueError) as error:
        return parent.refuse("recogniser_unavailable", f"{type(error).__name__}: {error}")
    parent.write({"ready": list(sphinx.language.left_out)})
    return parent.serve(partial(_answer, sphinx))


def _answer(sphinx: Sphinx, asked: Frame) -> Frame:
    head, pcm = asked
    try:
        rate_hz, channels = int(head["rate_hz"]), int(head["channels"])
        heard = sphinx.hear(pcm, rate_hz, channels, awaits_answer=head["awaits_answer"] is True)
        return asdict(heard), b""
    except (RuntimeError, ValueError, KeyError) as error:
        return {"failed": f"{type(error).__name__}: {error}"}, b""


if __name__ == "__main__":
    run_worker(main)
