#!/bin/sh
# Boots the guest of make_image.sh with SHARE at /host and SYSROOT at /sysroot (read-only), runs SHARE/guest.sh in it.
# Usage: run_guest.sh IMAGE SHARE SYSROOT [qemu option...]    LIMIT seconds in the environment (240)
# Exit status: that of guest.sh; 124 too late, 125 it never got there. Both are failures, never skips.
set -eu
image=$1
share=$2
sysroot=$3
shift 3
rm -f "$share/guest.status"
status=0
timeout "${LIMIT:-240}" qemu-system-aarch64 -M virt,gic-version=3 -cpu cortex-a57 -m 768 -smp 1 -nodefaults \
    -display none -no-reboot -serial stdio -kernel "$image/vmlinuz" -initrd "$image/initrd.gz" \
    -append "console=ttyAMA0 quiet panic=-1" \
    -fsdev local,id=host,path="$share",security_model=none -device virtio-9p-pci,fsdev=host,mount_tag=host \
    -fsdev local,id=sysroot,path="$sysroot",security_model=none,readonly=on \
    -device virtio-9p-pci,fsdev=sysroot,mount_tag=sysroot "$@" </dev/null || status=$?
[ "$status" -ne 124 ] || exit 124
[ -s "$share/guest.status" ] || exit 125
exit "$(cat "$share/guest.status")"
