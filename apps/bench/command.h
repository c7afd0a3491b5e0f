// copeel bench: all methods on the same scenes in the same run, speed against error, as a table, as JSON and as a page with plots.
#pragma once

namespace CLI {
class App;
}

namespace copeel::bench {

void addCommand(CLI::App& program);

}  // namespace copeel::bench
