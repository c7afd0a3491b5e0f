// Options that may be given several times.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace copeel {

// A repeatable option that takes one value each time and leaves the file after it alone.
template <class Take>
void addRepeatable(CLI::App& command, const std::string& name, const std::string& valueName, const std::string& help, Take take) {
  command
      .add_option_function<std::vector<std::string>>(
          name, [take](const std::vector<std::string>& values) { for (const std::string& value : values) take(value); }, help)
      ->type_name(valueName)
      ->allow_extra_args(false);
}

}  // namespace copeel
