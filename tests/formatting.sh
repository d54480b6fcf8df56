#!/usr/bin/env bash
# Checks that all C++ is formatted as .clang-format says. Usage: formatting.sh SOURCE_DIR
set -euo pipefail
cd "$1"
find src pipeline tests -name '*.h' -o -name '*.cpp' | sort | xargs clang-format --dry-run --Werror
