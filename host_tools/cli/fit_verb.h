// `tactus fit`: the parameters of friction models from a measured record.
#pragma once

namespace CLI {
class App;
}

namespace tactus::host {

void add_fit_verb(CLI::App& app);

}  // namespace tactus::host
