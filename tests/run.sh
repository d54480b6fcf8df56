#!/usr/bin/env bash
# Sets up, builds, and runs every test: the unit tests under AddressSanitizer and UndefinedBehaviorSanitizer, then all
# tests on the optimised build with warnings as errors. Options are handed to the last ctest.
set -euo pipefail
cd "$(dirname "$0")/.."

pipeline/setup.sh
jobs=$(nproc)
export UBSAN_OPTIONS=print_stacktrace=1

echo "== unit tests under the sanitizers"
cmake --preset sanitize >/dev/null
cmake --build --preset sanitize --parallel "$jobs" -- --quiet
ctest --preset sanitize --parallel "$jobs" --progress

echo "== all tests"
cmake --preset dev >/dev/null
cmake --build --preset dev --parallel "$jobs" -- --quiet
ctest --preset dev --parallel "$jobs" "$@"
