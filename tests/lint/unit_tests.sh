#!/usr/bin/env bash
# Runs every test known to ctest and counts the cases inside, not the programs; cases that skip themselves are counted as skipped.
#   unit_tests.sh build/release
set -uo pipefail
build=$(cd "$1" && pwd)
results=$build/results
rm -rf "$results"
mkdir -p "$results"

GTEST_OUTPUT="json:$results/" ctest --test-dir "$build" --output-on-failure -j "$(nproc)"
status=$?

# The last lines of each report of GoogleTest hold no totals, the first ones do: "tests", "failures", "errors".
total=0
failed=0
skipped=0
for report in "$results"/*.json; do
  [ -f "$report" ] || continue
  read -r tests failures <<<"$(awk -F'[:,]' '/^  "tests"/ { t = $2 } /^  "failures"/ { f = $2 } /^  "errors"/ { print t + 0, f + $2 }' "$report")"
  total=$((total + tests)) failed=$((failed + failures))
  skipped=$((skipped + $(grep -c '"result": "SKIPPED"' "$report")))
done
if [ $status != 0 ] && [ $failed = 0 ]; then failed=1; fi
[ $total -gt 0 ] || failed=1
not_passed=$((failed + skipped))
echo "$((total > not_passed ? total - not_passed : 0)) passed, $failed failed, $skipped skipped"
[ $failed = 0 ]
