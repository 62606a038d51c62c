"""Ask before money is spent or words leave this machine; who says nothing has not agreed."""

from __future__ import annotations

import sys


def agreed(bill: str, *, yes: bool) -> bool:
    """Show what it will cost on standard error; return whether that was agreed to."""
    print(bill, file=sys.stderr)
    if yes:
        return True
    if not sys.stdin.isatty():
        print("not_agreed: give --yes / 请加 --yes", file=sys.stderr)
        return False
    return input("Go on? 继续吗？ [y/N] ").strip().lower() in ("y", "yes", "是")
