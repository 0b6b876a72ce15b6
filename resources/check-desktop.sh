#!/usr/bin/env bash
# Checks the files that `make install` puts on a desktop: each with the tool made for it, where that tool is here.
set -euo pipefail
cd "$(dirname "$0")"

check() { # name of the tool, then the call
  if command -v "$1" >/dev/null 2>&1; then
    "$@"
  else
    echo "left out, $1 is not here: $*"
  fi
}

check desktop-file-validate io.github.sinew.Sinew.desktop
check appstreamcli validate --no-net io.github.sinew.Sinew.metainfo.xml
check xmllint --noout io.github.sinew.Sinew-mime.xml icons/*.svg
check mandoc -T lint -W warning sinew.1

# The icons must draw at the smallest size that a desktop asks for.
for icon in icons/*.svg; do
  check rsvg-convert -w 16 -h 16 "$icon" >/dev/null
done

# Two files must be known by their contents and their names.
if command -v update-mime-database >/dev/null 2>&1; then
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' EXIT
  mkdir -p "$folder/mime/packages"
  cp io.github.sinew.Sinew-mime.xml "$folder/mime/packages/"
  XDG_DATA_HOME="$folder" update-mime-database "$folder/mime"
  grep -q ':model/vnd.collada+xml:\*.dae' "$folder/mime/globs2"
  grep -q 'COLLADA model/vnd.collada+xml' "$folder/mime/XMLnamespaces"
fi
echo "desktop files are in order"
