#!/usr/bin/env bash
# Run unit tests on all processors. A few of them talk to real sockets, disks and processes, and fewer than one
# in a thousand runs out of its seconds where four workers share two processors. Up to three that failed are
# run again, alone and aloud (again.sh); failing again is red. Red at once: more than three, and any of the
# bridge's core, which asks no clock and no processor. What failed while the host took the processors away
# (stolen.py) is run again however much it is.
set -uo pipefail
# The processors are shared out among tests already: threads of numpy that wait for each other there
# made one reading of a sentence twenty times as slow.
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1
memory=$(mktemp -d)
trap 'rm -rf "$memory"' EXIT
# Files that hold stories alone need not be read, by each worker.
mapfile -t ignored < <(grep -rlE --include='test_*.py' '^pytestmark = .*mark\.(e2e|home)\b' tests | sed 's/^/--ignore=/')
set -- -o cache_dir="$memory" -m "not e2e and not home" "${ignored[@]}" "$@"
.venv/bin/python -m scripts.stolen .venv/bin/python -m pytest -n 4 --dist worksteal --durations 40 "$@"
code=$?
[ "$code" != 5 ] || exit 0 # a chosen room may hold none
[ "$code" = 1 ] || [ "$code" = 75 ] || exit "$code"
failed=$(grep -o '"tests/[^"]*' "$memory/v/cache/lastfailed" 2>/dev/null)
if [ "$code" = 1 ]; then
  [ "$(grep -c . <<<"$failed")" -le 3 ] && ! grep -q '^"tests/bridge/core/' <<<"$failed" || exit 1
fi
echo "units: each of these is run again, alone:"
echo "${failed//\"/  }"
FIRST=$code "$(dirname "$0")/again.sh" "$@"
