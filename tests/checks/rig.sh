#!/usr/bin/env bash
# Drivers, emulators and the controller through a real kernel, in the emulated machine.
set -euo pipefail
exec tests/rig/run.sh
