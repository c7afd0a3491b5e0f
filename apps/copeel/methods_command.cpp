#include "apps/copeel/methods_command.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace copeel {
namespace {

struct Row {
  std::string name, backend, summary;
};

std::vector<Row> rows() {
  return {{"tile", "cpu", "every fragment of a screen tile, sorted there; exact order"},
          {"zbuffer", "cpu", "the nearest fragment only, for comparison; knows no CSG"}};
}

void printTable() {
  fmt::print("{:<12} {:<8} {}\n", "method", "backend", "what it does");
  for (const Row& row : rows()) fmt::print("{:<12} {:<8} {}\n", row.name, row.backend, row.summary);
}

void printJson() {
  nlohmann::json list = nlohmann::json::array();
  for (const Row& row : rows()) list.push_back({{"name", row.name}, {"backend", row.backend}, {"summary", row.summary}});
  fmt::print("{}\n", list.dump(2));
}

}  // namespace

void addMethodsCommand(CLI::App& program) {
  CLI::App* command = program.add_subcommand("methods", "lists the methods of this version");
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "as JSON");
  command->callback([json] { *json ? printJson() : printTable(); });
}

}  // namespace copeel
