#!/usr/bin/env bash
# SPDX-License-Identifier: Zlib
# bare_debian.sh ROOT PACKAGES [SUITE]: PACKAGES, a folder of .deb files, install and work in a Debian that has nothing but
# what every Debian has. As root, with debootstrap; it is downloaded into ROOT, once.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$1 packages=$2 suite=${3:-bookworm}

if [[ ! -e $root/pristine ]]; then
  debootstrap --variant=minbase "$suite" "$root/new"
  mv "$root/new" "$root/pristine"
fi
rm -rf "$root/tried"
cp -a "$root/pristine" "$root/tried"
mkdir "$root/tried/packages" "$root/tried/app"
cp "$packages"/*.deb "$root/tried/packages/"
cp "$here"/consumer/* "$root/tried/app/"
cp /etc/resolv.conf "$root/tried/etc/"

# Mounts and processes of its own end with it.
unshare --mount --pid --fork --mount-proc="$root/tried/proc" chroot "$root/tried" bash -euxo pipefail <<'INSIDE'
export DEBIAN_FRONTEND=noninteractive
apt-get -qq update
install() { apt-get -qq install -y --no-install-recommends "$@" >/install.log 2>&1 || { cat /install.log; false; }; }

install /packages/wetcloth_*.deb
cd /tmp
wetcloth run hanging_towel.json --duration 0.1 --no-comparison
wetcloth run hanging_towel.json --duration 0.1 --no-comparison --precision float64

install /packages/python3-wetcloth_*.deb
python3 -c 'import wetcloth; s = wetcloth.open("hanging_towel.json"); s.step(9); print(s.cloths[0].water.sum())'

install g++ cmake make pkg-config /packages/libbullet-wetcloth*.deb
cmake -S /app -B /app/build -DMETHOD=find_package -DPRECISIONS=float32,float64
cmake --build /app/build
/app/build/app-float32
/app/build/app-float64
g++ -std=c++17 /app/main.cpp -o /app/by-pkg-config $(pkg-config --cflags --libs bullet_wetcloth)
/app/by-pkg-config
INSIDE
