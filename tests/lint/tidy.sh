#!/usr/bin/env bash
# clang-tidy over the sources that changed since a commit:  tidy.sh build/release [base|all]
# Default base: where this branch left its upstream, or the commit before this one.
set -euo pipefail
build=$1
base=${2:-$(git merge-base HEAD '@{upstream}' 2>/dev/null || git rev-parse HEAD~1)}
tidy=$(command -v clang-tidy-14 || command -v clang-tidy)

changed() {
  if [ "$base" = all ]; then git ls-files '*.cpp'; else git diff --name-only --diff-filter=d "$base" -- '*.cpp'; git ls-files -o --exclude-standard '*.cpp'; fi
}
# Precompiled headers are GCC's and mean nothing to clang: the commands without them.
commands=$build/tidy
mkdir -p "$commands"
sed -E 's/ -include [^ ]*cmake_pch\.hxx//g' "$build/compile_commands.json" >"$commands/compile_commands.json"
check() {  # one file
  if ! "$tidy" -p "$commands" --quiet "$1" --extra-arg=-Wno-everything >"$build/tidy.$$.log" 2>&1; then
    grep -E 'error:|warning:' "$build/tidy.$$.log" | sort -u
    return 1
  fi
}

passed=0
failed=0
for file in $(changed | grep -E '^(core|server|api_schema|tests)/' | sort -u); do
  grep -q "/$file\"" "$build/compile_commands.json" || continue
  if check "$file"; then passed=$((passed + 1)); else failed=$((failed + 1)); fi
done
rm -f "$build/tidy.$$.log"
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
