// The objects that a controller under Linux has beside those of controller_sizes.cpp.
#include <array>

#include "firmware/linux/commands/scene_store.h"
#include "firmware/linux/flight/flight_recorder.h"

std::array<char, sizeof(tactus::firmware::FlightRecorder)> size_of_flight_recorder;
std::array<char, sizeof(tactus::firmware::SceneStore)> size_of_scene_store_of_tactusd;
