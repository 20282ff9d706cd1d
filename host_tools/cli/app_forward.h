// Declares the App of CLI11 for the headers of the verbs. CLI11's own header takes two seconds to
// compile, so only .cpp files include it.
#pragma once

// The name is CLI11's. NOLINTNEXTLINE(readability-identifier-naming)
namespace CLI {
class App;
}
