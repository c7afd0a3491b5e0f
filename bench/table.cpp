#include "bench/table.h"

#include <algorithm>

#include <fmt/format.h>

namespace copeel::bench {
namespace {

// Columns of a terminal, for text whose characters are all one wide: bytes that do not continue a UTF-8 character.
std::size_t widthOf(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::vector<std::size_t> columnWidths(const Table& table) {
  std::vector<std::size_t> widths;
  for (std::size_t i = 0; i < table.head.size(); ++i) {
    widths.push_back(std::max<std::size_t>(widthOf(table.head[i]), 3));
    for (const auto& row : table.rows) widths[i] = std::max(widths[i], widthOf(row[i]));
  }
  return widths;
}

std::string line(const Table& table, const std::vector<std::string>& cells, const std::vector<std::size_t>& widths, const std::string& between) {
  std::string text;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string padding(widths[i] - widthOf(cells[i]), ' ');
    if (i > 0) text += between;
    text += i < table.wordColumns ? cells[i] + padding : padding + cells[i];
  }
  return text;
}

}  // namespace

std::string toText(const Table& table) {
  const std::vector<std::size_t> widths = columnWidths(table);
  std::string text = line(table, table.head, widths, "  ") + "\n";
  for (const auto& row : table.rows) text += line(table, row, widths, "  ") + "\n";
  return text;
}

std::string toMarkdown(const Table& table) {
  const std::vector<std::size_t> widths = columnWidths(table);
  std::string text = "| " + line(table, table.head, widths, " | ") + " |\n|";
  for (std::size_t i = 0; i < widths.size(); ++i) {
    text += i < table.wordColumns ? std::string(widths[i] + 2, '-') : std::string(widths[i] + 1, '-') + ":";
    text += "|";
  }
  text += "\n";
  for (const auto& row : table.rows) text += "| " + line(table, row, widths, " | ") + " |\n";
  return text;
}

std::string count(std::uint64_t value) {
  std::string digits = std::to_string(value);
  for (int at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3) digits.insert(static_cast<std::size_t>(at), ",");
  return digits;
}

std::string number(double value) {
  if (value <= 0) return "";
  if (value < 9.995) return fmt::format("{:.2f}", value);
  if (value < 99.95) return fmt::format("{:.1f}", value);
  return count(static_cast<std::uint64_t>(value + 0.5));
}

}  // namespace copeel::bench
