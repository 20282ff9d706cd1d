// A controller that restores another's state goes on to the same bits, over every example scene
// that needs no foreign file: what only baking makes, such as textures, shading and formulas.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "host_tools/bake/scene/bake.h"
#include "host_tools/bake/scene/mapped_scene.h"
#include "rendering/scene/scene_world.h"
#include "tests/replay/restore_check.h"
#include "tests/support/example_scenes.h"
#include "tests/support/folder_test.h"
#include "tests/support/paths.h"
#include "tests/support/share.h"

namespace tactus::testing {
namespace {

using RestoreOfExamples = FolderTest;

TEST_F(RestoreOfExamples, GoesOnAlike) {
  constexpr std::size_t kTicksAnExample = 4'000;
  constexpr std::size_t kLeastTicksAnExample = 1'500;  // with fewer some tools never touch anything
  const std::filesystem::path examples = in_repository("host_tools/examples");
  std::uint64_t seed = 800;
  for (const char* name : kExampleScenes) {
    SCOPED_TRACE(name);
    const std::string image = file(std::string(name) + ".tactus");
    host::bake_file(examples / name / "scene.toml", image);
    const host::MappedScene scene(image);
    RestoreTally tally;
    ASSERT_NO_FATAL_FAILURE(expect_restores_go_on_alike(
        {.objects = scene.image().objects(), .world = rendering::world_of(scene.image())}, seed++,
        std::max(kLeastTicksAnExample, share_of(kTicksAnExample)), tally));
    std::printf("%s: %zu restores, %zu of %zu ticks in contact; %zu bytes at most\n", name,
                tally.restores, tally.contacts, tally.ticks, tally.most_bytes);
    EXPECT_GT(tally.contacts, 0U);
  }
}

}  // namespace
}  // namespace tactus::testing
