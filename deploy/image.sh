#!/usr/bin/env bash
# Builds the image with docker, podman or buildah, runs it as the README says, asks it for a model, and ends it. Where no base
# image can be pulled, debootstrap makes one (Debian 13, or else 12) from the package mirror of this machine. Logs are in build/image.
#   image.sh           any base
#   image.sh <release> a base of this release of Debian (trixie) by debootstrap, and nothing else
#   SEEDMESH_ENGINE    docker, podman or buildah (default: the first that works)
#   SEEDMESH_BASE      the base image (default: debian:trixie-slim)
#   SEEDMESH_CACHE     keeps the base, Debian packages and the compiler cache between runs (default: ~/.cache/seedmesh)
# Exit status 77: this machine cannot make images (no engine and no root, no mounts, or no package mirror).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
work=$PWD/build/image
cache=${SEEDMESH_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/seedmesh}/image
image=seedmesh
release=${1:-}

say() { printf '\n=== %s\n' "$*"; }
fail() { printf 'image: %s\n' "$*" >&2; exit 1; }
cannot() { printf 'image: skipped: %s\n' "$*" >&2; exit 77; }
has() { command -v "$1" >/dev/null 2>&1; }

find_engine() {
  local each
  for each in docker podman; do
    if has "$each" && "$each" info >/dev/null 2>&1; then echo "$each"; return; fi
  done
  if has buildah; then echo buildah; fi
}

# --- The base image -------------------------------------------------------------------------------------------------

# The mirror that this machine's apt has for a release, from whatever files say so.
mirror_of() {
  apt-get indextargets --format '$(SITE) $(RELEASE)' 'Created-By: Packages' |
    awk -v release="$1" '$2 == release && !found { print $1; found = 1 }'
}

make_base() {  # <release>: a minimal Debian in $cache/<release>
  local release=$1 here root=$cache/$1 mirror security
  [ ! -f "$root.made" ] || return 0
  here=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
  mirror=$(mirror_of "$here") security=$(mirror_of "$here-security")
  [ -n "$mirror" ] || cannot "apt here knows no mirror of '$here'"
  say "Making Debian $release with debootstrap"
  rm -rf "$root"
  debootstrap --variant=minbase --include=ca-certificates "$release" "$root" "$mirror" >"$work/debootstrap.log" 2>&1 || return 1
  {
    echo "deb $mirror $release main"
    echo "deb $mirror $release-updates main"
    [ -z "$security" ] || echo "deb $security $release-security main"
  } >"$root/etc/apt/sources.list"
  rm -rf "$root"/var/cache/apt/archives/*.deb "$root"/var/lib/apt/lists/*
  touch "$root.made"
}

import_base() {  # <release>: prints the name of the image
  local name=localhost/seedmesh-base:$1 container
  if [ "$engine" = buildah ]; then
    container=$(buildah from scratch)
    buildah add --quiet "$container" "$cache/$1" / >/dev/null
    buildah config --cmd bash "$container"
    buildah commit --quiet --rm "$container" "$name" >/dev/null
  else
    tar -C "$cache/$1" -c . | "$engine" import - "$name" >/dev/null
  fi
  echo "$name"
}

there() {  # <image>
  case $engine in
    docker) docker image inspect "$1" >/dev/null 2>&1 ;;
    *) [ -n "$("$engine" images -q "$1" 2>/dev/null)" ] ;;
  esac
}

choose_base() {  # sets base
  local releases=(trixie bookworm) each
  base=${SEEDMESH_BASE:-debian:trixie-slim}
  if [ -n "$release" ]; then
    releases=("$release")
  elif there "$base" || timeout 120 "$engine" pull -q "$base" </dev/null >"$work/pull.log" 2>&1; then return; fi
  [ -n "$release" ] || [ -z "${SEEDMESH_BASE:-}" ] || fail "cannot pull $base: $(tail -1 "$work/pull.log")"
  for each in "${releases[@]}"; do
    base=localhost/seedmesh-base:$each
    if there "$base"; then return; fi
    has debootstrap || ./dev setup image
    if make_base "$each"; then import_base "$each" >/dev/null; return; fi
  done
  cannot "debootstrap could make no base image: $(tail -1 "$work/debootstrap.log")"
}

# --- Building -------------------------------------------------------------------------------------------------------

build_image() {
  local version revision options=()
  version=$(sed -n 's/^project(seedmesh VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
  revision=$(git rev-parse --short HEAD 2>/dev/null || echo unknown)
  [ -z "${NODE_EXTRA_CA_CERTS:-}" ] || options+=(--secret "id=certificates,src=$NODE_EXTRA_CA_CERTS")
  options+=(--build-arg "BASE=$base" --build-arg "VERSION=$version" --build-arg "REVISION=$revision" -t "$image" .)
  case $engine in
    # The older of its two formats: the other has no place for a check of health.
    # Its cache of `RUN --mount=type=cache` is below TMPDIR.
    buildah) TMPDIR=$cache buildah bud --layers --format docker --isolation chroot --pull-never "${options[@]}" ;;
    podman) podman build --layers --format docker --pull=never "${options[@]}" ;;
    docker) DOCKER_BUILDKIT=1 docker build "${options[@]}" ;;
  esac </dev/null >"$work/build.log" 2>&1 && return
  tail -40 "$work/build.log"
  fail "the build failed; all it said is in build/image/build.log"
}

engine=${SEEDMESH_ENGINE:-$(find_engine)}
if [ -z "$engine" ]; then
  [ "$(id -u)" = 0 ] || cannot "there is no docker or podman, and buildah needs root: sudo ./dev image"
  has apt-get || cannot "there is no docker, podman or buildah"
  ./dev setup image || cannot "apt cannot install buildah and debootstrap"
  engine=$(find_engine)
fi
has "$engine" || fail "there is no '$engine' here"
if [ "$engine" = buildah ]; then
  [ "$(id -u)" = 0 ] || cannot "buildah needs root: sudo ./dev image"
  unshare --mount true 2>/dev/null || cannot "buildah needs mounts, which this container does not allow"
fi
mkdir -p "$work" "$cache"
choose_base
say "Building the image with $engine on $base"
start=$SECONDS
build_image
echo "built in $((SECONDS - start)) s"
deploy/smoke.sh "$engine" "$image"
