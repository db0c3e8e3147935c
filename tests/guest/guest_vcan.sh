#!/bin/sh
# In the arm64 guest: virtual CAN, then two emulated controllers on one bus.
# $SIL: how to start semtrack-sil there. /host: what run_all.sh put into the shared folder.
set -u
SIL="/sysroot/lib/ld-linux-aarch64.so.1 --library-path /sysroot/usr/lib/aarch64-linux-gnu /host/semtrack-sil"
replay="$SIL replay --layout odometry --root /host/drive --sequence 00 --detections /host/drive/detections/00.txt
    --first 4 --last 7 --no-progress"
ip link add dev vcan0 type vcan && ip link set vcan0 mtu 72 && ip link set vcan0 up || exit 10
sh ./publish.sh /host/vcan.dump vcan0 $replay --can vcan0 --out /host/vcan || exit 11
for interface in can0 can1; do
    ip link set "$interface" type can bitrate 500000 restart-ms 100 berr-reporting on &&
        ip link set "$interface" up || exit 12
done
sh ./publish.sh /host/controller.dump can1 $replay --can can0 --can-dialect classic --out /host/controller || exit 13
