#!/bin/sh
# Checks the system calls of the program in its steady state, thread by thread: the loop sleeps and talks to its bus, and does
# nothing else. The rate is 100 Hz, so that there is time for the tracer.
mkdir -p /run # tactusd makes its folder there
modprobe -a vcan can-raw
ip link add dev can0 type vcan && ip link set can0 mtu 72 up
mkdir -p /run && mount -t tmpfs run /run

tactus emulate odrive --nodes 0,1,2 --encoder multi_turn --can can0 --mechanism woodenhaptics --ratio 16,12,12 --hand pen --path /images/wish.csv \
  --origin 0.0,-0.01,0.23 --realtime 70 2>/dev/null &
emulator=$!
sleep 0.5
chrt -f 60 strace -f -qq -e 'raw=!write' -e verbose=none -o /results/trace \
  tactusd /images/odrive_traced.tactus /images/bunny.tactus --enable --allow-uncommissioned --rate 100 --seconds 1.5 \
  --record /results/run.mcap --run-dir /run 2>/results/tactusd.log
code=$?
kill -INT $emulator
cat /results/tactusd.log
[ $code -eq 0 ] || { echo "FAILED: tactusd ended with $code" && exit 1; }

# A line is a thread's number, then a call; one that was going on when another thread called has two. Steady is what lies between
# the motors' power and the return to ordinary priority.
sed -n '/tactusd: active/,/sched_setscheduler/{//!p}' /results/trace >/results/steady
calls() { sed -n "s/^$1 *\([a-z0-9_]*\)(.*/\1/p" /results/steady | sort | uniq -c; }

# allow WHO NUMBER NAME...: prints what the thread called; more than the names is a failure.
allow() {
  who="$1" thread="$2"
  shift 2
  calls "$thread" >/results/calls
  echo "measured: $who: $(awk '{ printf "%s%s %d times", comma, $2, $1; comma = ", " }' /results/calls)"
  [ -s /results/calls ] || { echo "FAILED: $who was not seen" && exit 1; }
  while read -r _ name; do
    case " $* " in
      *" $name "*) ;;
      *) echo "FAILED: $who calls $name" && exit 1 ;;
    esac
  done </results/calls
}

loop="$(sed -n '1s/ .*//p' /results/trace)"
# The loop waits for its time and its bus. The others wait, too, and write and send, and never ask for memory.
allow 'the loop' "$loop" clock_nanosleep ppoll recvmmsg sendmmsg
sed 's/ .*//' /results/steady | sort -u | grep -vx "$loop" >/results/threads
while read -r thread; do
  allow "helper thread $thread" "$thread" clock_nanosleep ppoll poll accept4 recvfrom sendto sendmsg write pwrite64 lseek close
done </results/threads
