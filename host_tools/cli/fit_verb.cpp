#include "host_tools/cli/fit_verb.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host_tools/cli/picture_option.h"
#include "host_tools/cli/progress_line.h"
#include "host_tools/files/atomic_file.h"
#include "host_tools/files/output_place.h"
#include "host_tools/friction/fit.h"
#include "host_tools/friction/fit_report.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

constexpr const char* kFitExamples =
    "The record has the columns t_s,x_m,force_N and may have v_m_per_s and normal_force_N. force_N "
    "is the friction, along the\n"
    "motion: what drives the motion, less mass times acceleration. With a normal force the "
    "parameters are per newton of it;\n"
    "without, they are forces in newtons, as of a joint.\n"
    "\n"
    "To tell sigma0 and sigma1 the motion must reverse, with rows while the force changes sides; "
    "to tell Fs and vs it must\n"
    "have speeds below, near and above vs; to tell sigma2, speeds at which it exceeds the noise. "
    "What the data cannot tell is\n"
    "said so, and left out of the file or 0 in it, with a comment. The AIC is n log(sum of squares "
    "/ n) + 2 (k + 1).\n"
    "\n"
    "Examples:\n"
    "  tactus fit stroke.csv                                      all models, and which the AIC "
    "prefers\n"
    "  tactus fit stroke.csv --normal-force-N 2 --output friction.toml\n"
    "                                                             [object.friction] of a scene, of "
    "the preferred model\n"
    "  tactus fit joint.csv --model lugre --joint --output friction.toml --figure fit.png\n"
    "  tactus fit stroke.csv --model stribeck --fit-alpha --json | jq .fits[0].parameters";

// The verb's options as the user gave them.
struct FitVerbOptions {
  std::string record;
  std::string model = "all";
  std::optional<double> normal_force_N;
  FitOptions fit;
  bool joint = false;
  std::string output;
  std::string figure;
  bool json = false;
};

std::vector<std::string_view> fitted_names() {
  std::vector<std::string_view> names;
  for (const rendering::FrictionKind kind : fitted_kinds()) {
    names.push_back(model_of(kind).name);
  }
  return names;
}

// Returns the models that --model names. Throws InputError for one that cannot be fitted.
std::vector<rendering::FrictionKind> kinds_to_fit(const std::string& model) {
  std::vector<rendering::FrictionKind> all = fitted_kinds();
  if (model == "all") {
    return all;
  }
  const rendering::FrictionKind kind = friction_kind(model);
  if (std::ranges::find(all, kind) != all.end()) {
    return {kind};
  }
  throw InputError(fmt::format("--model {}: fitted are {}, or all of them", model,
                               in_words(fitted_names(), "and")));
}

// A parameter that the data cannot tell has the value null and the reason.
nlohmann::ordered_json json_of(const FittedParameter& p, ForceScale scale) {
  nlohmann::ordered_json json{{"name", p.symbol},
                              {"unit", parameter_name(p.symbol).unit_of(scale)}};
  if (p.knowledge == Knowledge::unknown) {
    json["value"] = nullptr;
    json["unknown"] = p.why_unknown;
    return json;
  }
  json["value"] = p.value;
  if (p.knowledge == Knowledge::fitted) {
    json["low"] = p.low;
    json["high"] = p.high;
  }
  return json;
}

nlohmann::ordered_json json_of(const FrictionFit& fit, ForceScale scale) {
  auto parameters = nlohmann::ordered_json::array();
  for (const FittedParameter& p : fit.parameters) {
    parameters.push_back(json_of(p, scale));
  }
  return {{"model", model_of(fit.friction.kind).name},
          {"residual_N", fit.residual_N},
          {"aic", fit.aic},
          {"converged", fit.has_converged},
          {"parameters", parameters}};
}

