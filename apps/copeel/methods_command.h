// copeel methods: which ways of ordering fragments this version has.
#pragma once

namespace CLI {
class App;
}

namespace copeel {

void addMethodsCommand(CLI::App& program);

}  // namespace copeel
