// The time of a cost unit (rendering/tick_budget.h) on this machine. `tactus doctor` compares what
// a tick may spend with the tick's period. Not real time.
#pragma once

namespace tactus::host {

// Returns the mean time of a cost unit, ns, over the strokes of a tool on a ball of 20,480
// triangles, each tick at its fastest of a few runs. Takes a fraction of a second.
double measured_unit_cost_ns();

}  // namespace tactus::host
