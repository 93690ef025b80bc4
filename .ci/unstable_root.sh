#!/usr/bin/env bash
# Unpacks Godot and Blender of Debian unstable with their libraries into a folder, and writes programs <folder>/godot and <folder>/blender
# that run them. Needs no root and changes nothing outside the folder.   unstable_root.sh build/unstable
set -euo pipefail
packages=(godot blender python3-numpy python3-cattr python3-requests)  # Blender needs the Python packages, but does not require them
mkdir -p "$1"
root=$(cd "$1" && pwd)
stamp=$root/.made-from
if [ "$(cat "$stamp" 2>/dev/null)" = "${packages[*]}" ]; then echo "$root is there"; exit 0; fi

state=$root/.apt
mkdir -p "$state/lists/partial" "$state/archives/partial"
: >"$state/status"
# The same package source as that of this Debian, without those of its security updates.
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' | grep -v security | sort -u | head -1)
[ -n "$mirror" ] || { echo "apt knows no package source: run 'apt-get update' first"; exit 1; }
echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror sid main" >"$state/sources.list"
options=(-o APT::Sandbox::User= -o Debug::NoLocking=1
  -o Dir::Etc::sourcelist="$state/sources.list" -o Dir::Etc::sourceparts=/dev/null
  -o Dir::State::status="$state/status" -o Dir::State::lists="$state/lists" -o Dir::Cache::archives="$state/archives"
  -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache=)
apt-get "${options[@]}" -qq update
apt-get "${options[@]}" -qq -y --no-install-recommends --download-only install "${packages[@]}"
for package in "$state"/archives/*.deb; do dpkg -x "$package" "$root"; done
rm -r "$state"

libraries=$root/usr/lib/$(uname -m)-linux-gnu
loader=$(find "$root/usr/lib64" "$libraries" -maxdepth 1 -name 'ld-linux-*' 2>/dev/null | head -1)
run="exec \"$loader\" --library-path \"$libraries:$root/usr/lib:$libraries/pulseaudio:$libraries/blas:$libraries/lapack\" \"$root/usr/bin"
mkdir -p "$root/bin"
printf '#!/bin/sh\n%s/godot" "$@"\n' "$run" >"$root/godot"
printf '#!/bin/sh\n%s/python3" "$@"\n' "$run" >"$root/bin/python3"  # Blender installs extensions by a Python of its own version
printf '#!/bin/sh\nexport PATH="%s/bin:$PATH" PYTHONHOME="%s/usr" BLENDER_SYSTEM_RESOURCES="%s/usr/share/blender"\n%s/blender" --python-use-system-env "$@"\n' \
  "$root" "$root" "$root" "$run" >"$root/blender"
for name in python "$(basename "$(readlink -f "$root/usr/bin/python3")")"; do ln -sf python3 "$root/bin/$name"; done
chmod +x "$root/godot" "$root/blender" "$root/bin/python3"
"$root/godot" --version
"$root/blender" --version | head -1
echo "${packages[*]}" >"$stamp"
