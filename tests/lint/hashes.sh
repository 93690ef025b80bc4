#!/usr/bin/env bash
# The bytes of every preset must not depend on who compiled the program, how, or on how many threads it ran.
#   hashes.sh <preset> [preset...]   compares the tables that hash_presets of each build prints, with 1 and 8 threads; fresh memory is
#                                    filled with other bytes in each run, so that reading it unset would show
set -euo pipefail
folder=build/hashes
mkdir -p "$folder"

run() {  # <preset> <threads>
  local program=build/$1/hash_presets
  export MALLOC_PERTURB_=$(($2 * 21 + 1))
  if [ "$1" = aarch64 ]; then
    local emulator
    emulator=$(command -v qemu-aarch64-static || command -v qemu-aarch64)
    "$emulator" -L build/aarch64-sysroot "$program" --threads "$2"
  else
    "$program" --threads "$2"
  fi
}

reference=
passed=0
failed=0
for preset in "$@"; do
  for threads in 1 8; do
    table=$folder/$preset-$threads.txt
    if ! run "$preset" "$threads" >"$table"; then
      echo "$preset, $threads threads: hash_presets failed"
      failed=$((failed + 1))
      continue
    fi
    reference=${reference:-$table}
    same=$(comm -12 <(sort "$reference") <(sort "$table") | wc -l)
    other=$(comm -13 <(sort "$reference") <(sort "$table") | wc -l)
    passed=$((passed + same)) failed=$((failed + other))
    printf '%-8s %s threads: %d presets with the same bytes, %d with others\n' "$preset" "$threads" "$same" "$other"
    [ "$other" = 0 ] || diff "$reference" "$table" | head -20 || true
  done
done
[ "$passed" -gt 0 ] || failed=$((failed + 1))
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
