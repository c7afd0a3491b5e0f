// gnuplot scripts of the bench's entries: points with a Pareto front, lines over a parameter, bars by scene. Each holds its numbers: to be changed and drawn again.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/bench/report.h"

namespace copeel::bench {

using Value = std::function<double(const Entry&)>;

// Size, title and axes.
std::string plotHead(const std::string& title, const std::string& x, const std::string& y);

// Empty where there is nothing to show, as the others.
std::string speedAgainstError(const SceneRun& scene);
std::string lines(const std::string& head, const std::vector<Entry>& entries, const Value& x, const Value& y);   // one a method
std::string bars(const std::string& head, const std::vector<Entry>& entries);                                    // of the least ms: by scene, a colour a method
// A column a method: objects of each pass above, its time below, with and without +cull.
std::string cullingPlot(const std::vector<Entry>& entries, const std::string& of);

}  // namespace copeel::bench
