#!/usr/bin/env bash
# Run stories with real processes in real time, three files at once on two cores: a robot takes half a
# core and mostly waits. Those marked long are begun first (tests/conftest.py). Tell each failed one again,
# alone and aloud (again.sh): a shared machine may stall a real-time story for minutes. What runs beside
# others (at_once.py) waits for them first: else it is not alone.
# Stories of which no telling counted, the first included, are red, but where NOT_JUDGED names a file for them.
set -uo pipefail
if [ -n "${AT_ONCE_LOCK:-}" ]; then
  exec 9>>"$AT_ONCE_LOCK"
  flock -s 9
fi

# What failed is kept apart: unit tests and other stories may run beside these.
memory=$(mktemp -d)
trap 'rm -rf "$memory"' EXIT
set -- -o cache_dir="$memory" "$@"
cores=$(nproc)
.venv/bin/python -m scripts.stolen .venv/bin/python -m pytest \
  -n $((cores < 3 ? cores + 1 : 3)) --dist loadfile --no-loadscope-reorder --durations 40 "$@" 9>&-
first=$?
# 1 and 75: stories failed; all else (Ctrl-C, bad usage, a contact that was seen) is not tried again.
[ "$first" = 1 ] || [ "$first" = 75 ] || exit "$first"
echo "stories: some failed; each of those is told once more, alone. Failing again is red, but in stolen time."
if [ -n "${AT_ONCE_LOCK:-}" ]; then
  flock -u 9
  flock -x 9
fi
FIRST=$first "$(dirname "$0")/again.sh" "$@" 9>&-
code=$?
[ "$first $code" = "75 75" ] && [ -n "${NOT_JUDGED:-}" ] || exit "$code"
echo "stories: no telling of these counted, for the host took the processors away; they are not judged:"
grep -o '"[^"]*"' "$memory/v/cache/lastfailed" | tee -a "$NOT_JUDGED"
