// The registers of the board and of its processor that the program uses: the MPS2 with the FPGA
// image AN500 (Arm DAI 0500), and the ARMv7-M architecture (Arm DDI 0403, chapter B3).
#pragma once

#include <bit>
#include <cstdint>

namespace tactus::mps2_an500 {

using Address = std::uintptr_t;

// Returns the register at an address.
inline volatile std::uint32_t& reg(Address address) {
  return *std::bit_cast<volatile std::uint32_t*>(address);
}

// FPGAIO: bit 0 is the first lamp, which stands for the motors' power.
inline constexpr Address kLamps = 0x4002'8000;
inline constexpr std::uint32_t kMotorLamp = 1;

// UART0 (CMSDK APB UART).
inline constexpr Address kUartData = 0x4000'4000;
inline constexpr Address kUartState = 0x4000'4004;
inline constexpr std::uint32_t kUartIsFull = 1;
inline constexpr std::uint32_t kUartHasReceived = 2;
inline constexpr std::uint32_t kUartHasLost = 8;  // cleared by a 1
inline constexpr Address kUartControl = 0x4000'4008;
inline constexpr std::uint32_t kUartRuns = 15;  // sends and receives, with an interrupt for each
inline constexpr Address kUartInterrupts = 0x4000'400C;  // cleared by a 1
inline constexpr std::uint32_t kUartSent = 1;
inline constexpr std::uint32_t kUartReceived = 2;
inline constexpr Address kUartDivider = 0x4000'4010;
inline constexpr std::uint32_t kUartBaud = 115'200;

// NVIC: the interrupts of the UART, by their bits.
inline constexpr Address kInterruptEnable = 0xE000'E100;
inline constexpr std::uint32_t kUartReceives = 1U << 0U;
inline constexpr std::uint32_t kUartSends = 1U << 1U;

// Watchdog (CMSDK APB watchdog): its first end raises the interrupt that cannot be masked, the
// second resets the board.
inline constexpr Address kWatchdogLoad = 0x4000'8000;
inline constexpr Address kWatchdogControl = 0x4000'8008;
inline constexpr std::uint32_t kWatchdogInterrupts = 1;
inline constexpr std::uint32_t kWatchdogResets = 2;
inline constexpr Address kWatchdogClear = 0x4000'800C;
inline constexpr Address kWatchdogLock = 0x4000'8C00;
inline constexpr std::uint32_t kWatchdogKey = 0x1ACC'E551;

// SysTick.
inline constexpr Address kTickControl = 0xE000'E010;
inline constexpr std::uint32_t kTickRuns =
    7;  // enabled, with its interrupt, at the processor's clock
inline constexpr Address kTickReload = 0xE000'E014;
inline constexpr Address kTickValue = 0xE000'E018;

// System control: which faults have handlers of their own, and what a fault was.
inline constexpr Address kHandlerControl = 0xE000'ED24;
inline constexpr std::uint32_t kOwnHandlers = 7U << 16U;  // MemManage, BusFault, UsageFault
inline constexpr Address kFaultStatus = 0xE000'ED28;
inline constexpr std::uint32_t kStackingRefused = 1U
                                                  << 4U;  // by the MPU, while a handler is entered
inline constexpr std::uint32_t kAddressIsValid = 1U << 7U;
inline constexpr Address kFaultAddress = 0xE000'ED34;

// MPU (PMSAv7).
inline constexpr Address kMpuControl = 0xE000'ED94;
inline constexpr std::uint32_t kMpuRuns =
    5;  // enabled; outside of the regions the default map holds
inline constexpr Address kMpuNumber = 0xE000'ED98;
inline constexpr Address kMpuBase = 0xE000'ED9C;
inline constexpr Address kMpuAttributes = 0xE000'EDA0;

// The clock of the processor and of all timers here.
inline constexpr std::uint32_t kClock_Hz = 25'000'000;

}  // namespace tactus::mps2_an500
