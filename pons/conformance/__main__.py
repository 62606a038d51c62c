"""Start the kit alone: ``python -m pons.conformance``, as ``pons conformance`` does."""

from __future__ import annotations

import sys

from pons.conformance.command import main
from pons.settings import load

if __name__ == "__main__":
    sys.exit(main(load(), sys.argv[1:]))
