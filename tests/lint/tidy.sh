#!/usr/bin/env bash
# clang-tidy over the sources that changed since a commit:  tidy.sh build/release [base|all]
# Default base: where this branch left its upstream; on a branch that is equal to its upstream, the commit before the last.
# Of a large change only the first files are checked, because a file takes up to 20 seconds; the others are counted as skipped.
set -euo pipefail
build=$1
base=${2:-}
most_files=24
tidy=$(command -v clang-tidy-14 || command -v clang-tidy || true)
if [ -z "$tidy" ]; then
  echo "clang-tidy is not installed"
  echo "0 passed, 0 failed, 1 skipped"
  exit 0
fi
if [ -z "$base" ]; then
  base=$(git merge-base HEAD '@{upstream}' 2>/dev/null || git rev-parse HEAD)
  [ "$base" != "$(git rev-parse HEAD)" ] || base=$(git rev-parse -q --verify HEAD~1 || echo HEAD)
fi

changed() {
  if [ "$base" = all ]; then
    git ls-files '*.cpp'
  else
    git diff --name-only --diff-filter=d "$base" -- '*.cpp'
    git ls-files -o --exclude-standard '*.cpp'
  fi
}
# Precompiled headers are GCC's and mean nothing to clang: the commands without them.
commands=$build/tidy
mkdir -p "$commands"
sed -E 's/ -include [^ ]*cmake_pch\.hxx//g' "$build/compile_commands.json" >"$commands/compile_commands.json"

mapfile -t files < <(changed | grep -E '^(core|server|api_schema|tests)/' | sort -u | while read -r file; do
  if grep -q "/$file\"" "$build/compile_commands.json"; then echo "$file"; fi
done)
skipped=0
if [ "$base" != all ] && [ ${#files[@]} -gt $most_files ]; then
  skipped=$((${#files[@]} - most_files))
  files=("${files[@]:0:$most_files}")
fi

check() {  # one file
  local log
  log=$(mktemp)
  if "$tidy" -p "$commands" --quiet "$1" --extra-arg=-Wno-everything >"$log" 2>&1; then
    echo "tidy $1"
  else
    { grep -E 'error:|warning:' "$log" || cat "$log"; } | sort -u
    echo "untidy $1"
  fi
  rm -f "$log"
}
export -f check
export tidy commands
results=$build/tidy/results.txt
: >"$results"
[ ${#files[@]} = 0 ] || printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$(nproc)" bash -c 'check "$1"' check >"$results"
grep -v '^tidy ' "$results" || true
passed=$(grep -c '^tidy ' "$results" || true)
failed=$((${#files[@]} - passed))
echo "$passed passed, $failed failed, $skipped skipped"
[ "$failed" = 0 ]
