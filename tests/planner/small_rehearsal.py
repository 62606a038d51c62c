"""Be a process that drives nothing: it tells one step, then waits, dies or ends, as it is asked.

It loads nothing of the planner: what is tried here is the process, and it starts at once.
"""

from __future__ import annotations

import os
import time

from processes.worker_main import ParentPipes, run_worker


def main(parent: ParentPipes) -> int:
    """Read a request, tell half of it, then do as the kind of its first step says."""
    asked = parent.read()
    if asked is None:
        return 0
    rows = asked[0]["rows"]
    steps = [
        {
            "index": index, "kind": row["kind"], "outcome": "running", "length_m": 1.0,
            "end": {"x_m": 1.0, "y_m": 2.0, "yaw_rad": 0.0},
        }
        for index, row in rows
    ]  # fmt: skip
    half = {"steps": steps, "seconds": 9.0, "length_m": 1.0}
    parent.write({"is_over": False, "driven": half})
    kind = rows[0][1]["kind"]
    if kind == "return_home":
        os._exit(3)
    if kind == "wait":
        parent.write({"is_over": True, "driven": half})
        return 0
    time.sleep(60.0)
    return 0


if __name__ == "__main__":
    run_worker(main)
