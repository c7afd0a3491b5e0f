// Tables of words and numbers, aligned for a terminal or as Markdown.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace copeel::bench {

struct Table {
  std::vector<std::string> head;
  std::size_t wordColumns = 1;                  // the first columns are words, left aligned; the others numbers
  std::vector<std::vector<std::string>> rows;   // each as long as the head
};

std::string toText(const Table& table);
std::string toMarkdown(const Table& table);

// "1.23", "12.3", "123", "12,345": three digits or all before the point; "" for 0, which here means not measured.
std::string number(double value);
std::string count(std::uint64_t value);          // thousands apart

}  // namespace copeel::bench
