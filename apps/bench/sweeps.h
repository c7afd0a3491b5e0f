// The parts that go over one thing at a time: resolution, coplanarity, depth complexity, culling, memory; figures 7 to 11 of the 2013 paper.
#pragma once

#include <string_view>

#include "apps/bench/options.h"
#include "apps/bench/report.h"
#include "apps/bench/stand_ins.h"

namespace copeel::bench {

// Runs the part of that name with the methods of `measure`, where they were asked for, or else those of the figure, and adds what it finds to the report.
void sweep(std::string_view part, const Options& options, const StandIns& standIns, const MeasureOptions& measure, double budgetMs, Report& report);

}  // namespace copeel::bench
