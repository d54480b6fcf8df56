#!/usr/bin/env bash
# Fails when two programs, given as arguments, print numbers that differ by more than 1e-12 of their size (or of 1,
# where they are smaller).
set -euo pipefail
paste -d' ' <("$1" | tr ' ' '\n') <("$2" | tr ' ' '\n') | awk '
  NF != 2 { print "line " NR ": " $0; exit 1 }
  { size = $1 < 0 ? -$1 : $1; if (size < 1) size = 1
    apart = $1 - $2; if (apart < 0) apart = -apart
    if (!(apart <= 1e-12 * size)) { print "number " NR ": " $1 " and " $2; failed = 1; exit 1 } }
  END { if (failed || NR < 10000) exit 1; print NR " numbers are the same to 1e-12" }'
