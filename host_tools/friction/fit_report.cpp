#include "host_tools/friction/fit_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "host_tools/plot/panels.h"

namespace tactus::host {
namespace {

std::string interval(const FittedParameter& p) {
  return fmt::format("{:.4g} to {:.4g}", p.low, p.high);
}

bool can_be_zero(std::string_view symbol) {
  return symbol == "sigma1" || symbol == "sigma2" || symbol == "Fs";
}

// For a surface the parameters are shares; without a normal force in the record they count as if it
// were 1 N.
ForceScale scale_of(TomlUse use) {
  return use == TomlUse::surface ? ForceScale::per_newton : ForceScale::newton;
}

std::string toml_line(const FittedParameter& p, TomlUse use) {
  const FrictionParameterName& name = parameter_name(p.symbol);
  const std::string_view key = name.key_of(scale_of(use));
  const std::string_view unit = name.unit_of(scale_of(use));
  if (p.knowledge == Knowledge::fitted) {
    return fmt::format("{} = {:.6g}  # {} {}\n", key, p.value, interval(p), unit);
  }
  if (p.knowledge == Knowledge::held) {
    return fmt::format("{} = {:.6g}  # held, not fitted\n", key, p.value);
  }
  if (can_be_zero(p.symbol)) {
    return fmt::format("{} = {:.6g}  # the data cannot tell: {}\n", key, p.value, p.why_unknown);
  }
  return fmt::format("# {} is left out, the data cannot tell it: {}\n", key, p.why_unknown);
}

Curve points(std::string name, std::vector<double> x, const std::vector<double>& y,
             CurveStyle style) {
  return {.name = std::move(name), .x = std::move(x), .y = y, .style = style};
}

}  // namespace

ForceScale scale_of(const FrictionRecord& record) {
  return record.has_normal_force ? ForceScale::per_newton : ForceScale::newton;
}

std::string record_text(const std::string& name, const FrictionRecord& record) {
  const RecordTraits traits = traits_of(record);
  return fmt::format(
      "{}: {} rows, {:.4g} s, {} reversals, speeds from {:.2g} to {:.2g} m/s, {} rows in "
      "presliding; displacements from {}\n",
      name, record.rows(), record.t_s.back() - record.t_s.front(), traits.reversals,
      traits.slowest_m_per_s, traits.fastest_m_per_s, traits.presliding_rows,
      record.uses_velocity ? "v_m_per_s, which is smoother than x_m" : "x_m");
}

std::string record_warning(const FrictionRecord& record) {
  return traits_of(record).is_rough
             ? "the velocity jumps from row to row by half of its size; smooth x_m, record it more "
               "slowly, or give a filtered v_m_per_s"
             : "";
}

std::string fit_text(const FrictionFit& fit, ForceScale scale, bool is_preferred) {
  std::string text =
      fmt::format("\n{}: residual {:.4g} N rms, AIC {:.1f}{}{}\n", model_of(fit.friction.kind).name,
                  fit.residual_N, fit.aic, is_preferred ? ", which the AIC prefers" : "",
                  fit.has_converged ? "" : "; the search did not end");
  for (const FittedParameter& p : fit.parameters) {
    const std::string_view unit = parameter_name(p.symbol).unit_of(scale);
    if (p.knowledge == Knowledge::fitted) {
      text +=
          fmt::format("  {:<7}{:<11.5g} {:<6} 95 %: {}\n", p.symbol, p.value, unit, interval(p));
    } else if (p.knowledge == Knowledge::held) {
      text += fmt::format("  {:<7}{:<11.5g} {:<6} held\n", p.symbol, p.value, unit);
    } else {
      text += fmt::format("  {:<7}the data cannot tell: {}\n", p.symbol, p.why_unknown);
    }
  }
  return text;
}

std::string fit_toml(const std::string& name, const FrictionFit& fit, const FrictionRecord& record,
                     TomlUse use) {
  std::string text = fmt::format(
      "# tactus fit {}: {} rows; residual {:.4g} N rms, AIC {:.1f}. Behind each value stands its "
      "interval of 95 %.\n",
      name, record.rows(), fit.residual_N, fit.aic);
  if (use == TomlUse::surface && !record.has_normal_force) {
    text +=
        "# No normal force was given: these are forces in newtons, coefficients for 1 N of it.\n";
  }
  text += use == TomlUse::surface ? "[object.friction]\n" : "[joint.friction]\n";
  text += fmt::format("model = \"{}\"\n", model_of(fit.friction.kind).name);
  for (const FittedParameter& p : fit.parameters) {
    text += toml_line(p, use);
  }
  return text;
}

void draw_fit(const std::string& name, const FrictionFit& fit, const FrictionRecord& record,
              const std::filesystem::path& picture) {
  constexpr double kMicrometre = 1e6;
  constexpr double kMillimetre = 1e3;
  // Shorter motions are drawn in micrometres.
  constexpr double kShort_m = 0.5e-3;
  const auto [low, high] = std::ranges::minmax(record.x_m);
  const bool is_short = high - low < kShort_m;
  std::vector<double> place;
  std::vector<double> velocity;
  for (std::size_t k = 0; k < record.rows(); ++k) {
    place.push_back((is_short ? kMicrometre : kMillimetre) * record.x_m[k]);
    velocity.push_back(k == 0 ? 0.0 : kMillimetre * record.displacement_m[k] / record.step_s[k]);
  }
  const auto panel = [&](std::string label, const std::vector<double>& x, CurveStyle style) {
    return Panel{.x_label = std::move(label),
                 .y_label = "friction force (N)",
                 .curves = {points("measured", x, record.force_N, CurveStyle::faint_points),
                            points("fitted", x, fit.force_N, style)}};
  };
  const std::array panels{
      panel("time (s)", record.t_s, CurveStyle::line),
      panel(is_short ? "displacement (µm)" : "displacement (mm)", place, CurveStyle::line),
      panel("velocity (mm/s)", velocity, CurveStyle::points)};
  draw_panels(fmt::format("{}, {} model", name, model_of(fit.friction.kind).title), panels,
              picture);
}

}  // namespace tactus::host
