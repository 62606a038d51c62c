"""Run the voice process: ``planner.voice.process_main``.

The first frame carries the site's names, or the files of a model, each later one a recording or the
next piece of one that is still being spoken (``stream``).
Decoding holds the interpreter for its whole length (measured: 0.1 s for each second of speech), and
a library may end its process over a broken file, which is why it is a process.
"""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import asdict
from functools import partial
from typing import Any, Protocol

from planner.voice.recogniser import Recognition
from processes.worker_main import ParentPipes, run_worker
from processes.worker_protocol import Frame

MOST_STREAMS = 8
"""That are remembered; of more, the one that was fed longest ago is forgotten."""
NOTHING = Recognition("", 0.0, understood=False)


class PartListener(Protocol):
    """Hear one recording while it grows."""

    def take(self, pcm: bytes) -> Recognition | None: ...


class VoiceEngine(Protocol):
    """Hear recordings in this process, whole or as they grow."""

    def hear(
        self, pcm: bytes, rate_hz: int, channels: int, *, awaits_answer: bool = False
    ) -> Recognition: ...

    def listener(self, rate_hz: int, channels: int) -> PartListener: ...


def main(parent: ParentPipes) -> int:
    """Load the recogniser, say ready, and answer until the input ends."""
    first = parent.read()
    if first is None:
        return 0
    try:
        engine, left_out = _load(first[0])
    except (ImportError, OSError, RuntimeError, ValueError) as error:
        return parent.refuse("recogniser_unavailable", f"{type(error).__name__}: {error}")
    parent.write({"ready": list(left_out)})
    return parent.serve(partial(_answer, engine, OrderedDict()))


def _load(told: dict[str, Any]) -> tuple[VoiceEngine, tuple[str, ...]]:
    """Return the engine and the names that it can't hear."""
    if "sherpa" in told:
        from planner.voice.sherpa import Sherpa

        return Sherpa(told["sherpa"], int(told["threads"])), ()
    from planner.voice.sphinx import Sphinx

    sphinx = Sphinx(*([str(each) for each in told[key]] for key in ("names", "sentences")))
    return sphinx, sphinx.language.left_out


def _answer(engine: VoiceEngine, streams: OrderedDict[int, PartListener], asked: Frame) -> Frame:
    head, pcm = asked
    try:
        rate_hz, channels = int(head["rate_hz"]), int(head["channels"])
        if "stream" in head:
            number = int(head["stream"])
            listener = streams.pop(number, None) or engine.listener(rate_hz, channels)
            streams[number] = listener
            if len(streams) > MOST_STREAMS:
                streams.popitem(last=False)
            return asdict(listener.take(pcm) or NOTHING), b""
        heard = engine.hear(pcm, rate_hz, channels, awaits_answer=head["awaits_answer"] is True)
        return asdict(heard), b""
    except (RuntimeError, ValueError, LookupError) as error:
        return {"failed": f"{type(error).__name__}: {error}"}, b""


if __name__ == "__main__":
    run_worker(main)
