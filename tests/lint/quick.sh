#!/usr/bin/env bash
# The lints that take seconds and need nothing but a build:  quick.sh build/release
set -uo pipefail
here=$(dirname "${BASH_SOURCE[0]}")
status=0
"$here/layers.mjs" . || status=1
"$here/messages.mjs" . || status=1
"$here/web_cycles.mjs" . || status=1
"$here/functions.mjs" . || status=1
"$here/draws.mjs" . || status=1
"$here/glossary.mjs" . || status=1
"$here/sentences.mjs" . || status=1
"$here/generator_page.mjs" . || status=1
"$here/symbols.sh" "$1" || status=1
python3 "$here/../../clients/generate_types.py" --check || status=1
exit $status
