#include "rendering/surface/interval.h"

#include <cstdint>

namespace tactus::rendering {
namespace {

constexpr double kUlp = 0x1p-52;
constexpr double kSmallest = std::numeric_limits<double>::min();
constexpr std::int64_t kAllButTheSign = 0x7fff'ffff'ffff'ffff;

}  // namespace

constinit const OneRounding kOneRounding{
    .ulp = both(kUlp), .smallest = both(kSmallest), .magnitude = {kAllButTheSign, kAllButTheSign}};

}  // namespace tactus::rendering
