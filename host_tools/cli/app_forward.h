// Declares the App of CLI11, whose own header takes two seconds to compile; only .cpp files include
// it.
#pragma once

// The name is CLI11's. NOLINTNEXTLINE(readability-identifier-naming)
namespace CLI {
class App;
}
