// The runs that a report is made of: part by part, each in its share of the time.
#pragma once

#include "apps/bench/options.h"

namespace copeel::bench {

void runReport(const Options& options);

}  // namespace copeel::bench
