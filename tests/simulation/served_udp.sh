#!/usr/bin/env bash
# served_udp.sh TACTUS EXAMPLES: a served simulation sends its ticks as JSON to UDP ports, as tactusd does: each device to its own.
set -euo pipefail
tactus="$1" examples="$2"
# shellcheck source=tests/simulation/served.inc
source "$(dirname "${BASH_SOURCE[0]}")/served.inc"

# Listens at two neighbouring ports and writes the first one; each datagram is a JSON object.
cat >"$work/listen.py" <<'END'
import json
import os
import socket
import sys

def listener(port):
    found = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    found.bind(("127.0.0.1", port))
    found.settimeout(10)
    return found

while True:
    first = listener(0)
    port = first.getsockname()[1]
    try:
        second = listener(port + 1)
        break
    except (OSError, OverflowError):
        first.close()
with open(sys.argv[1] + ".part", "w") as file:
    file.write(str(port))
os.rename(sys.argv[1] + ".part", sys.argv[1])
for device, end in enumerate((first, second)):
    ticks = [json.loads(end.recv(4096)) for _ in range(20)]
    steps = {after["tick"] - before["tick"] for before, after in zip(ticks, ticks[1:])}
    assert steps == {10}, f"device {device}: every tenth of a thousand ticks a second, not {steps}"
    assert all(len(tick["joint_position"]) == 3 for tick in ticks), ticks[0]
print("20 ticks of each")
END
/usr/bin/python3 "$work/listen.py" "$work/port" >"$work/heard" 2>&1 &
listening=$!
for _ in {1..100}; do
  [[ -f "$work/port" ]] && break
  sleep 0.05
done

"$tactus" bake --quiet "$examples/grasp/scene.toml" -o "$work/grasp.tactus"
serve "$work/grasp.tactus" --device falcon --device falcon --path "$examples/grasp/thumb.csv" --path "$examples/grasp/finger.csv" \
  --udp-json "$(cat "$work/port")"
code=0
wait "$listening" || code=$?
cat "$work/heard"
stop_serving
[[ $code -eq 0 ]]

code=0
"$tactus" sim "$work/grasp.tactus" --udp-json 9870 2>"$work/refused" || code=$?
[[ $code -ne 0 ]]
grep -q -- '--serve' "$work/refused"
