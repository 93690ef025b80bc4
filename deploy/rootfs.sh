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

# What is in the image, as SPDX 2.3: the program and the Debian packages of its libraries, with their versions.
for library in "${libraries[@]}"; do
  file=$(readlink -f "$library")
  { dpkg-query -S "$file" || dpkg-query -S "${file#/usr}"; } 2>/dev/null | head -1 | cut -d: -f1
done | sort -u | xargs dpkg-query -W -f '${Package}\t${Version}\t${source:Package}\t${Architecture}\n' |
  awk -F '\t' -v version="$("$program" --version | awk 'NR == 1 { print $2 }')" -v created="$(date -u +%Y-%m-%dT%H:%M:%SZ)" -v distribution="$(. /etc/os-release && echo "$ID-$VERSION_ID")" '
    BEGIN {
      printf "{\"spdxVersion\":\"SPDX-2.3\",\"dataLicense\":\"CC0-1.0\",\"SPDXID\":\"SPDXRef-DOCUMENT\",\"name\":\"seedmesh-%s\",", version
      printf "\"documentNamespace\":\"https://spdx.org/spdxdocs/seedmesh-%s-%s\",", version, distribution
      printf "\"creationInfo\":{\"creators\":[\"Tool: seedmesh-rootfs\"],\"created\":\"%s\"},\"packages\":[", created
      printf "{\"name\":\"seedmesh\",\"SPDXID\":\"SPDXRef-seedmesh\",\"versionInfo\":\"%s\",\"downloadLocation\":\"NOASSERTION\",\"licenseConcluded\":\"MIT\",\"licenseDeclared\":\"MIT\",\"copyrightText\":\"NOASSERTION\"}", version
    }
    {
      id = $1; gsub(/[^A-Za-z0-9.-]/, "-", id)
      printf ",{\"name\":\"%s\",\"SPDXID\":\"SPDXRef-deb-%s\",\"versionInfo\":\"%s\",\"downloadLocation\":\"NOASSERTION\",\"licenseConcluded\":\"NOASSERTION\",\"licenseDeclared\":\"NOASSERTION\",\"copyrightText\":\"NOASSERTION\",", $1, id, $2
      purl = $2; gsub(/\+/, "%2B", purl); gsub(/:/, "%3A", purl)
      printf "\"externalRefs\":[{\"referenceCategory\":\"PACKAGE-MANAGER\",\"referenceType\":\"purl\",\"referenceLocator\":\"pkg:deb/debian/%s@%s?arch=%s&distro=%s\"}]}", $1, purl, $4, distribution
      relations = relations sprintf(",{\"spdxElementId\":\"SPDXRef-seedmesh\",\"relationshipType\":\"DYNAMIC_LINK\",\"relatedSpdxElement\":\"SPDXRef-deb-%s\"}", id)
    }
    END {
      printf "],\"relationships\":[{\"spdxElementId\":\"SPDXRef-DOCUMENT\",\"relationshipType\":\"DESCRIBES\",\"relatedSpdxElement\":\"SPDXRef-seedmesh\"}%s]}\n", relations
    }' >"$root/licences/sbom.spdx.json"

echo 'seedmesh:x:10001:10001::/:/usr/sbin/nologin' >"$root/etc/passwd"
echo 'seedmesh:x:10001:' >"$root/etc/group"

# The loader finds everything in there, before the image is made of it.
chroot "$root" "/usr/bin/$(basename "$program")" --version
