#!/usr/bin/env bash
# Installs the system packages that are missing: setup.sh build | test
# `build` is what the window is compiled with and runs on; `test` adds what drives and checks it without a screen.
set -euo pipefail

build=(
  build-essential      # a C linker for Rust
  pkg-config           # finds GTK
  libgtk-4-dev         # the window
  librsvg2-common      # symbolic icons in GTK
  adwaita-icon-theme   # the icons of buttons
  fonts-dejavu-core    # a font, should there be none
)
test=(
  xvfb                 # a screen without a screen
  xauth
  xdotool              # mouse and keys
  imagemagick          # pictures of the screen
  dbus                 # session bus of the window test
  at-spi2-core         # reads and sets what the window shows
  python3-gi
  gir1.2-atspi-2.0
  desktop-file-utils   # checks of what `make install` puts down
  appstream
  libxml2-utils
  shared-mime-info
  librsvg2-bin
  mandoc
)

case "${1:-}" in
  build) wanted=("${build[@]}") ;;
  test) wanted=("${build[@]}" "${test[@]}") ;;
  *) echo "usage: setup.sh build|test" >&2; exit 2 ;;
esac

# Rust first: without it the packages are of no use, and Debian 12's own is too old.
least=1.92
if ! command -v cargo >/dev/null 2>&1; then
  echo "Sinew needs Rust $least or newer, and there is none here: get it from https://rustup.rs (Debian 12's own package is too old)." >&2
  exit 1
fi
found=$(cargo --version | sed 's/^cargo \([0-9]*\.[0-9]*\).*/\1/')
if [ "$(printf '%s\n%s\n' "$least" "$found" | sort -V | head -n 1)" != "$least" ]; then
  echo "Sinew needs Rust $least or newer, and this is $found: run \`rustup update\`, or get it from https://rustup.rs (Debian 12's own package is too old)." >&2
  exit 1
fi

if ! command -v apt-get >/dev/null 2>&1; then
  if pkg-config --exists 'gtk4 >= 4.8' 2>/dev/null; then
    [ "$1" = build ] && exit 0
    echo "apt-get is not here, so nothing is installed; tests that need a missing program say so and are left out." >&2
    exit 0
  fi
  echo "Sinew's window needs the development files of GTK 4.8 or newer, and this system has no apt-get to install them with:" >&2
  echo "install your system's package (gtk4-devel on Fedora, gtk4 on Arch), or build the command line alone with \`cargo build --release --no-default-features\`." >&2
  exit 1
fi

missing=()
for package in "${wanted[@]}"; do
  dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null 2>&1; then
    echo "These packages are missing and only root can install them: apt-get install ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "Sinew needs these system packages (to $1 it) and installs them now: ${missing[*]}"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! { "${as_root[@]}" apt-get update -qq &&
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"; } </dev/null >"$log" 2>&1; then
  cat "$log" >&2
  echo "apt-get could not install them: see above." >&2
  exit 1
fi
