#!/usr/bin/env bash
# cargo, also where a shell does not find the one that rustup has just installed: cargo.sh ARGUMENT…
set -euo pipefail
. "$(dirname "$0")/rust.sh"
find_rust || true
exec cargo "$@"
