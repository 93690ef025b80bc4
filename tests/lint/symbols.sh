#!/usr/bin/env bash
# No object of core may call what gives other bits on another CPU or in another run: libm's transcendental functions, the
# C library's random numbers, clocks of the calendar, and the locale.
#   symbols.sh build/release
set -euo pipefail
build=$1

functions='a?sin|a?cos|a?tan|atan2|sinh|cosh|tanh|sincos|exp|exp2|exp10|expm1|log|log2|log10|log1p|pow|cbrt|hypot|tgamma|lgamma|fma'
forbidden="^(($functions)[fl]?|s?rand|s?random|drand48|rand_r|time|gettimeofday|localtime|setlocale|_ZNSt13random_device.*)(@.*)?\$"

passed=0
failed=0
while IFS= read -r object; do
  hits=$(nm -u "$object" | awk '{ print $NF }' | grep -E "$forbidden" | sort -u | tr '\n' ' ' || true)
  if [ -z "$hits" ]; then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
    printf '%s calls %s\n' "${object#"$build"/}" "$hits"
  fi
done < <(find "$build/core" -name '*.cpp.o' | sort)

[ $((passed + failed)) -gt 0 ] || { echo "no objects below $build/core"; failed=1; }
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
