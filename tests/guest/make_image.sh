#!/bin/sh
# Makes a guest of Debian's arm64 kernel: DIR/vmlinuz and DIR/initrd.gz with busybox, iproute2, can-utils and the
# modules for CAN, 9p and the emulated controllers. Nothing is installed on the host. Returns at once when it is there.
# Usage: make_image.sh DIR
set -eu
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$1"
dir=$(cd "$1" && pwd)
root=$dir/root
kernels=$dir/kernel
lib=aarch64-linux-gnu
stamp=$(cat "$here/make_image.sh" "$here/guest_init.sh" | cksum)
[ "$(cat "$dir/stamp" 2>/dev/null || true)" != "$stamp" ] || exit 0

"$here/../../toolchains/unpack.sh" arm64 "$root" busybox-static dash iproute2 can-utils libstdc++6
# The metapackage names the kernel's own package. What both depend on (tools to make an initramfs) is not wanted.
"$here/../../toolchains/unpack.sh" arm64 "$dir/meta" =linux-image-arm64
kernel=$(dpkg-deb -f "$dir"/meta.apt/cache/archives/linux-image-arm64_*.deb Depends | sed 's/[ ,].*//')
"$here/../../toolchains/unpack.sh" arm64 "$kernels" "=$kernel"
version=$(ls "$kernels/usr/lib/modules")
cp "$kernels/boot/vmlinuz-$version" "$dir/vmlinuz"
depmod -b "$kernels/usr" "$version" 2>/dev/null || depmod -b "$kernels" "$version"

initrd=$dir/initrd
rm -rf "$initrd"
mkdir -p "$initrd/bin" "$initrd/lib/$lib" "$initrd/modules" "$initrd/usr"
for sub in proc sys dev host sysroot run tmp; do mkdir "$initrd/$sub"; done
ln -s bin "$initrd/sbin"
ln -s ../bin "$initrd/usr/bin"
ln -s ../lib "$initrd/usr/lib"
cp -L "$root/bin/dash" "$initrd/bin/sh" # busybox's own shell prefers its applets to the real ip
for program in busybox ip tc candump cansend cangen canplayer; do
    for sub in bin sbin usr/bin usr/sbin; do
        if [ -f "$root/$sub/$program" ]; then
            cp -L "$root/$sub/$program" "$initrd/bin/"
            break
        fi
    done
done

needed() { "$lib-objdump" -p "$1" 2>/dev/null | awk '/NEEDED/ { print $2 }'; }
missing="libstdc++.so.6 $(for file in "$initrd"/bin/*; do needed "$file"; done | sort -u)"
while [ -n "$missing" ]; do
    next=
    for library in $missing; do
        [ ! -e "$initrd/lib/$lib/$library" ] || continue
        cp -L "$root/usr/lib/$lib/$library" "$initrd/lib/$lib/$library"
        next="$next $(needed "$initrd/lib/$lib/$library")"
    done
    missing=$(echo $next)
done
ln -s "$lib/ld-linux-aarch64.so.1" "$initrd/lib/ld-linux-aarch64.so.1"

# Modules in load order, each with what it depends on.
for module in virtio_pci 9pnet_virtio 9p can-dev can can-raw vcan slcan kvaser_pci sch_tbf sch_netem; do
    modprobe -d "$kernels" -S "$version" --show-depends "$module" 2>/dev/null | awk '$1 == "insmod" { print $2 }'
done | awk '!seen[$0]++' | while read -r file; do
    cp "$file" "$initrd/modules/"
    basename "$file"
done >"$initrd/modules/order"
cp "$here/guest_init.sh" "$initrd/init"
chmod +x "$initrd/init"
(cd "$initrd" && find . | LC_ALL=C sort | cpio -o -H newc --quiet | gzip -1) >"$dir/initrd.gz"
echo "$stamp" >"$dir/stamp"
ls -l "$dir/vmlinuz" "$dir/initrd.gz"
