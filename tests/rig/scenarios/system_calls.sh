#!/bin/sh
# What the program asks of the kernel in its steady state, thread by thread: the loop sleeps and talks to its bus, and nothing
# else. At 100 Hz, so that there is time for the tracer.
modprobe -a vcan can-raw
ip link add dev can0 type vcan && ip link set can0 mtu 72 up
mkdir -p /run && mount -t tmpfs run /run

tactus emulate odrive --nodes 0,1,2 --can can0 --mechanism woodenhaptics --ratio 16,12,12 --hand pen --path /images/wish.csv \
  --origin 0.0,-0.01,0.23 --realtime 70 2>/dev/null &
emulator=$!
sleep 0.5
tactusd /images/odrive_loop.tactus /images/bunny.tactus --enable --rate 100 --seconds 3 2>/results/tactusd.log &
program=$!
sleep 1
chrt -f 60 strace -f -qq -o /results/trace -p $program &
tracer=$!
sleep 1
kill -INT $tracer
wait $tracer
wait $program
code=$?
kill -INT $emulator
cat /results/tactusd.log
[ $code -eq 0 ] || { echo "FAILED: tactusd ended with $code" && exit 1; }

# A line of the trace is a thread's number, then the call's name; one that was going on when another thread called has two.
calls() { sed -n "s/^$1 *\([a-z0-9_]*\)(.*/\1/p" /results/trace | sort | uniq -c; }

# allow WHO NUMBER NAME...: prints what the thread called; more than the names is a failure.
allow() {
  who="$1" thread="$2"
  shift 2
  calls "$thread" >/results/calls
  echo "measured: $who calls $(awk '{ printf "%s%s %d times", comma, $2, $1; comma = ", " }' /results/calls)"
  [ -s /results/calls ] || { echo "FAILED: $who was not seen" && exit 1; }
  while read -r _ name; do
    case " $* " in
      *" $name "*) ;;
      *) echo "FAILED: $who calls $name" && exit 1 ;;
    esac
  done </results/calls
}

allow 'the loop' $program clock_nanosleep ppoll recvmmsg sendmmsg restart_syscall
sed 's/ .*//' /results/trace | sort -u | grep -vx $program >/results/threads
while read -r thread; do
  allow "helper thread $thread" "$thread" clock_nanosleep restart_syscall write
done </results/threads