void print_json(const FitVerbOptions& options, const FrictionRecord& record,
                std::span<const FrictionFit> fits) {
  const ForceScale scale = scale_of(record);
  auto all = nlohmann::ordered_json::array();
  for (const FrictionFit& fit : fits) {
    all.push_back(json_of(fit, scale));
  }
  const nlohmann::ordered_json json{
      {"record", options.record},
      {"rows", record.rows()},
      {"preferred", model_of(fits[preferred(fits)].friction.kind).name},
      {"fits", all}};
  fmt::print("{}\n", json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

void print_text(const FitVerbOptions& options, const FrictionRecord& record,
                std::span<const FrictionFit> fits) {
  fmt::print("{}", record_text(options.record, record));
  for (std::size_t i = 0; i < fits.size(); ++i) {
    fmt::print("{}", fit_text(fits[i], scale_of(record), fits.size() > 1 && i == preferred(fits)));
  }
}

void write_outputs(const FitVerbOptions& options, const FrictionRecord& record,
                   const FrictionFit& fit) {
  const std::string name = std::filesystem::path(options.record).filename().string();
  if (!options.output.empty()) {
    const std::string toml =
        fit_toml(name, fit, record, options.joint ? TomlUse::joint : TomlUse::surface);
    keep_images_safe(options.output);
    write_file_atomically(options.output, std::as_bytes(std::span(toml)));
  }
  if (!options.figure.empty()) {
    draw_fit(name, fit, record, options.figure);
  }
  if (!options.json) {
    for (const std::string& file : {options.output, options.figure}) {
      fmt::print("{}{}", file, file.empty() ? "" : "\n");
    }
  }
}

void run_fit(const FitVerbOptions& options) {
  keep_inputs_safe({options.output, options.figure}, {options.record});
  const std::vector<rendering::FrictionKind> kinds = kinds_to_fit(options.model);
  const FrictionRecord record = read_friction_record(options.record, options.normal_force_N);
  if (options.joint && record.has_normal_force) {
    throw InputError("--joint: a joint has no normal force, but one is given");
  }
  if (const std::string warning = record_warning(record); !warning.empty()) {
    fmt::print(stderr, "tactus fit: warning: {}: {}\n", options.record, warning);
  }
  std::vector<FrictionFit> fits;
  {
    std::optional<ProgressLine> progress;
    if (::isatty(STDERR_FILENO) == 1) {
      progress.emplace();
    }
    for (const rendering::FrictionKind kind : kinds) {
      if (progress) {
        progress->step(fmt::format("fitting {}", model_of(kind).name));
      }
      fits.push_back(fit_friction(record, kind, options.fit));
    }
  }
  options.json ? print_json(options, record, fits) : print_text(options, record, fits);
  write_outputs(options, record, fits[preferred(fits)]);
}

}  // namespace

void add_fit_verb(CLI::App& app) {
  CLI::App* verb =
      app.add_subcommand("fit", "Estimate the parameters of friction models from measurements");
  const auto options = std::make_shared<FitVerbOptions>();
  verb->add_option("record", options->record, "Measured motion and force (CSV)")->required();
  verb->add_option("--model", options->model,
                   fmt::format("{} or all", fmt::join(fitted_names(), ", ")))
      ->capture_default_str();
  verb->add_option("--normal-force-N", options->normal_force_N,
                   "The normal force during the record, instead of a column")
      ->check(CLI::PositiveNumber);
  verb->add_option("--alpha", options->fit.exponent, "The Stribeck exponent")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  verb->add_flag("--fit-alpha", options->fit.fits_exponent,
                 "Fit the Stribeck exponent too, from --alpha on");
  verb->add_flag("--joint", options->joint, "Write the table of a joint instead of a surface");
  verb->add_option("-o,--output", options->output,
                   "Write the friction of the model, or of the preferred one, to this TOML file");
  verb->add_option("--figure", options->figure,
                   "Draw measurement and fit into this .png, .svg or .pdf file")
      ->check(picture_complaint);
  verb->add_flag("--json", options->json, "Print what was found as one JSON object");
  verb->footer(kFitExamples);
  verb->callback([options] { run_fit(*options); });
}

}  // namespace tactus::host
