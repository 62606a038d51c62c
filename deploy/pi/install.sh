#!/usr/bin/env bash
# Make this computer a robot's: packages, users, real-time rights, serial ports, services. One
# command on Raspberry Pi OS, Debian or Ubuntu, 64 bits; run again after an update. docs/raspberry-pi.md
#
# Usage: sudo deploy/pi/install.sh [--robot FILE] [--site FOLDER] [--no-start]
#        deploy/pi/install.sh --stage FOLDER …   only put the files below FOLDER, and start nothing
#
# A robot.toml and a site that are there already are kept unless --robot or --site names another.
set -euo pipefail

readonly SOURCE=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
readonly PACKAGES=(python3 python3-venv make ca-certificates)
readonly NEEDED_MB=1500
stage='' robot='' site='' start=yes

refuse() { # CODE ENGLISH CHINESE
  printf 'refused: %s: %s\n  %s\n' "$1" "$2" "$3" >&2
  exit 3
}

say() { printf 'pons: %s\n' "$*"; }

while [ $# -gt 0 ]; do
  case $1 in
    --robot | --site | --stage)
      [ $# -ge 2 ] || refuse value_missing "$1 needs a value" "$1 需要一个值"
      declare "${1#--}=$2"
      shift 2
      ;;
    --no-start) start=no && shift ;;
    -h | --help) sed -n '2,8s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" && exit 0 ;;
    *) refuse option_unknown "$1; known are --robot, --site, --no-start, --stage" "未知选项 $1" ;;
  esac
done

check_machine() {
  case $(uname -m) in
    aarch64 | x86_64) ;;
    *) refuse machine_unsupported "$(uname -m); its packages are built for aarch64 and x86_64: install the \
64-bit system" "不支持 $(uname -m)，请安装 64 位系统" ;;
  esac
  # A 64-bit kernel under a 32-bit system, as old images of Raspberry Pi OS have it.
  [ "$(getconf LONG_BIT)" = 64 ] ||
    refuse system_32_bit "the kernel has 64 bits, the system 32: install the 64-bit image" "请安装 64 位系统镜像"
  [ -n "$stage" ] && return
  [ "$(id -u)" = 0 ] || refuse not_root "run it with sudo" "请用 sudo 运行"
  command -v apt-get >/dev/null ||
    refuse system_unknown "no apt-get here; docs/deploy.md has the steps for other systems" "没有 apt-get，步骤见 docs/deploy.md"
  [ -d /run/systemd/system ] ||
    refuse no_systemd "systemd does not run; docs/deploy.md has the ways without it" "systemd 未运行，见 docs/deploy.md"
}

check_inputs() {
  if [ -n "$robot" ] && [ ! -f "$robot" ]; then
    refuse robot_missing "$robot is no file; presets are: $(cd "$SOURCE/robots" && echo *.toml)" "找不到 $robot"
  fi
  if [ -n "$site" ] && [ ! -f "$site/map.yaml" ]; then
    refuse site_missing "$site has no map.yaml; sites are: $(cd "$SOURCE/sites" && echo */ | tr -d /)" "$site 中没有 map.yaml"
  fi
  local free_mb
  mkdir -p "$stage/opt"
  free_mb=$(df -Pm "$stage/opt" | awk 'NR == 2 { print $4 }')
  [ "$free_mb" -ge "$NEEDED_MB" ] ||
    refuse disk_full "$stage/opt has $free_mb MB, needs $NEEDED_MB" "$stage/opt 剩余 $free_mb MB，需要 $NEEDED_MB"
}

