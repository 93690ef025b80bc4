#!/usr/bin/env bash
# Proves the README on a machine that has nothing: makes a bare Debian in a folder with debootstrap, puts a clone of HEAD into it, and
# runs a command there, by default ./dev test. Needs root. The folder is kept, so that a second run starts warm; delete it to start from nothing.
#   .ci/bare.sh [bookworm|trixie] [command...]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
suite=${1:-bookworm}
[ $# = 0 ] || shift
[ $# -gt 0 ] || set -- ./dev test
root=${SEEDMESH_BARE:-/var/tmp/seedmesh-bare}/$suite

if [ ! -d "$root/etc" ]; then
  mkdir -p "$root"
  debootstrap --variant=minbase "$suite" "$root"
fi
cp /etc/resolv.conf "$root/etc/resolv.conf"
rm -rf "$root/seedmesh.new"
git clone --quiet --no-hardlinks . "$root/seedmesh.new"
if [ -d "$root/seedmesh/build" ]; then mv "$root/seedmesh/build" "$root/seedmesh.new/build"; fi
rm -rf "$root/seedmesh"
mv "$root/seedmesh.new" "$root/seedmesh"

# A network that signs traffic with its own certificate names it to Node by this variable. The bare machine needs the certificate, too.
environment=(HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin CI=true LANG=C.UTF-8)
if [ -n "${NODE_EXTRA_CA_CERTS:-}" ]; then
  cp "$NODE_EXTRA_CA_CERTS" "$root/usr/local/share/host-certificates.pem"
  environment+=(NODE_EXTRA_CA_CERTS=/usr/local/share/host-certificates.pem)
fi

# A mount namespace of its own, so that nothing stays mounted: the programs of the tests expect /proc, /dev/shm and the like.
export root
start=$SECONDS
status=0
unshare --mount --fork bash -c '
  mount -t proc proc "$root/proc" && mount --rbind /dev "$root/dev" && mount -t tmpfs tmpfs "$root/dev/shm" || exit 125
  exec chroot "$root" env -i "$@"
' bare "${environment[@]}" bash -c 'cd /seedmesh && exec "$@"' bare "$@" </dev/null || status=$?
echo "$suite: '$*' ended with $status after $((SECONDS - start)) s"
exit $status
