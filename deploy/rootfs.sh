#!/usr/bin/env bash
# Makes the root file system of the image: a program, the shared libraries that it loads, their licences, one user, and the
# folders over which a container runtime mounts. No shell, no package manager.   rootfs.sh <program> <folder>
set -euo pipefail
program=$1 root=$2

mkdir -p "$root"/{usr/bin,etc,proc,sys,dev,tmp,licences}
install -m 755 "$program" "$root/usr/bin/"
strip "$root/usr/bin/$(basename "$program")"

mapfile -t libraries < <(ldd "$program" | grep -o '/[^ ]*')
for library in "${libraries[@]}"; do
  install -D -m 755 "$library" "$root$library"
  # The package manager knows the file itself, in /lib or in /usr/lib as its package has it.
  file=$(readlink -f "$library")
  package=$({ dpkg-query -S "$file" || dpkg-query -S "${file#/usr}"; } 2>/dev/null | head -1 | cut -d: -f1)
  cp -L "/usr/share/doc/$package/copyright" "$root/licences/$package"
done
cp LICENSE "$root/licences/seedmesh"

echo 'seedmesh:x:10001:10001::/:/usr/sbin/nologin' >"$root/etc/passwd"
echo 'seedmesh:x:10001:' >"$root/etc/group"

# The loader finds everything in there, before the image is made of it.
chroot "$root" "/usr/bin/$(basename "$program")" --version
