#!/usr/bin/env bash
# Run again, alone and in calm, what failed in the last pytest run with these arguments; FIRST is how that one
# ended. What fails again is red, but where the host took the processors away meanwhile (stolen.py): then again,
# three times at most and none begun after AGAIN_UNTIL (seconds since 1970). Ends with 75 where no run counted.
set -uo pipefail
code=${FIRST:-1}
for _ in 1 2 3; do
  [ "$(date +%s)" -lt "${AGAIN_UNTIL:-9999999999}" ] || break
  .venv/bin/python -m scripts.calm || true # what it saw is said; it is run again either way
  .venv/bin/python -m scripts.stolen .venv/bin/python -m pytest "$@" --last-failed \
    --last-failed-no-failures none
  code=$?
  [ "$code" = 75 ] || break
done
exit "$code"
