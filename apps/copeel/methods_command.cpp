#include "apps/copeel/methods_command.h"

#include <algorithm>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/methods/method.h"

namespace copeel {
namespace {

// Columns as wide as their widest entry.
void printTable() {
  constexpr std::string_view MethodInfo::*kColumns[] = {&MethodInfo::name, &MethodInfo::backend, &MethodInfo::robustness, &MethodInfo::passes,
                                                        &MethodInfo::memory, &MethodInfo::paperWords, &MethodInfo::title, &MethodInfo::source};
  constexpr std::string_view kHeads[] = {"method", "backend", "R_h", "passes", "memory, bytes", "paper's, words a pixel", "what it is", "source"};
  for (std::size_t row = 0; row <= methods().size(); ++row) {
    std::string line;
    for (std::size_t column = 0; column < std::size(kColumns); ++column) {
      std::size_t width = kHeads[column].size();
      for (const MethodInfo& method : methods()) width = std::max(width, (method.*kColumns[column]).size());
      line += fmt::format("{:<{}}  ", row == 0 ? kHeads[column] : methods()[row - 1].*kColumns[column], width);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    fmt::print("{}\n", line);
  }
}

void printJson() {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const MethodInfo& method : methods()) {
    list.push_back({{"name", method.name},
                    {"backend", method.backend},
                    {"robust", method.robust},
                    {"rh", method.robustness},
                    {"passes", method.passes},
                    {"memory", method.memory},
                    {"paper_words", method.paperWords},
                    {"title", method.title},
                    {"source", method.source}});
  }
  fmt::print("{}\n", list.dump(2));
}

// A bar within a cell would end it.
std::string cell(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

void printMarkdown() {
  fmt::print("| name | what it is | source | back end | passes | memory, bytes | the paper's, words a pixel | R_h |\n|---|---|---|---|---|---|---|---|\n");
  for (const MethodInfo& m : methods()) {
    fmt::print("| `{}` | {} | {} | {} | {} | {} | {} | {} |\n", cell(m.name), cell(m.title), cell(m.source), cell(m.backend), cell(m.passes), cell(m.memory), cell(m.paperWords), cell(m.robustness));
  }
}

}  // namespace

void addMethodsCommand(CLI::App& program) {
  CLI::App* command = program.add_subcommand("methods", "lists the methods of this version");
  const auto json = std::make_shared<bool>(false);
  const auto markdown = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "as JSON");
  command->add_flag("--markdown", *markdown, "as a table in Markdown")->excludes("--json");
  command->callback([json, markdown] { *json ? printJson() : *markdown ? printMarkdown() : printTable(); });
}

}  // namespace copeel
