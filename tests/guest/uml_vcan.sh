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
