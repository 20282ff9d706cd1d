// The checks of `tactus doctor`. Each looks at one property of the machine through `Machine` and
// appends its findings. A file or program that a machine lacks is a finding, not an error: no check
// throws for it. doctor.cpp calls them in the order of importance.
#pragma once

#include "host_tools/doctor/finding.h"
#include "host_tools/doctor/machine.h"
#include "host_tools/doctor/needs.h"

namespace tactus::host {

// kernel_checks.cpp: whether the kernel has PREEMPT_RT, reads its clock fast, and lets real-time
// threads use a processor.
void check_kernel(Machine& machine, Findings& findings);
void check_clock_source(Machine& machine, Findings& findings);
void check_real_time_throttling(Machine& machine, Findings& findings);

// user_checks.cpp: what this login may do: real-time priority, locked memory, the group tactus,
// keeping processors awake.
void check_real_time_priority(Machine& machine, Findings& findings);
void check_locked_memory(Machine& machine, Findings& findings);
void check_group(Machine& machine, Findings& findings);
void check_cpu_latency(Machine& machine, Findings& findings);

// processor_checks.cpp: settings that make a processor late: other programs on the loop's
// processor, the clock frequency, huge pages, moved pages, swap.
void check_isolated_processors(Machine& machine, Findings& findings);
void check_frequency_governor(Machine& machine, Findings& findings);
void check_huge_pages(Machine& machine, Findings& findings);
void check_compaction(Machine& machine, Findings& findings);
void check_swap(Machine& machine, Findings& findings);

// motor_checks.cpp: what takes a motor's torque away when the host dies. It judges the device's
// configuration and does not look at the machine.
void check_motors(Machine& machine, const Needs& needs, Findings& findings);

// can_checks.cpp and board_checks.cpp: the interfaces that the device is connected to: present, up
// and open to this user. Without a named device they look at everything that is plugged in.
void check_can(Machine& machine, const Needs& needs, Findings& findings);
void check_falcon(Machine& machine, const Needs& needs, Findings& findings);
void check_serial_ports(Machine& machine, const Needs& needs, Findings& findings);
void check_gpio(Machine& machine, const Needs& needs, Findings& findings);

}  // namespace tactus::host
