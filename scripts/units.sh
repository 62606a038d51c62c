#!/usr/bin/env bash
# Run unit tests: those of the folders and files named, or all of them, in rows of folders at once. More rows
# than processors, for a third of their time is waiting. Each row collects its own tests alone: four workers
# of xdist each collected all 20 000, which cost more of the processors than any folder's tests.
# A few of them talk to real sockets, disks and processes: what failed while the host took the processors
# away (stolen.py) is run again, when the other rows have ended; a failure in our own time is red.
set -uo pipefail
# The processors are shared out among tests already: threads of numpy that wait for each other there
# made one reading of a sentence twenty times as slow.
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1
NOTHING_THERE=5 # pytest found no test: of a row that is nothing to tell, a choice (-k) may leave it none

run() {
  local memory code
  memory=$(mktemp -d)
  trap 'rm -rf "$memory"' EXIT
  set -- -o cache_dir="$memory" -m "not e2e and not home" "$@"
  if [ -n "${AT_ONCE_LOCK:-}" ]; then
    exec 9>>"$AT_ONCE_LOCK"
    flock -s 9
  fi
  .venv/bin/python -m scripts.stolen .venv/bin/python -m pytest "$@" 9>&-
  code=$?
  [ "$code" != "$NOTHING_THERE" ] || exit 0
  [ "$code" = 75 ] || exit "$code"
  echo "units: some failed in time that was not ours; each of those is run again, alone."
  if [ -n "${AT_ONCE_LOCK:-}" ]; then
    flock -u 9
    flock -x 9
  fi
  FIRST=$code "$(dirname "$0")/again.sh" "$@" 9>&-
  exit
}

if [ "${1:-}" = --row ]; then
  shift
  run "$@"
fi
for word; do
  [ ! -e "${word%%::*}" ] || run -n 4 --dist worksteal "$@"
done
# Each about as long as the others, by the seconds of the processor that its tests take.
MISSIONS=(tests/planner/mission tests/planner/orders)
WORLDS=(tests/tools/lockstep)
COMMANDS=(tests/pons tests/localization)
exec .venv/bin/python scripts/at_once.py \
  "$0" --row "${MISSIONS[@]}" "$@" \
  ++ "$0" --row tests/planner "${MISSIONS[@]/#/--ignore=}" "$@" \
  ++ "$0" --row "${WORLDS[@]}" "$@" \
  ++ "$0" --row "${COMMANDS[@]}" "$@" \
  ++ "$0" --row tests --ignore=tests/planner "${WORLDS[@]/#/--ignore=}" "${COMMANDS[@]/#/--ignore=}" "$@"
