#include "apps/bench/table_2013.h"

#include <functional>
#include <map>

#include <fmt/format.h>

#include "apps/bench/deadline.h"
#include "core/error.h"

namespace copeel::bench {
namespace {

// Max layers per iteration, the paper's column; of methods that it does not have, its like.
std::string layersInPaper(const std::string& method) {
  static const std::map<std::string_view, const char*> all = {
      {"f2b", "1"}, {"f2b2", "1"}, {"f2b-2p", "2"}, {"f2b-3p", "2"}, {"f2b-ll", "C(Z)"}, {"f2b-fab", "K"}, {"f2b-kb", "K"}, {"dual", "2"}, {"dual-2p", "4"},
      {"dual-ll", "C(Zf) + C(Zb)"}, {"dual-fab", "2 K"}, {"dual-kb", "2 K"}, {"kb", "K"}, {"multi-kb", "K"}, {"srab", "K"}, {"bun", "2 K"}, {"bun-ll", "all"},
      {"bad", "4 K"}, {"fab", "all"}, {"ll", "all"}, {"sb", "all"}};
  const auto found = all.find(method);
  return found == all.end() ? "" : found->second;
}

std::string numberOf(double value, int digits) { return value < 0 ? "" : fmt::format("{:.{}f}", value, digits); }

struct Column {
  std::string head;
  std::function<std::string(const Row2013&)> cell;
};

const std::vector<Column>& columns() {
  static const std::vector<Column> all = {
      {"layers an iteration: paper", [](const Row2013& r) { return layersInPaper(r.method); }},
      {"measured (mean)", [](const Row2013& r) { return numberOf(r.layersPerIteration, 1); }},
      {"passes: formula", [](const Row2013& r) { return r.passesFormula; }},
      {"here", [](const Row2013& r) { return numberOf(r.passesExpected, 0); }},
      {"measured", [](const Row2013& r) { return fmt::format("{}", r.passes); }},
      {"words a pixel: paper", [](const Row2013& r) { return r.paperWords; }},
      {"ours, here", [&](const Row2013& r) { return numberOf(r.wordsExpected, 1); }},
      {"measured", [](const Row2013& r) { return numberOf(r.words, 1); }},
      {"R_h: formula", [](const Row2013& r) { return r.rhFormula; }},
      {"here", [](const Row2013& r) { return numberOf(r.rhExpected, 4); }},
      {"measured", [](const Row2013& r) { return numberOf(r.rh, 4); }},
      {"ms", [](const Row2013& r) { return numberOf(r.ms, 1); }},
  };
  return all;
}

Row2013 rowOf(const MethodRun& run, const Entry& entry, const Shape& shape) {
  const MethodInfo& method = *run.method;
  Row2013 row;
  row.method = method.name;
  row.passesFormula = method.passes, row.rhFormula = method.robustness, row.paperWords = method.paperWords;
  const double bytes = expectedBytes(method.name, shape, run.options.k), words = 4 * double(shape.pixels);
  row.passesExpected = expectedPasses(method.name, shape, run.options.k);
  row.wordsExpected = bytes < 0 ? -1 : bytes / words;
  row.rhExpected = expectedRh(method.name, shape, run.options.k);
  row.leftOut = entry.failure + entry.leftOut;
  row.passes = entry.stats.passes;
  row.words = double(entry.stats.methodBytes) / words;
  row.rh = entry.stats.rh();
  row.ms = entry.minMs;
  row.layersPerIteration = entry.stats.iterations ? double(entry.stats.capturedMax) / double(entry.stats.iterations) : -1;
  return row;
}

// A bar within a cell would end it.
std::string markdownCell(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

// Characters, of UTF-8.
std::size_t widthOf(const std::string& text) {
  std::size_t width = 0;
  for (const char c : text) width += (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  return width;
}

}  // namespace

Table2013 table2013(int width, int height, std::uint32_t k, int frames, double budgetMs) {
  const Deadline deadline(budgetMs);
  Table2013 table;
  table.width = width, table.height = height, table.k = k;
  const BenchScene scene = stack(table.depths, table.coplanar);
  MeasureOptions measure;
  measure.frames = frames;
  const Shape shape = shapeOf(scene.parts, viewOf(scene, {}, width, height), 0);
  // Each with a device of its own: none finds buffers that another one made grow.
  for (const MethodRun& run : allRuns("gl", k)) {
    measure.methods = {run};
    measure.budgetMs = deadline.leftMs();
    table.rows.push_back(rowOf(run, measureScene(scene, width, height, measure).front(), shape));
  }
  if (table.rows.empty()) failMachine("table 2013 is of the gl back end, which is not in this build");
  return table;
}

std::string legendOf(const Table2013& table) {
  return fmt::format("A generated scene: half of {} x {} pixels have D = {} depths of C(Z) = {} coplanar fragments each, N = {}; K = {}. \"here\" is the formula with these "
                     "numbers, memory in 32-bit words divided by all pixels.",
                     table.width, table.height, table.depths, table.coplanar, table.depths * table.coplanar, table.k);
}

std::string toText(const Table2013& table) {
  std::vector<std::size_t> widths;
  for (const Column& column : columns()) {
    widths.push_back(widthOf(column.head));
    for (const Row2013& row : table.rows) widths.back() = std::max(widths.back(), widthOf(column.cell(row)));
  }
  const auto padded = [](const std::string& text, std::size_t width) { return text + std::string(width + 2 - widthOf(text), ' '); };
  constexpr std::size_t kNameWidth = 12;
  std::string text = legendOf(table) + "\n" + padded("method", kNameWidth);
  for (std::size_t i = 0; i < widths.size(); ++i) text += padded(columns()[i].head, widths[i]);
  for (const Row2013& row : table.rows) {
    text.erase(text.find_last_not_of(' ') + 1);
    text += "\n" + padded(row.method, kNameWidth);
    if (!row.leftOut.empty()) text += row.leftOut;
    for (std::size_t i = 0; i < widths.size() && row.leftOut.empty(); ++i) text += padded(columns()[i].cell(row), widths[i]);
  }
  text.erase(text.find_last_not_of(' ') + 1);
  return text + "\n";
}

std::string toMarkdown(const Table2013& table) {
  std::string text = "| method |", line = "|---|";
  for (const Column& column : columns()) {
    text += " " + column.head + " |";
    line += "---|";
  }
  text += "\n" + line + "\n";
  for (const Row2013& row : table.rows) {
    text += "| `" + row.method + "` |";
    for (const Column& column : columns()) text += " " + markdownCell(row.leftOut.empty() ? column.cell(row) : "") + " |";
    text += "\n";
  }
  return text;
}

std::string htmlOf(const Table2013& table) {
  const auto escaped = [](const std::string& text) {
    std::string out;
    for (const char c : text) out += c == '<' ? std::string("&lt;") : std::string(1, c);
    return out;
  };
  std::string text = "<p class=note>" + legendOf(table) + "</p>\n<table><tr><th>method";
  for (const Column& column : columns()) text += "<th>" + column.head;
  text += "</tr>\n";
  for (const Row2013& row : table.rows) {
    text += "<tr><td>" + row.method;
    if (!row.leftOut.empty()) text += fmt::format("<td class=why colspan={}>{}", columns().size(), escaped(row.leftOut));
    for (std::size_t i = 0; i < columns().size() && row.leftOut.empty(); ++i) text += "<td>" + escaped(columns()[i].cell(row));
    text += "</tr>\n";
  }
  return text + "</table>\n";
}

}  // namespace copeel::bench
