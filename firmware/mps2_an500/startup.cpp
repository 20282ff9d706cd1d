// The start of the program: vector table, FPU, variables, memory protection, constructors, program.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "firmware/bare_metal/stop.h"
#include "firmware/mps2_an500/memory_map.h"
#include "firmware/mps2_an500/registers.h"
#include "hal/bare_metal/board.h"

extern "C" {
[[noreturn]] void reset_handler();
[[noreturn]] void start_program();
[[noreturn]] void run_program();  // in main.cpp
void fault_handler();
void tick_handler();
void receive_handler();
void send_handler();

// The compiler calls it where a function without a body is called.
[[noreturn]] void __cxa_pure_virtual();  // NOLINT(readability-identifier-naming)
}

namespace tactus::mps2_an500 {
namespace {

using Handler = void (*)();

// The vector table. What the program never asks for stops it.
constexpr std::size_t kProcessorVectors = 16;
constexpr std::size_t kBoardVectors = 32;
struct VectorTable {
  const void* stack;
  Handler reset;
  std::array<Handler, kProcessorVectors + kBoardVectors - 3> handlers;
  Handler last;
};
constexpr std::size_t kSysTickVector = 15;
// The interrupts 0 and 1 of the board are of UART0.
constexpr std::size_t kReceiveVector = kProcessorVectors + 0;
constexpr std::size_t kSendVector = kProcessorVectors + 1;

constexpr auto handlers() {
  std::array<Handler, kProcessorVectors + kBoardVectors - 3> all{};
  std::ranges::fill(all, fault_handler);
  all[kSysTickVector - 2] = tick_handler;
  all[kReceiveVector - 2] = receive_handler;
  all[kSendVector - 2] = send_handler;
  return all;
}

[[gnu::section(".vectors"), gnu::used]] const VectorTable kVectorTable{.stack = &handler_stack_end,
                                                                       .reset = reset_handler,
                                                                       .handlers = handlers(),
                                                                       .last = fault_handler};

// The attributes of MPU regions: access, execution, and the size as the exponent of a power of 2.
constexpr std::uint32_t kNever = 1U << 28U;  // is not executed
constexpr std::uint32_t kReadOnly = 6U << 24U;
constexpr std::uint32_t kReadWrite = 3U << 24U;
constexpr std::uint32_t kNoAccess = 0U << 24U;
constexpr std::uint32_t kNormalMemory = (1U << 19U) | (1U << 17U);

void protect(std::uint32_t number, const void* base, std::size_t bytes, std::uint32_t attributes) {
  const auto exponent = static_cast<std::uint32_t>(std::countr_zero(bytes)) - 1;
  reg(kMpuNumber) = number;
  reg(kMpuBase) = static_cast<std::uint32_t>(std::bit_cast<Address>(base));
  reg(kMpuAttributes) = attributes | kNormalMemory | (exponent << 1U) | 1U;
}

// A region with a higher number wins where two overlap.
void protect_memory() {
  reg(kHandlerControl) = kOwnHandlers;
  protect(0, &kVectorTable, kFlashBytes, kReadOnly);
  protect(1, &device_image_begin, kImagesBytes, kReadOnly | kNever);
  protect(2, &guard_begin, kRamBytes, kReadWrite | kNever);
  protect(3, &guard_begin, kGuardBytes, kNoAccess | kNever);
  reg(kMpuControl) = kMpuRuns;
  asm volatile("dsb\n isb" ::: "memory");
}

// Paints the stack below this function's own part of it.
void paint_stack() {
  std::uint32_t* const top = static_cast<std::uint32_t*>(__builtin_frame_address(0)) - 32;
  for (std::uint32_t* word = &stack_begin; word < top; ++word) {
    *static_cast<volatile std::uint32_t*>(word) = hal::kStackPaint;
  }
}

void fill_variables() {
  std::copy(&data_load, &data_load + (&data_end - &data_begin), &data_begin);
  std::fill(&bss_begin, &bss_end, 0);
}

void construct() {
  for (const Handler* constructor = &init_array_begin; constructor != &init_array_end;
       ++constructor) {
    (*constructor)();
  }
}

}  // namespace
}  // namespace tactus::mps2_an500

// The motors' power goes off; the FPU comes on, before the compiler uses it; the program gets a
// stack of its own, so that handlers have one when it overflows.
[[gnu::naked]] void reset_handler() {
  asm volatile(
      "movw r0, #0x8000\n"  // kLamps
      "movt r0, #0x4002\n"
      "movs r1, #0\n"
      "str r1, [r0]\n"
      "movw r0, #0xED88\n"  // CPACR: full access to the coprocessors 10 and 11
      "movt r0, #0xE000\n"
      "ldr r1, [r0]\n"
      "orr r1, r1, #0x00F00000\n"
      "str r1, [r0]\n"
      "dsb\n"
      "isb\n"
      "ldr r0, =stack_end\n"
      "msr psp, r0\n"
      "movs r0, #2\n"  // thread mode uses PSP
      "msr control, r0\n"
      "isb\n"
      "b start_program\n");
}

void start_program() {
  using namespace tactus::mps2_an500;  // NOLINT(google-build-using-namespace)
  paint_stack();
  fill_variables();
  protect_memory();
  construct();
  run_program();
}

void __cxa_pure_virtual() {
  tactus::firmware::stop(tactus::hal::StopCode::broken_invariant);
}

// The compiler calls it where nothing can be.
void abort() {
  tactus::firmware::stop(tactus::hal::StopCode::broken_invariant);
}
