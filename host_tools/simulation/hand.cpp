#include "host_tools/simulation/hand.h"

#include <numbers>
#include <utility>

#include "host_tools/simulation/random.h"
#include "rendering/geometry/portable_math.h"

namespace tactus::host {

std::optional<HandParameters> hand_preset(std::string_view name) {
  if (name == "finger") {
    return kFingerHand;
  }
  if (name == "pen") {
    return kPenHand;
  }
  if (name == "firm") {
    return kFirmHand;
  }
  return std::nullopt;
}

Tremor::Tremor(double amplitude_m, std::uint64_t seed, double tick_s)
    : component_m_(amplitude_m / static_cast<double>(kComponentsPerAxis)) {
  constexpr double kLowest_Hz = 8.0;
  constexpr double kHighest_Hz = 12.0;
  constexpr double kTurn = 2.0 * std::numbers::pi;
  SplitMix64 random(seed);
  for (Phasor& phasor : phasors_) {
    const rendering::SineCosine start = rendering::sine_cosine(random.uniform(0.0, kTurn));
    const rendering::SineCosine turn =
        rendering::sine_cosine(kTurn * random.uniform(kLowest_Hz, kHighest_Hz) * tick_s);
    phasor = {
        .cos = start.cosine, .sin = start.sine, .turn_cos = turn.cosine, .turn_sin = turn.sine};
  }
}

Vec3 Tremor::offset() const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < phasors_.size(); ++i) {
    sum[static_cast<int>(i % 3)] += phasors_[i].sin;
  }
  return component_m_ * sum;
}

void Tremor::advance() {
  for (Phasor& phasor : phasors_) {
    const double cosine = phasor.cos * phasor.turn_cos - phasor.sin * phasor.turn_sin;
    phasor.sin = phasor.sin * phasor.turn_cos + phasor.cos * phasor.turn_sin;
    phasor.cos = cosine;
  }
}

Hand::Hand(const HandParameters& parameters, WishPath path, std::uint64_t seed, double tick_s)
    : parameters_(parameters),
      path_(std::move(path)),
      tremor_(parameters.tremor_m, seed, tick_s),
      tick_s_(tick_s) {
  wish_W_ = path_.at(0.0) + tremor_.offset();
  tremor_.advance();
  next_wish_W_ = path_.at(tick_s_) + tremor_.offset();
}

void Hand::advance() {
  ++tick_;
  wish_W_ = next_wish_W_;
  tremor_.advance();
  next_wish_W_ = path_.at(static_cast<double>(tick_ + 1) * tick_s_) + tremor_.offset();
}

}  // namespace tactus::host
