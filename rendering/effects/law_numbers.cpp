#include "rendering/effects/law_numbers.h"

#include <algorithm>

#include "rendering/effects/law_checks.h"

namespace tactus::rendering {
namespace {

// Visits the fields of a law and hands each of their numbers to `take`, which reads or changes it.
template <class Take>
class EachNumber {
 public:
  explicit EachNumber(const Take& take) : take_(take) {}

  void operator()(const NumberField& /*field*/, double& value) const { take_(value); }
  void operator()(const VectorField& /*field*/, Vec3& value) const {
    std::ranges::for_each(value, take_);
  }
  void operator()(const VolumeField& /*field*/, Primitive& volume) const {
    constexpr double kNoKind = 255.0;
    auto kind = static_cast<double>(volume.kind);
    take_(kind);
    volume.kind = static_cast<PrimitiveKind>(kind >= 0.0 && kind < kNoKind ? kind : kNoKind);
    std::ranges::for_each(volume.X_WO.rotation.reshaped(), take_);  // column by column
    std::ranges::for_each(volume.X_WO.translation, take_);
    std::ranges::for_each(volume.dimensions_m, take_);
  }

 private:
  const Take& take_;
};

}  // namespace

std::string_view name_of(const EffectLaw& law) {
  return visit_alternative(law, []<class Law>(const Law& /*law*/) { return Law::kName; });
}

LawNumbers numbers_of(const EffectLaw& law) {
  LawNumbers numbers;
  visit_alternative(law, [&]<class Law>(const Law& one) {
    Law copy = one;
    const auto put = [&](double value) {
      if (numbers.count < kMostLawNumbers) {
        numbers.values[numbers.count++] = value;
      }
    };
    EachNumber each(put);
    Law::visit_fields(copy, each);
  });
  return numbers;
}

std::optional<EffectLaw> law_of(std::string_view name, std::span<const double> numbers) {
  const auto place = std::ranges::find(kEffectLawNames, name) - kEffectLawNames.begin();
  return visit_number(EffectLaws{}, static_cast<std::size_t>(place),
                      [&]<class Law>(std::type_identity<Law> /*law*/) -> std::optional<EffectLaw> {
                        Law law;
                        std::size_t taken = 0;
                        const auto take = [&](double& value) {
                          value = taken < numbers.size() ? numbers[taken] : value;
                          ++taken;
                        };
                        EachNumber each(take);
                        Law::visit_fields(law, each);
                        return taken == numbers.size() && valid_law(law)
                                   ? std::optional<EffectLaw>(law)
                                   : std::nullopt;
                      });
}

}  // namespace tactus::rendering
