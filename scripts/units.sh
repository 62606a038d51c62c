#!/usr/bin/env bash
# Run unit tests on all processors. A few of them talk to real sockets, disks and processes: what failed
# while the host took the processors away (stolen.py) is run again; a failure in our own time is red.
set -uo pipefail
# The processors are shared out among tests already: threads of numpy that wait for each other there
# made one reading of a sentence twenty times as slow.
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1
memory=$(mktemp -d)
trap 'rm -rf "$memory"' EXIT
set -- -o cache_dir="$memory" -m "not e2e and not home" "$@"
.venv/bin/python -m scripts.stolen .venv/bin/python -m pytest -n 4 --dist worksteal --durations 40 "$@"
code=$?
[ "$code" = 75 ] || exit "$code"
echo "units: some failed in time that was not ours; each of those is run again, alone."
FIRST=$code "$(dirname "$0")/again.sh" "$@"
