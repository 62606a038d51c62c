#!/usr/bin/env bash
# Drive the simulated home on an emulated 64-bit ARM processor: Debian's Python and the locked wheels
# for aarch64, under qemu-user. Shows that they load and reckon alike; says nothing of time.
#
# Usage: deploy/pi/emulate.sh FOLDER      needs: apt install qemu-user-static; dpkg --add-architecture
#                                         arm64; apt update; a checkout with `make setup` done
set -euo pipefail

[ $# -eq 1 ] || { sed -n '2,6s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2 && exit 2; }
readonly SOURCE=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
readonly VERSION=${VERSION:-3.11}
mkdir -p "$1/debs" "$1/arm"
readonly FOLDER=$(cd "$1" && pwd)

packages=(libc6 libgcc-s1 libstdc++6 zlib1g libssl3 libexpat1 libffi8 libbz2-1.0 liblzma5 libsqlite3-0
  libuuid1 libcrypt1 "python$VERSION" "python$VERSION-minimal" "libpython$VERSION-minimal"
  "libpython$VERSION-stdlib")
(cd "$FOLDER/debs" && apt-get download -qq "${packages[@]/%/:arm64}")
for deb in "$FOLDER"/debs/*.deb; do dpkg-deb -x "$deb" "$FOLDER/arm"; done

python3 -m venv "$FOLDER/pip"
"$FOLDER/pip/bin/pip" install -q --no-deps --require-hashes --only-binary=:all: --implementation cp \
  --python-version "$VERSION" --platform manylinux_2_17_aarch64 --platform manylinux2014_aarch64 \
  --platform manylinux_2_28_aarch64 --target "$FOLDER/site" --upgrade -r "$SOURCE/requirements.lock"

cd "$SOURCE"
export QEMU_LD_PREFIX=$FOLDER/arm PYTHONHOME=$FOLDER/arm/usr PYTHONDONTWRITEBYTECODE=1
export PYTHONPATH=$SOURCE:$FOLDER/site
libraries=$FOLDER/arm/lib/aarch64-linux-gnu:$FOLDER/arm/usr/lib/aarch64-linux-gnu
qemu-aarch64-static -E LD_LIBRARY_PATH="$libraries" "$FOLDER/arm/usr/bin/python$VERSION" - <<'PYTHON'
import platform

from tools.lockstep import LockstepWorld

world = LockstepWorld(site="home", seed=1)
world.say("go to the kitchen")
has_reached = lambda one: one.status.leg is not None and one.status.leg.reached
world.run_until(has_reached, 60.0)
print(f"{platform.machine()}: the kitchen reached, {world.contacts} contacts, at {world.truth}")
PYTHON
