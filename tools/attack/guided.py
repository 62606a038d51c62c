"""Feed one decoder inputs that its own branches guide: ``python -m tools.attack.guided DECODER``.

libFuzzer's loop by atheris, which counts branches of the packages that decoders live in. It ends
the process itself: status 0 where nothing was found, 77 at the first crash, whose input is kept.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import atheris

with atheris.instrument_imports(include=["wire", "planner", "bridge"]):
    from tools.attack.decoders import BY_NAME

HANG_S = 5
MEMORY_MB = 1_024


def main() -> None:
    """Fuzz one decoder; does not return."""
    parser = argparse.ArgumentParser(prog="python -m tools.attack.guided", description=__doc__)
    parser.add_argument("decoder", choices=sorted(BY_NAME))
    parser.add_argument("--folder", type=Path, required=True, help="an empty folder of its own")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=1_000_000)
    parser.add_argument("--seconds", type=float, default=10.0)
    given = parser.parse_args()
    decoder = BY_NAME[given.decoder]
    with atheris.instrument_imports(include=["wire", "planner", "bridge"]):
        reader = decoder.prepare(given.folder)
        reader.takes(b"")  # what is imported late is imported here
    corpus, kept = given.folder / "corpus", given.folder.parent / "crashes"
    corpus.mkdir()
    kept.mkdir(exist_ok=True)
    for number, seed in enumerate(decoder.seeds()):
        (corpus / str(number)).write_bytes(seed[: decoder.most_bytes])
    options = [
        sys.argv[0], str(corpus), f"-runs={given.count}", f"-max_total_time={given.seconds:.0f}",
        f"-seed={given.seed}", f"-max_len={decoder.most_bytes}", f"-timeout={HANG_S}",
        f"-rss_limit_mb={MEMORY_MB}", f"-artifact_prefix={kept}/{decoder.name}-guided-",
        "-print_final_stats=1", "-verbosity=0",
    ]  # fmt: skip

    def feed_once(data: bytes) -> None:
        reader.takes(data)

    atheris.Setup(options, feed_once)
    atheris.Fuzz()


if __name__ == "__main__":
    main()
