#!/usr/bin/env bash
# Ask for known vulnerabilities of what the locks name. Knows pip-audit and npm; installs nothing.
# Exit status: 0 none is known, 1 some are, 3 something could not be asked, and it says what.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

worst=0
judge() { # $1: what was asked, $2: the exit status, $3: the words of a true finding, $4: the output
  echo "$4"
  if [ "$2" = 0 ]; then
    echo "audit: $1: none known"
  elif grep -qE "$3" <<<"$4"; then
    echo "audit: $1: VULNERABLE (above: which)"
    worst=1
  else
    echo "audit: $1: NOT AUDITED (above: why); nothing is known of it either way" >&2
    if [ "$worst" = 0 ]; then worst=3; fi
  fi
}

said=$(timeout 300 .venv/bin/uv tool run --quiet pip-audit --requirement requirements.lock \
  --require-hashes --disable-pip --strict --progress-spinner off 2>&1)
judge "Python packages" $? '^Found [0-9]+ known vulnerabilit' "$said"

said=$(cd web && timeout 120 npm audit --omit=dev 2>&1)
judge "the page's packages" $? '^[0-9]+ .*vulnerabilit' "$said"
exit "$worst"
