#!/usr/bin/env bash
# Drive the simulated home and look with the detector, here and on an emulated 64-bit ARM processor:
# Debian's Python and the locked wheels for aarch64, under qemu-user. Shows that they load and reckon
# alike; says nothing of time.
#
# Usage: deploy/pi/emulate.sh FOLDER      needs: apt install qemu-user-static; dpkg --add-architecture
#                                         arm64; apt update; a checkout with `make setup` done
set -euo pipefail

[ $# -eq 1 ] || { sed -n '2,7s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2 && exit 2; }
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

# onnxruntime asks for the kind of core, and crashes where it reads of the one that emulates: a Cortex-A72.
mkdir -p "$FOLDER/arm/proc"
for ((core = 0; core < $(nproc --all); core++)); do
  printf '%s\n' "processor : $core" 'Features : fp asimd evtstrm crc32 cpuid' 'CPU implementer : 0x41' \
    'CPU architecture: 8' 'CPU variant : 0x0' 'CPU part : 0xd08' 'CPU revision : 3' ''
done >"$FOLDER/arm/proc/cpuinfo"

cat >"$FOLDER/drive.py" <<'PYTHON'
import platform

from tools.lockstep.drawn_finder import DrawnFinder
from tools.lockstep import LockstepWorld
from tools.lockstep.truth_detector import header_of

world = LockstepWorld(site="home", seed=1)
camera = world.scene.robot.camera
eyes, seen = DrawnFinder(world.sim, camera), []
world.say("go to the kitchen")
while world.status.leg is None or not world.status.leg.reached:
    world.run(3.0)
    seen += eyes.find(world.sim, header_of(camera, 1, world.now_s))
print(f"{platform.machine()}: the kitchen reached, {world.contacts} contacts, at {world.truth}")
boxes = ((one, ", ".join(f"{edge:.2f}" for edge in one.box)) for one in seen)
print("seen", *(f"{one.label} {one.score:.4f} at {box}" for one, box in boxes), sep="\n  ")
PYTHON

cd "$SOURCE"
export PYTHONDONTWRITEBYTECODE=1
PYTHONPATH=$SOURCE .venv/bin/python "$FOLDER/drive.py"
export QEMU_LD_PREFIX=$FOLDER/arm PYTHONHOME=$FOLDER/arm/usr PYTHONPATH=$SOURCE:$FOLDER/site
libraries=$FOLDER/arm/lib/aarch64-linux-gnu:$FOLDER/arm/usr/lib/aarch64-linux-gnu
qemu-aarch64-static -E LD_LIBRARY_PATH="$libraries" "$FOLDER/arm/usr/bin/python$VERSION" \
  "$FOLDER/drive.py"
