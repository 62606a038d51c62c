#!/usr/bin/env bash
# Install one lock file into .venv, every file checked against its hash. Makes no environment.
# Usage: install.sh LOCK          only what the lock names
#        install.sh LOCK --self   and then this checkout itself, editable
set -euo pipefail

lock=$1
pip=(.venv/bin/python -m pip --disable-pip-version-check --no-input)
echo "pons: installing $lock"
# Bytecode is written on first import instead: that saves a third of this step.
"${pip[@]}" install --quiet --no-compile --require-hashes -r "$lock"
[ "${2:-}" = --self ] || exit 0
# The lock brought the build backend, so nothing is fetched here. "compat" puts this folder itself
# on the path, where type checkers find the packages too.
"${pip[@]}" install --quiet --no-deps --no-build-isolation \
  --config-settings editable_mode=compat --editable .
