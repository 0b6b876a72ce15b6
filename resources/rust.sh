# Finds a Rust that is new enough. Read by setup.sh and cargo.sh.

# The same as rust-version in Cargo.toml.
least=1.92

# Where rustup puts cargo, which a shell that was there before does not look at.
rustup_bin=${CARGO_HOME:-${HOME:-}/.cargo}/bin

# Puts a cargo that is new enough in front of all others. Leaves in $found the version that there is, nothing where there is none.
find_rust() {
  new_enough && return 0
  local before=$PATH found_before=$found
  [ -x "$rustup_bin/cargo" ] || return 1
  export PATH="$rustup_bin:$PATH"
  new_enough && return 0
  [ -n "$found" ] && return 1
  export PATH="$before"
  found=$found_before
  return 1
}

new_enough() {
  # rustup's cargo without a toolchain says no version.
  found=$(cargo --version 2>/dev/null | sed -n 's/^cargo \([0-9]*\.[0-9]*\).*/\1/p') || found=
  [ -n "$found" ] && [ "$(printf '%s\n%s\n' "$least" "$found" | sort -V | head -n 1)" = "$least" ]
}