install_packages() {
  local missing=() one
  for one in "${PACKAGES[@]}"; do
    dpkg-query -W -f='${Status}' "$one" 2>/dev/null | grep -q 'ok installed' || missing+=("$one")
  done
  [ ${#missing[@]} -eq 0 ] && return
  say "installing ${missing[*]}"
  apt-get update -qq
  DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

# What is tracked, and the page where it is built: no recordings, keys or caches of a developer.
copy_program() {
  local to=$stage/opt/pons
  [ "$SOURCE" = "$to" ] && return
  say "copying to $to"
  mkdir -p "$to"
  if [ -e "$SOURCE/.git" ]; then
    (cd "$SOURCE" && git -c safe.directory="$SOURCE" ls-files -z | xargs -0 tar -cf -) | tar -xf - -C "$to"
  else
    tar -C "$SOURCE" --exclude=.venv --exclude=.pons -cf - . | tar -xf - -C "$to"
  fi
}

copy_settings() {
  mkdir -p "$stage/etc/pons/sites"
  if [ -n "$robot" ] || [ ! -f "$stage/etc/pons/robot.toml" ]; then
    keep_old "$stage/etc/pons/robot.toml"
    install -m 0644 "${robot:-$SOURCE/robot.toml}" "$stage/etc/pons/robot.toml"
  fi
  if [ -n "$site" ]; then
    local name
    name=$(basename "$(cd "$site" && pwd)")
    mkdir -p "$stage/etc/pons/sites/$name"
    cp -r "$site/." "$stage/etc/pons/sites/$name/"
  elif [ ! -d "$stage/etc/pons/sites/home" ]; then
    cp -r "$SOURCE/sites/home" "$stage/etc/pons/sites/"
  fi
}

keep_old() { [ ! -f "$1" ] || cp -p "$1" "$1.before-$(date -u +%Y%m%dT%H%M%SZ)"; }

# The site that counts now: --site, else the one that the units of the last run name, else the demo home.
site_name() {
  if [ -n "$site" ]; then
    basename "$(cd "$site" && pwd)"
    return
  fi
  sed -n 's|.*/etc/pons/sites/\([^/[:space:]]*\).*|\1|p' "$stage"/etc/systemd/system/pons-bridge.service 2>/dev/null |
    head -n 1 | grep . || echo home
}

# Units name the site that is the robot's own.
copy_units() {
  local units=$stage/etc/systemd/system name
  mkdir -p "$units" "$stage/etc/sysusers.d" "$stage/etc/tmpfiles.d" "$stage/etc/udev/rules.d"
  name=$(site_name) # read before the units are written over
  for one in "$SOURCE"/deploy/systemd/*.service "$SOURCE"/deploy/systemd/*.target; do
    sed "s|/etc/pons/sites/home|/etc/pons/sites/$name|" "$one" >"$units/$(basename "$one")"
  done
  install -m 0644 "$SOURCE/deploy/systemd/pons.sysusers.conf" "$stage/etc/sysusers.d/pons.conf"
  install -m 0644 "$SOURCE/deploy/systemd/pons.tmpfiles.conf" "$stage/etc/tmpfiles.d/pons.conf"
  install -m 0644 "$SOURCE/deploy/pi/70-pons.rules" "$stage/etc/udev/rules.d/70-pons.rules"
}

# For people who run `pons up` in a shell; services have these rights by their units.
allow_real_time() {
  mkdir -p "$stage/etc/security/limits.d"
  cat >"$stage/etc/security/limits.d/pons.conf" <<'LIMITS'
@pons - rtprio 70
@pons - memlock unlimited
LIMITS
}

activate() {
  systemd-sysusers
  systemd-tmpfiles --create /etc/tmpfiles.d/pons.conf
  udevadm control --reload && udevadm trigger --subsystem-match=tty --subsystem-match=usb || true
  systemctl daemon-reload
  local person=${SUDO_USER:-}
  if [ -n "$person" ] && [ "$person" != root ]; then
    usermod -a -G pons,dialout,video,i2c "$person"
    say "$person is in the groups pons, dialout, video and i2c from the next login on"
  fi
}

kind_of() { # PART: its kind in the robot.toml that counts now; sim where nothing is said
  "$stage/opt/pons/.venv/bin/python" - "$1" "$stage/etc/pons/robot.toml" <<'PYTHON'
import sys, tomllib
from pathlib import Path

print(tomllib.loads(Path(sys.argv[2]).read_text("utf-8")).get(sys.argv[1], {}).get("kind", "sim"))
PYTHON
}

make_key() {
  [ -f /var/lib/pons/operator.key ] && return
  runuser -u pons-bridge -- env PONS_HOME=/var/lib/pons /opt/pons/.venv/bin/pons key new
}

start_services() {
  if [ "$(kind_of drive)" = sim ]; then
    [ "$start" = no ] || systemctl enable --now pons-sim.target
    say "robot.toml drives a simulated robot: http://127.0.0.1:8420"
    return
  fi
  make_key
  systemctl enable pons.target pons-localization
  case "$(kind_of lidar)" in sim | ros2) ;; *) systemctl enable pons-lidar ;; esac
  case "$(kind_of imu)" in mpu6050 | bno085) systemctl enable pons-imu ;; esac
  case "$(kind_of camera)" in uvc | stream | realsense | ros2) systemctl enable pons-uvc ;; esac
  [ "$(kind_of drive)" != ros2 ] || systemctl enable pons-ros2
  say "services start with the computer; on metal a person arms: docs/raspberry-pi.md"
  [ "$start" = no ] || systemctl start pons.target
}

check_machine
check_inputs
[ -n "$stage" ] || install_packages
copy_program
copy_settings
copy_units
allow_real_time
if [ -n "$stage" ]; then
  say "staged below $stage"
  exit 0
fi
make -C /opt/pons setup
activate
if ! (cd /opt/pons && PONS_HOME=/var/lib/pons PONS_ROBOT=/etc/pons/robot.toml .venv/bin/python -c \
  'from pathlib import Path; from wire import load_robot; load_robot(Path("/etc/pons/robot.toml"))'); then
  refuse robot_malformed "/etc/pons/robot.toml is not taken; mend it and run this again" "/etc/pons/robot.toml 有误，请修正后重试"
fi
start_services
PONS_HOME=/var/lib/pons PONS_ROBOT=/etc/pons/robot.toml /opt/pons/.venv/bin/pons doctor || true
say "no network in the field? nmcli device wifi hotspot ssid pons password '…' makes an access point"
