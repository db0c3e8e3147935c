#!/bin/sh
# In User Mode Linux: the host's own binary on virtual CAN.
# Usage: uml_vcan.sh WORK SEMTRACK_SIL DRIVE
set -u
here=$(dirname "$0")
work=$1
replay="$2 replay --layout odometry --root $3 --sequence 00 --detections $3/detections/00.txt --first 4 --no-progress"
"$here/publish.sh" "$work/vcan.dump" vcan0 $replay --last 13 --realtime --can vcan0 --out "$work/vcan" || exit 11

# A receiver that never reads: it must not matter to anybody else.
candump vcan0 >/dev/null &
slow=$!
sleep 0.3
kill -STOP "$slow"
"$here/publish.sh" "$work/slow.dump" vcan0 $replay --last 13 --can vcan0 --out "$work/slow" || exit 12
kill -KILL "$slow"

# A queue of two frames that drains at 100 kbit/s: the kernel says ENOBUFS in every list, and each list arrives whole.
tc qdisc add dev vcan0 root tbf rate 100kbit burst 200 limit 200 || exit 13
"$here/publish.sh" "$work/full.dump" vcan0 $replay --last 13 --realtime --can vcan0 --out "$work/full" || exit 14
grep '"can_no_buffers": [1-9]' "$work/full/metrics.json" || exit 15
