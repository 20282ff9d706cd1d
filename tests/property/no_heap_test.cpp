// The controller never touches the heap while it ticks.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <vector>

#include "firmware/control/controller.h"
#include "tests/support/heap_trap.h"
#include "tests/support/share.h"
#include "tests/support/solid.h"

namespace tactus::testing {
namespace {

TEST(HeapTrap, CatchesEveryWayToAllocate) {
  std::size_t calls = 0;
  {
    const HeapTrap trap;
    const auto one = std::make_unique<int>(1);
    EXPECT_EQ(trap.calls(), 1U) << "operator new";
    // NOLINTBEGIN(cppcoreguidelines-no-malloc,bugprone-suspicious-realloc-usage)
    void* volatile block = std::malloc(8);
    block = std::realloc(block, 4096);
    std::free(block);
    block = std::calloc(2, 8);
    std::free(block);
    block = std::aligned_alloc(64, 64);
    std::free(block);
    // NOLINTEND(cppcoreguidelines-no-malloc,bugprone-suspicious-realloc-usage)
    calls = trap.calls();
  }
  EXPECT_EQ(calls, 8U);
}

// A stroke over the sphere, deep enough to stay in contact.
drivers::JointSample stroke(int tick) {
  const double t = 0.001 * tick;
  const double phi = 2.0 * t;
  const double theta = 0.4 * std::sin(0.7 * t);
  const double r = 0.05 + 0.002 - 0.0015 + 0.001 * std::sin(11.0 * t);
  drivers::JointSample sample;
  sample.position = {r * std::cos(theta) * std::cos(phi), r * std::sin(theta),
                     r * std::cos(theta) * std::sin(phi)};
  return sample;
}

TEST(Controller, NeverUsesTheHeapInAHundredThousandTicksOfContact) {
  const int ticks = std::max(20'000, part_of(100'000));
  const Solid solid(bumpy_sphere(0.05, 4, 0.02), rendering::Sides::one,
                    {.stiffness_N_per_m = 1000.0,
                     .damping_Ns_per_m = 0.5,
                     .friction = rendering::cone_friction(0.6, 0.4)});
  static firmware::Controller controller;
  ASSERT_TRUE(controller.configure(firmware::cartesian_config()));
  ASSERT_TRUE(controller.load_scene({&solid.object(), 1}, {.tool_radius_m = 0.002}));
  drivers::JointSample away;
  away.position = {0.1, 0.0, 0.0};
  controller.tick(away, firmware::Request::home);
  controller.tick(away, firmware::Request::none);
  controller.tick(away, firmware::Request::enable);
  int contacts = 0;
  std::size_t calls = 0;
  {
    const HeapTrap trap;
    for (int tick = 0; tick < ticks; ++tick) {
      controller.tick(stroke(tick), firmware::Request::none);
      contacts += controller.record().contact != rendering::ContactKind::none ? 1 : 0;
    }
    calls = trap.calls();
  }
  EXPECT_EQ(calls, 0U);
  EXPECT_EQ(controller.mode(), firmware::Mode::active);
  EXPECT_GT(contacts, ticks / 2);
}

TEST(World, NeverUsesTheHeapForShadingTexturesAndEffects) {
  const Solid solid(bumpy_sphere(0.05, 3, 0.02), rendering::Sides::one,
                    {.stiffness_N_per_m = 1000.0, .friction = rendering::cone_friction(0.6, 0.4)});
  const rendering::MeshView& mesh = solid.object().mesh;
  std::vector<rendering::CornerNormals> corners;
  for (const rendering::TriangleIndices& triangle : mesh.triangles) {
    auto& normals = corners.emplace_back();
    for (std::size_t k = 0; k < normals.size(); ++k) {
      normals[k] = rendering::encode(to_vec3(mesh.vertices[triangle[k]]).normalized());
    }
  }
  // Two texels by two, and the coarser level of one.
  const std::array<std::uint8_t, 5> texels{0, 255, 255, 0, 128};
  const rendering::TextureLayer bump{
      .use = rendering::TextureUse::bump, .width = 2, .height = 2, .tile_m = 0.004, .high = 1e-4};
  rendering::Object object = solid.object();
  object.detail = {.corner_normals = corners, .layers = {&bump, 1}, .texels = texels};
  const rendering::Effect spring{.law = rendering::Spring{.stiffness_N_per_m = 5.0},
                                 .max_force_N = 1.0};
  const auto world = std::make_unique<rendering::World>();
  ASSERT_TRUE(world->set_scene({&object, 1}, {.tool_radius_m = 0.002, .effects = {&spring, 1}}));
  world->touch({.p_W = {0.1, 0.0, 0.0}});
  int contacts = 0;
  std::size_t calls = 0;
  {
    const HeapTrap trap;
    for (int tick = 0; tick < 20'000; ++tick) {
      const drivers::JointSample at = stroke(tick);
      const rendering::Touch touch =
          world->touch({.p_W = {at.position[0], at.position[1], at.position[2]}});
      contacts += touch.contact != rendering::ContactKind::none ? 1 : 0;
    }
    calls = trap.calls();
  }
  EXPECT_EQ(calls, 0U);
  EXPECT_GT(contacts, 10'000);
}

TEST(World, NeverUsesTheHeapByTheTextbooksMethods) {
  using rendering::ContactMethod;
  using rendering::Opcode;
  // On a ball, since one_plane loses a solid at its first concave edge.
  const Solid solid(icosphere(0.05, 3), rendering::Sides::one,
                    {.stiffness_N_per_m = 1000.0, .friction = rendering::cone_friction(0.6, 0.4)});
  // x^2 + y^2 + z^2 - 1, in units of 5 cm.
  const std::array<rendering::Instruction, 9> formula{
      {{.opcode = Opcode::x},
       {.opcode = Opcode::y},
       {.opcode = Opcode::z},
       {.opcode = Opcode::power, .a = 0, .exponent = 2},
       {.opcode = Opcode::power, .a = 1, .exponent = 2},
       {.opcode = Opcode::power, .a = 2, .exponent = 2},
       {.opcode = Opcode::add, .a = 3, .b = 4},
       {.opcode = Opcode::add, .a = 5, .b = 6},
       {.opcode = Opcode::offset, .a = 7, .constant = -1.0}}};
  for (const ContactMethod method :
       {ContactMethod::one_plane, ContactMethod::three_sub_goals, ContactMethod::three_step,
        ContactMethod::one_step, ContactMethod::plain_tracking}) {
    rendering::Object object = solid.object();
    object.method = method;
    if (method == ContactMethod::plain_tracking) {
      object.surface = rendering::SurfaceKind::implicit;
      object.implicit.formula = {.instructions = formula};
      object.implicit.bounds_O = {.lower = Vec3::Constant(-2.0), .upper = Vec3::Constant(2.0)};
      object.implicit.scale_m = 0.05;
      object.material.friction = {};
    }
    const auto world = std::make_unique<rendering::World>();
    ASSERT_TRUE(world->set_scene({&object, 1}, {.tool_radius_m = 0.002}));
    world->touch({.p_W = {0.1, 0.0, 0.0}});
    int contacts = 0;
    std::size_t calls = 0;
    {
      const HeapTrap trap;
      for (int tick = 0; tick < 5'000; ++tick) {
        const drivers::JointSample at = stroke(tick);
        const Vec3 tool = 0.96 * Vec3{at.position[0], at.position[1], at.position[2]};
        contacts += world->touch({.p_W = tool}).contact != rendering::ContactKind::none ? 1 : 0;
      }
      calls = trap.calls();
    }
    EXPECT_EQ(calls, 0U);
    EXPECT_GT(contacts, 2'500) << static_cast<int>(method);
  }
}

}  // namespace
}  // namespace tactus::testing
