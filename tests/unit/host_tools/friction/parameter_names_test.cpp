#include "host_tools/friction/parameter_names.h"

#include <gtest/gtest.h>

#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using rendering::FrictionKind;
using rendering::FrictionParameters;
using testing::contains;
using testing::input_error;

TEST(FrictionNames, EveryKindHasItsNameAndValidDefaults) {
  for (const rendering::FrictionModelTraits& name : rendering::kFrictionModels) {
    EXPECT_EQ(friction_kind(name.name), name.kind);
    EXPECT_EQ(model_of(name.kind).name, name.name);
    const FrictionParameters defaults = published_parameters(name.kind);
    EXPECT_TRUE(rendering::valid(defaults)) << name.name;
    check_parameters(defaults, ForceScale::newton);
  }
  EXPECT_EQ(friction_kind("elasto-plastic"), FrictionKind::elasto_plastic);
  EXPECT_TRUE(contains(input_error([] { friction_kind("lugree"); }),
                       "there is no friction model 'lugree'; there are cone, coulomb"));
}

TEST(FrictionNames, DefaultsAreTableIOfTheLugrePaper) {
  const FrictionParameters p = published_parameters(FrictionKind::lugre);
  EXPECT_EQ(p.stiffness_N_per_m, 1e5);
  EXPECT_NEAR(p.damping_s_per_m, 316.228, 1e-3);
  EXPECT_EQ(p.viscous_s_per_m, 0.4);
  EXPECT_EQ(p.coulomb, 1.0);
  EXPECT_EQ(p.static_level, 1.5);
  EXPECT_EQ(p.stribeck_velocity_m_per_s, 1e-3);
  EXPECT_EQ(p.stribeck_exponent, 2.0);
}

TEST(FrictionNames, ParametersAreSetByTheirPapersNames) {
  FrictionParameters p = published_parameters(FrictionKind::elasto_plastic);
  for (const FrictionParameterName& name : parameters_of(p.kind)) {
    set_parameter(p, std::string(name.symbol) + "=0.25", ForceScale::newton);
    EXPECT_EQ(p.*name.member, 0.25) << name.symbol;
  }
}

TEST(FrictionNames, KeysOfTomlSayTheirUnits) {
  EXPECT_EQ(parameter_name("sigma0").key_of(ForceScale::per_newton), "stiffness_N_per_m");
  EXPECT_EQ(parameter_name("sigma1").key_of(ForceScale::per_newton), "damping_s_per_m");
  EXPECT_EQ(parameter_name("sigma1").key_of(ForceScale::newton), "damping_Ns_per_m");
  EXPECT_EQ(parameter_name("Fs").key_of(ForceScale::per_newton), "static");
}

TEST(FrictionNames, WhatIsWrongIsSaidWithTheUnit) {
  FrictionParameters dahl = published_parameters(FrictionKind::dahl);
  const auto complaint = [&dahl](const char* text, ForceScale scale = ForceScale::newton) {
    return input_error([&] { set_parameter(dahl, text, scale); });
  };
  EXPECT_EQ(complaint("vs=1"),
            "--param vs: model dahl has no such parameter; it has Fc (N), sigma2 (N s/m), sigma0 "
            "(N/m)");
  EXPECT_TRUE(contains(complaint("vs=1", ForceScale::per_newton), "Fc (N/N), sigma2 (s/m)"));
  EXPECT_EQ(complaint("sigma0=stiff"),
            "--param sigma0=stiff: 'stiff' is not a finite number; sigma0 is in N/m");
  EXPECT_TRUE(contains(complaint("sigma0=1e5N/m"), "'1e5N/m' is not a finite number"));
  EXPECT_TRUE(contains(complaint("sigma0=inf"), "'inf' is not a finite number"));
  EXPECT_EQ(complaint("Fc=-1"), "--param Fc=-1: Fc must be 0 or more N");
  EXPECT_EQ(complaint("Fc"), "--param Fc: write NAME=VALUE, like --param sigma0=1e5");
}

TEST(FrictionNames, WhatDoesNotGoTogetherIsRefused) {
  FrictionParameters p = published_parameters(FrictionKind::lugre);
  p.static_level = 0.5;
  EXPECT_TRUE(contains(input_error([&] { check_parameters(p, ForceScale::newton); }),
                       "Fs is 0.5 N and Fc is 1 N"));
  p = published_parameters(FrictionKind::lugre);
  p.stiffness_N_per_m = 0.0;
  EXPECT_TRUE(contains(input_error([&] { check_parameters(p, ForceScale::newton); }),
                       "model lugre needs a sigma0 above 0 N/m"));
}

TEST(FrictionNames, HelpNamesEveryParameterAndUnit) {
  const std::string help = parameter_help();
  for (const FrictionParameterName& name : friction_parameter_names()) {
    EXPECT_TRUE(contains(help, name.symbol));
    EXPECT_TRUE(contains(help, name.unit));
    EXPECT_TRUE(contains(help, name.surface_unit));
  }
}

}  // namespace
}  // namespace tactus::host
