// An array for each object that a controller has in static storage, of the same size, so that a
// build can read the sizes from the object file also where nothing can run. No program links it.
// toolchains/print_sizes.sh prints the names without the first two words.
#include <array>

#include "firmware/control/controller.h"
#include "firmware/limits.h"
#include "rendering/scene/scene_image.h"

namespace {

template <class Object>
using BytesOf = std::array<char, sizeof(Object)>;

}  // namespace

BytesOf<tactus::firmware::Controller> size_of_controller_with_one_device_and_tool;
BytesOf<tactus::rendering::World> size_of_world_in_it;
BytesOf<tactus::rendering::SceneObjects> size_of_objects_in_the_world;
BytesOf<tactus::rendering::WorldBodies> size_of_bodies_in_the_world;
BytesOf<tactus::rendering::ToolSlot> size_of_tool_in_the_world_and_each_further_one;
BytesOf<tactus::rendering::CandidateSet> size_of_candidates_of_a_tool;
BytesOf<tactus::rendering::DeformablePool> size_of_meshes_that_deform;
BytesOf<tactus::rendering::WavePool> size_of_waves_of_meshes_that_deform;
BytesOf<tactus::firmware::DeviceController> size_of_device_in_the_controller_and_each_further_one;
BytesOf<tactus::rendering::SceneImage> size_of_scene_image_without_its_bytes;
std::array<char, tactus::firmware::kMaxCheckpointBytes> size_of_checkpoint_of_one_device;
std::array<char, tactus::firmware::kMaxControllerBytes> size_of_bound_of_the_controller;
