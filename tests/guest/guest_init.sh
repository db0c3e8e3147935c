#!/bin/sh
# First process of the guest: modules, the host's folder at /host, then /host/guest.sh; its status goes to
# /host/guest.status.
/bin/busybox --install -s /bin 2>/dev/null
export PATH=/bin
mount -t proc proc /proc
mount -t sysfs sys /sys
mount -t devtmpfs dev /dev 2>/dev/null
mount -t tmpfs run /run
mkdir -p /dev/pts /dev/shm
mount -t devpts pts /dev/pts
mount -t tmpfs shm /dev/shm
echo "guest: kernel $(uname -r) $(uname -m), up $(cut -d' ' -f1 /proc/uptime) s"
while read -r module; do
    name=$(echo "${module%.ko}" | tr - _)
    grep -q "^$name " /proc/modules || insmod "/modules/$module" || echo "guest: insmod $module failed"
done </modules/order
ip link set lo up
if mount -t 9p -o trans=virtio,version=9p2000.L,msize=262144 host /host; then
    mount -t 9p -o ro,trans=virtio,version=9p2000.L,msize=262144,cache=loose sysroot /sysroot
    cd /host && {
        sh ./guest.sh
        echo "$?" >/host/guest.status
    }
fi
echo "guest: ends, up $(cut -d' ' -f1 /proc/uptime) s"
sync
poweroff -f
