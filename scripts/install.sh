#!/usr/bin/env bash
# Install one lock file into .venv, every file checked against its hash. Makes no environment.
# Usage: install.sh LOCK          only what the lock names
#        install.sh LOCK --self   and then this checkout itself, editable
set -euo pipefail

lock=$1
pip=(.venv/bin/python -m pip --disable-pip-version-check --no-input)
echo "pons: installing $lock"
# Bytecode is written on first import instead: that saves a third of this step. Nothing is resolved here,
# for a lock names all that is needed: pip 23 asks for the newest release of a package that another one
# wants with an extra (coverage[toml]), and then refuses it, since its hash isn't in the lock.
"${pip[@]}" install --quiet --no-compile --no-deps --require-hashes -r "$lock"
"${pip[@]}" check >/dev/null || "${pip[@]}" check
[ "${2:-}" = --self ] || exit 0
# The lock brought the build backend, so nothing is fetched here. "compat" puts this folder itself
# on the path, where type checkers find the packages too.
"${pip[@]}" install --quiet --no-deps --no-build-isolation \
  --config-settings editable_mode=compat --editable .
