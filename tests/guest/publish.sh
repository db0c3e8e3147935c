#!/bin/sh
# Runs where a kernel with CAN is (the arm64 guest, User Mode Linux): a sender publishes, candump records.
# Usage: publish.sh DUMP RECORDED_INTERFACE COMMAND...
# Leaves candump's log in DUMP; exit status: the command's, 99 when candump never listened.
set -u
dump=$1
interface=$2
shift 2
candump -L -r 4194304 "$interface" >"$dump" &
recorder=$!
tries=0
until grep -q "^ *$interface " /proc/net/can/rcvlist_all; do
    tries=$((tries + 1))
    [ "$tries" -lt 100 ] || exit 99
    sleep 0.1
done
"$@"
status=$?
# Until nothing comes any more.
size=-1
while [ "$size" != "$(wc -c <"$dump")" ]; do
    size=$(wc -c <"$dump")
    sleep 1
done
kill "$recorder"
wait "$recorder" 2>/dev/null
exit "$status"
