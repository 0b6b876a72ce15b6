#!/usr/bin/env bash
# Runs drivers of the window in the next Debian: test-newer.sh [name of a test], by default the ten thousand random events.
# Makes a root of it by debootstrap, once; the mirror is that of this system, else debootstrap's own. Needs the rights of root.
set -euo pipefail

suite=trixie
root=${SINEW_NEWER_ROOT:-/var/cache/sinew/$suite}
packages=(
  libgtk-4-1 librsvg2-common adwaita-icon-theme fonts-dejavu-core
  xvfb xdotool imagemagick dbus at-spi2-core python3-gi gir1.2-atspi-2.0 gir1.2-gtk-4.0 openbox
)

if [ "$(id -u)" -ne 0 ]; then
  echo "A root of another system can only be made and entered as root: sudo make test-newer" >&2
  exit 1
fi

if [ ! -e "$root/sinew-is-complete" ]; then
  if ! command -v debootstrap >/dev/null; then
    echo "debootstrap is missing: apt-get install debootstrap" >&2
    exit 1
  fi
  mirror=$(apt-get indextargets --format '$(REPO_URI)' 2>/dev/null | grep -m 1 '/debian/\?$' || true)
  echo "== A root of Debian $suite in $root"
  mkdir -p "$root"
  debootstrap --variant=minbase "$suite" "$root" ${mirror:+"$mirror"}
  chroot "$root" apt-get update
  DEBIAN_FRONTEND=noninteractive LC_ALL=C chroot "$root" apt-get install --yes --no-install-recommends "${packages[@]}"
  touch "$root/sinew-is-complete"
fi

# The program is built by this system; in the other one it lies where it does here. All that is mounted goes with this process.
cargo=$(dirname "$0")/cargo.sh
"$cargo" build --locked
target=$(readlink -f "${CARGO_TARGET_DIR:-target}")
exec unshare --mount -- bash -euo pipefail -c '
  root=$1 target=$2 cargo=$3; shift 3
  mount -t proc proc "$root/proc"
  mount --rbind /dev "$root/dev"
  for shared in /tmp "$PWD" "$target"; do
    mkdir -p "$root$shared"
    mount --bind "$shared" "$root$shared"
  done
  echo "== The drivers of the window, with GTK $(chroot "$root" dpkg-query --show --showformat "\${Version}" libgtk-4-1)"
  SINEW_TEST_ROOT=$root exec "$cargo" test --locked --test window -- --include-ignored --nocapture --test-threads 1 "$@"
' newer "$root" "$target" "$cargo" "${1:-ten_thousand}"
