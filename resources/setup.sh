#!/usr/bin/env bash
# Installs what is missing, Rust and system packages: setup.sh build | test | newer
# `build` is what the window is compiled with and runs on; `test` adds what drives and checks it without a screen,
# `newer` what makes a root of another Debian, to do that there.
# It says what it installs before it does; at a terminal it asks about Rust first. SINEW_NO_INSTALL=1 lets it install nothing.
set -euo pipefail
. "$(dirname "$0")/rust.sh"

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
newer=(
  debootstrap             # a root of another Debian
  debian-archive-keyring  # and what its packages are signed with
)

case "${1:-}" in
  build) wanted=("${build[@]}") ;;
  test) wanted=("${build[@]}" "${test[@]}") ;;
  newer) wanted=("${build[@]}" "${test[@]}" "${newer[@]}") ;;
  *) echo "usage: setup.sh build|test|newer" >&2; exit 2 ;;
esac

log=
trap '[ -z "$log" ] || rm -f "$log"' EXIT

has() { command -v "$1" >/dev/null 2>&1; }
fail() { echo "$1" >&2; exit 1; }
refused() { [ -n "${SINEW_NO_INSTALL:-}" ] && [ "$SINEW_NO_INSTALL" != 0 ]; }

# How to become root, and whether that can be done.
as_root=() may_root=yes
if [ "$(id -u)" -ne 0 ]; then
  if has sudo; then as_root=(sudo); else may_root=; fi
fi

# Runs a command and shows what it said only where it fails.
quietly() {
  [ -n "$log" ] || log=$(mktemp)
  "$@" </dev/null >"$log" 2>&1 || { cat "$log" >&2; return 1; }
}

apt_install() {
  quietly "${as_root[@]}" apt-get update -qq &&
    quietly "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$@"
}

# Whether the system has a package of this name that can be installed here.
offers() {
  [ -n "$may_root" ] && has apt-get && has apt-cache && LC_ALL=C apt-cache policy "$1" 2>/dev/null | grep -q 'Candidate: [^(]'
}

# Says what would be installed and asks at a terminal; elsewhere saying is all.
may_install_rust() {
  local have="there is none here"
  [ -z "$found" ] || have="this is $found"
  echo "Sinew needs Rust $least or newer, and $have." >&2
  if refused; then
    fail "SINEW_NO_INSTALL is set, so nothing is installed: run \`rustup update\`, or get Rust from https://rustup.rs (Debian 12's own package is too old)."
  fi
  if [ -t 0 ] && [ -t 2 ]; then
    local answer=
    read -r -p "$1 now? [Y/n] " answer || answer=n
    case "$answer" in
      '' | [Yy]* | д* | Д*) ;;
      *) fail "Nothing was installed. Get Rust from https://rustup.rs (Debian 12's own package is too old), then call make again." ;;
    esac
  else
    echo "$1 now; SINEW_NO_INSTALL=1 would leave it." >&2
  fi
}

# The toolchain by the rustup that is there. Another default of the user's stays as it is: then only this folder uses the new one.
use_rustup() {
  rustup toolchain install stable --profile minimal --component rustfmt --component clippy >&2 ||
    fail "rustup could not install Rust: see above."
  find_rust && return
  if [ -z "$found" ]; then
    rustup default stable >&2
  else
    (cd "$(dirname "$0")/.." && rustup override set stable) >&2
  fi
}

# rustup by the installer of its makers, for this user alone.
run_installer() {
  if ! has curl && ! has wget; then
    offers curl || fail "Rust is installed with curl or wget, and there is neither: install one of them, or get Rust from https://rustup.rs."
    echo "Its installer is fetched with curl, which is installed first." >&2
    apt_install curl ca-certificates || fail "apt-get could not install curl: see above."
  fi
  local script
  script=$(mktemp)
  if has curl; then
    curl --proto '=https' --tlsv1.2 -sSf -o "$script" https://sh.rustup.rs || { rm -f "$script"; fail "The installer could not be fetched from https://sh.rustup.rs."; }
  else
    wget -q -O "$script" https://sh.rustup.rs || { rm -f "$script"; fail "The installer could not be fetched from https://sh.rustup.rs."; }
  fi
  # An old Rust of the system's is no hindrance, and the user's shell stays as it is: make finds cargo where rustup puts it.
  RUSTUP_INIT_SKIP_PATH_CHECK=yes sh "$script" -y --no-modify-path --profile minimal --component rustfmt --component clippy >&2 ||
    { rm -f "$script"; fail "rustup's installer failed: see above."; }
  rm -f "$script"
}

# Rust first: without it the packages are of no use.
if ! find_rust; then
  if ! has rustup && [ -x "$rustup_bin/rustup" ]; then
    export PATH="$rustup_bin:$PATH"
  fi
  if has rustup; then
    may_install_rust "rustup installs the stable Rust"
    use_rustup
  elif offers rustup; then
    may_install_rust "apt-get installs the package rustup, and that the stable Rust"
    # It may want to take the place of packages that others need; those are the user's.
    if apt_install --no-remove rustup; then
      use_rustup
    else
      echo "apt-get could not install rustup: see above. The installer of rustup's makers (https://sh.rustup.rs) is taken instead." >&2
      run_installer
    fi
  else
    may_install_rust "rustup's installer (https://sh.rustup.rs) installs the stable Rust into $(dirname "$rustup_bin") and ~/.rustup"
    run_installer
  fi
  find_rust || fail "Rust was installed, but cargo is still ${found:-nowhere to be found}: see https://rustup.rs."
fi

if ! has apt-get; then
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
if refused; then
  fail "SINEW_NO_INSTALL is set, so these packages stay missing that Sinew needs to $1 it: ${missing[*]}"
fi
[ -n "$may_root" ] || fail "These packages are missing and only root can install them: apt-get install ${missing[*]}"
echo "Sinew needs these system packages (to $1 it) and installs them now: ${missing[*]}"
apt_install "${missing[@]}" || fail "apt-get could not install them: see above."
