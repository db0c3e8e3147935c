#!/bin/sh
# In User Mode Linux: semtrack-sil on a serial adapter's interface that is disturbed while it publishes. What arrives
# must be frames of can.log in their order, and after each disturbance frames must arrive again.
# Usage: uml_faults.sh WORK SEMTRACK_SIL ADAPTER DRIVE
set -u
work=$1
sil=$2
mkfifo "$work/commands" 2>/dev/null
"$3" "$work/interface" "$work/adapter.log" <"$work/commands" &
exec 3>"$work/commands"
tries=0
until [ -s "$work/interface" ]; do
    tries=$((tries + 1))
    [ "$tries" -lt 100 ] || exit 20
    sleep 0.1
done
interface=$(cat "$work/interface")
ip -d link show "$interface"

lines() { wc -l <"$work/adapter.log"; }
# arrives WHAT: within ten seconds something more arrives at the adapter.
arrives() {
    before=$(lines)
    tries=0
    until [ "$(lines)" -gt "$before" ]; do
        tries=$((tries + 1))
        if [ "$tries" -ge 100 ]; then
            echo "nothing arrives: $1"
            exit 21
        fi
        sleep 0.1
    done
    echo "frames arrive: $1"
}

"$sil" replay --layout odometry --root "$4" --sequence 00 --detections "$4/detections/00.txt" --no-progress \
    --realtime --can "$interface" --can-dialect classic --out "$work/faults" &
sender=$!
arrives "at first"
echo passive >&3
arrives "error-passive"
echo active >&3
arrives "error-active again"
echo stall >&3 # the queue fills; ten lists must not come later
sleep 1.5
echo resume >&3
arrives "the adapter reads again"
echo busoff >&3
sleep 0.5
echo active >&3
echo down >&3 # slcan has no restart-ms: its controller is restarted with the interface
sleep 0.2
echo up >&3
arrives "after bus-off"
echo down >&3
sleep 0.5
echo up >&3
arrives "the interface is up again"
wait "$sender"
status=$?
sleep 1
echo quit >&3
echo "semtrack-sil ended with status $status"
exit "$status"
