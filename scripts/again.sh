#!/usr/bin/env bash
# Run again, alone and in calm, what failed in the last pytest run with these arguments. What fails again is
# red, but where the host took the processors away meanwhile (stolen.py): then again, three times at most.
set -uo pipefail
for _ in 1 2 3; do
  .venv/bin/python -m scripts.calm || true # what it saw is said; it is run again either way
  .venv/bin/python -m scripts.stolen .venv/bin/python -m pytest "$@" --last-failed \
    --last-failed-no-failures none
  code=$?
  [ "$code" = 75 ] || break
done
exit "$code"
