// The checks of the doctor, each a look at one thing. Each adds what it found; none throws for what
// a machine may lack.
#pragma once

#include "host_tools/doctor/finding.h"
#include "host_tools/doctor/machine.h"
#include "host_tools/doctor/needs.h"

namespace tactus::host {

// kernel_checks.cpp: what the kernel is and how it keeps time.
void check_kernel(Machine& machine, Findings& findings);
void check_clock_source(Machine& machine, Findings& findings);
void check_real_time_throttling(Machine& machine, Findings& findings);

// user_checks.cpp: what the user may.
void check_real_time_priority(Machine& machine, Findings& findings);
void check_locked_memory(Machine& machine, Findings& findings);
void check_group(Machine& machine, Findings& findings);
void check_cpu_latency(Machine& machine, Findings& findings);

// processor_checks.cpp: what makes a processor late.
void check_isolated_processors(Machine& machine, Findings& findings);
void check_frequency_governor(Machine& machine, Findings& findings);
void check_huge_pages(Machine& machine, Findings& findings);
void check_compaction(Machine& machine, Findings& findings);
void check_swap(Machine& machine, Findings& findings);

// motor_checks.cpp: what stops a motor when the host dies. Looks at the device alone.
void check_motors(Machine& machine, const Needs& needs, Findings& findings);

// can_checks.cpp, board_checks.cpp: what devices hang on.
void check_can(Machine& machine, const Needs& needs, Findings& findings);
void check_falcon(Machine& machine, const Needs& needs, Findings& findings);
void check_serial_ports(Machine& machine, const Needs& needs, Findings& findings);
void check_gpio(Machine& machine, const Needs& needs, Findings& findings);

}  // namespace tactus::host
