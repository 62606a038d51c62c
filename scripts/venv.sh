#!/usr/bin/env bash
# Make .venv with the first fitting Python. Knows Python and venv; installs nothing.
# Usage: venv.sh [DIR]      make DIR (default .venv) unless it works already
#        venv.sh --find     print the Python that would be used
set -euo pipefail

# Accept only what can really make an environment: Debian splits ensurepip off into python3-venv.
fits() {
  "$1" -c 'import sys, venv, ensurepip; sys.exit(not (3, 11) <= sys.version_info[:2] <= (3, 13))' \
    >/dev/null 2>&1
}

find_python() {
  local candidate
  for candidate in ${PYTHON:-python3 python3.13 python3.12 python3.11 /usr/bin/python3}; do
    if fits "$candidate"; then
      command -v "$candidate"
      return
    fi
  done
  explain >&2
  return 1
}

explain() {
  local found
  found=$("${PYTHON:-python3}" --version 2>&1 || true)
  cat <<EOF
pons: no usable Python. Needed: Python 3.11, 3.12 or 3.13 with its venv module.
Found as ${PYTHON:-python3}: ${found:-nothing}.
On Debian or Ubuntu:   sudo apt install python3 python3-venv
On Fedora:             sudo dnf install python3
Another Python:        make setup PYTHON=/path/to/python3.12
EOF
}

if [ "${1:-}" = --find ]; then
  find_python
  exit
fi

venv=${1:-.venv}
if "$venv/bin/python" -c 'import sys, pip; sys.exit(not (3, 11) <= sys.version_info[:2] <= (3, 13))' \
  >/dev/null 2>&1; then
  exit 0
fi
python=$(find_python)
echo "pons: making $venv with $python ($("$python" --version))"
"$python" -m venv --clear "$venv"
