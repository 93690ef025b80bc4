#!/usr/bin/env bash
# Unpacks the ARM64 headers and libraries of core into a folder, from the same package sources as this Debian. Needs no root and
# changes nothing outside the folder.   aarch64_sysroot.sh build/aarch64-sysroot
set -euo pipefail
root=$1
compiler=$(g++ -dumpversion | cut -d. -f1)
packages=("libstdc++-$compiler-dev" libglm-dev libspdlog-dev nlohmann-json3-dev libtbb-dev zlib1g-dev libmeshoptimizer-dev
  libsleef-dev libpng-dev libjpeg-dev libwebp-dev libtiff-dev libpugixml-dev libzip-dev libxxhash-dev libtinygltf-dev)
stamp=$root/.made-from
if [ "$(cat "$stamp" 2>/dev/null)" = "${packages[*]}" ]; then echo "$root is there"; exit 0; fi

state=$(mkdir -p "$root" && cd "$root" && pwd)/.apt
mkdir -p "$state/lists/partial" "$state/archives/partial"
: >"$state/status"
options=(-o APT::Architecture=arm64 -o APT::Architectures=arm64 -o APT::Sandbox::User= -o Debug::NoLocking=1
  -o Dir::State::status="$state/status" -o Dir::State::lists="$state/lists" -o Dir::Cache::archives="$state/archives"
  -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache=)
apt-get "${options[@]}" -qq update
apt-get "${options[@]}" -qq -y --no-install-recommends --download-only install "${packages[@]}"

for package in "$state"/archives/*.deb; do dpkg -x "$package" "$root"; done
[ -e "$root/lib" ] || ln -s usr/lib "$root/lib"
rm -r "$state"
echo "${packages[*]}" >"$stamp"
