// The places that mps2_an500.ld defines, and the sizes that the MPU needs as numbers.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/bare_metal/stop_code.h"

namespace tactus::mps2_an500 {

inline constexpr std::size_t kFlashBytes = std::size_t{512} << 10U;
inline constexpr std::size_t kImagesBytes = std::size_t{1} << 20U;
inline constexpr std::size_t kRamBytes = std::size_t{256} << 10U;
inline constexpr std::size_t kGuardBytes = std::size_t{1} << 10U;

}  // namespace tactus::mps2_an500

extern "C" {
extern std::byte device_image_begin;
extern std::byte device_image_end;
extern std::byte scene_image_begin;
extern std::byte scene_image_end;
extern std::byte guard_begin;
extern std::uint32_t stack_begin;
extern std::uint32_t stack_end;
extern std::uint32_t handler_stack_end;
extern tactus::hal::LatchedStop latched_stop;
extern std::uint32_t data_load;
extern std::uint32_t data_begin;
extern std::uint32_t data_end;
extern std::uint32_t bss_begin;
extern std::uint32_t bss_end;
extern void (*init_array_begin)();
extern void (*init_array_end)();
}
