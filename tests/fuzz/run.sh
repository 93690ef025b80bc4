#!/usr/bin/env bash
# Runs one fuzz target for some time, from its seeds and from what earlier runs found:  run.sh build/fuzz/tests/fuzz/x_fuzz 60
# What makes it fail is left in build/fuzz/findings; make a unit test of it.
set -euo pipefail
target=$1
seconds=$2
here=$(dirname "${BASH_SOURCE[0]}")
name=$(basename "$target")
corpus=build/fuzz/corpus/$name
findings=build/fuzz/findings
mkdir -p "$corpus" "$findings"
seeds=()
for folder in "$here/seeds/${name%_fuzz}" "$here/corpus/${name%_fuzz}"; do
  [ ! -d "$folder" ] || seeds+=("$folder")
done
dictionary=()
[ ! -f "$here/${name%_fuzz}.dict" ] || dictionary=("-dict=$here/${name%_fuzz}.dict")

status=0
"$target" "-max_total_time=$seconds" -timeout=10 -rss_limit_mb=2048 -max_len=16384 -print_final_stats=1 \
  "-artifact_prefix=$findings/$name-" "${dictionary[@]}" "$corpus" "${seeds[@]}" >"$findings/$name.log" 2>&1 || status=$?
if [ $status = 0 ]; then
  grep -E 'stat::number_of_executed_units|stat::peak_rss' "$findings/$name.log"
else
  tail -60 "$findings/$name.log"
fi
exit $status
