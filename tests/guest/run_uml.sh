#!/bin/sh
# Runs a command of this very machine in User Mode Linux: the host's files, and a kernel that has CAN, with vcan0 up.
# Usage: run_uml.sh WORK COMMAND [argument...]    WORK: a folder for this run; LIMIT seconds in the environment (240)
# Exit status: the command's; 124 too late, 125 it never got there. Both are failures, never skips.
set -eu
mkdir -p "$1"
work=$(cd "$1" && pwd)
shift
modules=$(ls -d /usr/lib/uml/modules/*/ | tail -n 1)
rm -f "$work/status" "$work/output"
: >"$work/output"
quoted=
for word in "$@"; do
    quoted="$quoted '$(printf %s "$word" | sed "s/'/'\\\\''/g")'"
done
cat >"$work/init" <<INIT
#!/bin/sh
export PATH='$PATH' HOME='$HOME' LANG=C.UTF-8
mount -t proc proc /proc
mount -t sysfs sys /sys
mount -t tmpfs tmp /run
mount -t tmpfs tmp /dev/shm 2>/dev/null
mkdir -p /dev/pts && mount -t devpts pts /dev/pts
exec >>'$work/output' 2>&1 </dev/null
for module in can-dev can can-raw vcan slcan sch_tbf; do
    insmod "\$(find '$modules' -name "\$module.ko")" || echo "insmod \$module failed"
done
ip link set lo up
ip link add dev vcan0 type vcan && ip link set vcan0 mtu 72 && ip link set vcan0 up
cd '$PWD' && {
    $quoted
    echo \$? >'$work/status'
}
sync
echo o >/proc/sysrq-trigger
sleep 5
INIT
chmod +x "$work/init"
status=0
timeout "${LIMIT:-240}" linux.uml mem=256M root=none rootfstype=hostfs rootflags=/ rw quiet uml_dir="$work" \
    init="$work/init" con=null con0=null,fd:2 </dev/null >"$work/kernel.log" 2>&1 || status=$?
cat "$work/output"
[ "$status" -ne 124 ] || exit 124
if [ ! -s "$work/status" ]; then
    tail -n 5 "$work/kernel.log" >&2
    exit 125
fi
exit "$(cat "$work/status")"
