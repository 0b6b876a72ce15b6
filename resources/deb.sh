#!/usr/bin/env bash
# Makes a Debian package of the program that was built: deb.sh OUT_FOLDER. Called by `make deb`, which installs into OUT_FOLDER/root first.
set -euo pipefail
cd "$(dirname "$0")/.."
out=$(realpath "$1")
root=$out/root

for tool in dpkg-deb dpkg-shlibdeps strip; do
  command -v "$tool" >/dev/null 2>&1 || { echo "A Debian package is made with $tool, which is not here: apt-get install dpkg-dev binutils" >&2; exit 1; }
done

version=$(sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml | head -n 1)
architecture=$(dpkg --print-architecture)
when=$(date -u -R -d "@${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || date +%s)}")
maintainer="The Sinew authors <sinew@localhost>"
doc=$root/usr/share/doc/sinew

strip --strip-unneeded "$root"/usr/bin/*
gzip -9nf "$root/usr/share/man/man1/sinew.1"
# The window is called sinew too, by those who start it.
ln -sf sinew.1.gz "$root/usr/share/man/man1/sinew-window.1.gz"
# Where Debian's zsh looks for the completions of packages.
mkdir -p "$root/usr/share/zsh/vendor-completions"
mv "$root/usr/share/zsh/site-functions/_sinew" "$root/usr/share/zsh/vendor-completions/"
rmdir "$root/usr/share/zsh/site-functions"

mkdir -p "$doc/examples"
cp configs/* "$doc/examples/"
cat >"$doc/copyright" <<END
Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: Sinew

Files: *
Copyright: 2026 The Sinew authors
License: MIT or Apache-2.0

License: MIT
$(sed -n '/^Copyright/,$p' LICENSE-MIT | sed 's/^$/./; s/^/ /')

License: Apache-2.0
 On Debian systems the full text is in /usr/share/common-licenses/Apache-2.0.
END
printf 'sinew (%s) unstable; urgency=medium\n\n  * See CHANGELOG.md of the project.\n\n -- %s  %s\n' "$version" "$maintainer" "$when" |
  gzip -9n >"$doc/changelog.gz"

# The libraries that the program is linked with, as packages. The tool wants a source package around it, so it gets the outline of one.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/debian"
printf 'Source: sinew\n\nPackage: sinew\nArchitecture: any\n' >"$work/debian/control"
depends=$(cd "$work" && dpkg-shlibdeps -O "$root"/usr/bin/* 2>/dev/null | sed -n 's/^shlibs:Depends=//p')
[ -n "$depends" ] || { echo "dpkg-shlibdeps found no libraries" >&2; exit 1; }
# The symbols used are older than the version that the interface files ask for when they are loaded.
depends=$(printf '%s' "$depends" | sed 's/libgtk-4-1 ([^)]*)/libgtk-4-1 (>= 4.8)/')

mkdir -p "$root/DEBIAN"
cat >"$root/DEBIAN/control" <<END
Package: sinew
Version: $version
Architecture: $architecture
Maintainer: $maintainer
Installed-Size: $(du -sk --exclude=DEBIAN "$root" | cut -f1)
Depends: $depends
Recommends: adwaita-icon-theme, fonts-dejavu-core, librsvg2-common
Suggests: ffmpeg
Section: graphics
Priority: optional
Description: player of skeletal animation clips and muscles of constant volume
 Sinew opens COLLADA animation clips and muscles that are described in YAML,
 puts both into one scene and draws it without a graphics card. Everything that
 the window shows can be had from the command line too: pictures, films, posed
 surfaces, measurements.
END
(cd "$root" && find . -path ./DEBIAN -prune -o -type f -printf '%P\0' | sort -z | xargs -0 md5sum) >"$root/DEBIAN/md5sums"
find "$root" -type d -exec chmod 755 {} +

package=$out/sinew_${version}_$architecture.deb
dpkg-deb --root-owner-group -Zxz --build "$root" "$package" >/dev/null
echo "$package"
