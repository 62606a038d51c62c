#!/usr/bin/env bash
# Run stories with real processes in real time, three files at once on two cores: a robot takes half a
# core and mostly waits. Tell each failed one once more, alone and aloud. A shared machine may stall a
# real-time story for seconds; a story that fails twice is red.
set -uo pipefail

# What failed is kept apart: unit tests and other stories may run beside these.
memory=$(mktemp -d)
trap 'rm -rf "$memory"' EXIT
set -- -o cache_dir="$memory" "$@"
cores=$(nproc)
.venv/bin/python -m pytest -n $((cores < 3 ? cores + 1 : 3)) --dist loadfile "$@"
code=$?
[ "$code" = 1 ] || exit "$code" # 1: tests failed; all else (Ctrl-C, bad usage) is not tried again
echo "stories: some failed; each of those is told once more, alone. Failing again is red."
.venv/bin/python -m pytest "$@" --last-failed --last-failed-no-failures none
