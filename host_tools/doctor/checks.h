// The checks of `tactus doctor`. Each looks at one property of the machine through `Machine` and
// appends its findings. A file or program that a machine lacks is a finding, not an error: no check
// throws for it. doctor.cpp calls them in the order of importance.
#pragma once

#include "host_tools/doctor/finding.h"
#include "host_tools/doctor/machine.h"
#include "host_tools/doctor/needs.h"

namespace tactus::host {

// kernel_checks.cpp: the kernel and its clock.
//
// Reports whether the kernel is PREEMPT_RT; without it a tick may be milliseconds late.
void check_kernel(Machine& machine, Findings& findings);
// Reports whether the time is read from a register of the processor and not from a slow device.
void check_clock_source(Machine& machine, Findings& findings);
// Reports whether real-time threads may use at least 90 % of a processor.
void check_real_time_throttling(Machine& machine, Findings& findings);

// user_checks.cpp: what this login may do.
//
// Reports whether the login may take priority 80, which tactusd uses by default.
void check_real_time_priority(Machine& machine, Findings& findings);
// Reports whether the login may lock 256 MiB of memory.
void check_locked_memory(Machine& machine, Findings& findings);
// Reports whether the login is in the group tactus, which may use devices and tactusd's sockets.
void check_group(Machine& machine, Findings& findings);
// Reports whether the login may keep processors awake through /dev/cpu_dma_latency.
void check_cpu_latency(Machine& machine, Findings& findings);

// processor_checks.cpp: settings that make a processor late.
//
// Advises to isolate the last processor if none is isolated.
void check_isolated_processors(Machine& machine, Findings& findings);
// Reports processors whose clock is not kept at its highest frequency.
void check_frequency_governor(Machine& machine, Findings& findings);
// Advises against huge pages for every process: the kernel stops a process to put pages together.
void check_huge_pages(Machine& machine, Findings& findings);
// Advises against compaction that moves locked memory.
void check_compaction(Machine& machine, Findings& findings);
// Advises against swap.
void check_swap(Machine& machine, Findings& findings);

// power_checks.cpp: the board's supply.
//
// Reports a low voltage, where the board measures it.
void check_power(Machine& machine, Findings& findings);

// tick_checks.cpp: the time of a tick.
//
// Reports whether this processor carries out the instructions that a tick may take within the
// tick's period.
void check_tick_budget(Machine& machine, const Needs& needs, Findings& findings);

// motor_checks.cpp: the means that take a motor's torque away when the host dies.
//
// Judges the device's configuration and does not look at the machine.
void check_motors(Machine& machine, const Needs& needs, Findings& findings);

// can_checks.cpp: the CAN interfaces.
//
// Reports whether the interfaces that the device needs are present, of type CAN, up, with a bit
// rate and without errors, and how busy the device's frames keep them. Without a named device it
// looks at all that are there.
void check_can(Machine& machine, const Needs& needs, Findings& findings);
// can_controller_checks.cpp: the controllers behind them.
//
// Reports controllers that delay an answer, sample data bits too coarsely, are read too slowly over
// SPI, or keep too few frames.
void check_can_controllers(Machine& machine, const Needs& needs, Findings& findings);
// board_checks.cpp: the other connections: present and open to this user. Without a named device
// they look at everything that is plugged in.
//
// Reports whether the Falcon is on USB and this user may open it.
void check_falcon(Machine& machine, const Needs& needs, Findings& findings);
// Reports whether the serial ports of the device may be opened; without a device, all of type
// ttyACM.
void check_serial_ports(Machine& machine, const Needs& needs, Findings& findings);
// Reports whether the GPIO chips, the PWM outputs and the counters that the device needs are there
// and may be opened.
void check_gpio(Machine& machine, const Needs& needs, Findings& findings);

}  // namespace tactus::host
