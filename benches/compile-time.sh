#!/usr/bin/env bash
# What a chain adds to `cargo check` of the crate that declares it: seconds on the clock, least of several runs, with
# the chain less without, for the mobile lidar and for a chain of 12 joints and 120 errors.
#
# Usage: benches/compile-time.sh [RUNS]
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
runs=${1:-5}
crate=$root/target/compile-time
mkdir -p "$crate/src"

cat >"$crate/Cargo.toml" <<TOML
[package]
name = "compile-time"
edition = "2024"
[dependencies]
trueaxis = { path = "$root", default-features = false, features = ["std"] }
[workspace]
TOML

# Twelve joints about z, y, z, …, each body with ten errors.
long_chain() {
    echo "trueaxis::chain! { chain Long {"
    lower=ground
    for i in $(seq 12); do
        if ((i % 2)); then turn=Rz; else turn=Ry; fi
        echo "body b$i on $lower {"
        echo "  position_error: Tx(px$i), Ty(py$i), Tz(pz$i), Rx(ax$i), Ry(ay$i);"
        echo "  motion: $turn(q$i);"
        echo "  motion_error: Tx(mx$i), Ty(my$i), Rx(bx$i), Ry(by$i), Rz(bz$i);"
        echo "}"
        lower=b$i
    done
    echo "observe tool: direction(0, 0, 1) of b12; observe tip: point(0, 0, 0.1) of b12; } }"
}

# The least time for what is in lib.rs, in seconds.
check() {
    for _ in $(seq "$runs"); do
        touch "$crate/src/lib.rs"
        (cd "$crate" && TIMEFORMAT=%R && time cargo check --quiet --offline) 2>&1
    done | sort -n | head -1
}

: >"$crate/src/lib.rs"
cp "$root/Cargo.lock" "$crate/Cargo.lock"
(cd "$crate" && cargo check --quiet --offline) # the dependencies, once
empty=$(check)
{ echo "trueaxis::chain! {" && cat "$root/examples/mobile-lidar/mobile-lidar.chain" && echo "}"; } >"$crate/src/lib.rs"
lidar=$(check)
long_chain >"$crate/src/lib.rs"
long=$(check)
awk -v e="$empty" -v a="$lidar" -v b="$long" 'BEGIN {
    printf "empty crate                 %.2f s\n", e
    printf "mobile lidar, added         %.2f s\n", a - e
    printf "12 joints, 120 errors, added %.2f s\n", b - e
}'
