// The measurements of a run as JSON, in the order in which the design names them. Scripts depend on the names.
#include "core/metrics/stats.h"

#include <nlohmann/json.hpp>
#include <sys/resource.h>

namespace copeel {

std::string toJson(const Stats& stats) {
  nlohmann::ordered_json json;
  json["method"] = stats.method;
  if (!stats.methodReason.empty()) json["method_reason"] = stats.methodReason;
  json["backend"] = stats.backend;
  json["width"] = stats.width;
  json["height"] = stats.height;
  json["triangles"] = stats.triangles;
  json["leaves"] = stats.leaves;
  json["plane_classes"] = stats.planeClasses;
  json["fragments"] = stats.fragments;
  json["fragments_captured"] = stats.fragmentsCaptured;
  json["rh"] = stats.rh();
  json["depth_complexity_max"] = stats.depthComplexityMax;
  json["covered_pixels"] = stats.coveredPixels;
  json["coplanar_pixels"] = stats.coplanarPixels;
  json["cp"] = stats.cp();
  json["overflow"] = stats.overflow;
  json["passes"] = stats.passes;
  json["memory_bytes"] = stats.memoryBytes;
  json["decided_exactly"] = stats.decidedExactly;
  json["uncertain"] = stats.uncertain;
  json["ms"] = {{"load", stats.loadMs},
                {"prepare", stats.prepareMs},
                {"frame_median", stats.frameMedianMs},
                {"frame_min", stats.frameMinMs},
                {"total", stats.totalMs}};
  // A file name inside may hold any bytes: what is not UTF-8 is replaced, not thrown over.
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::uint64_t peakMemoryBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;   // Linux counts in KiB
}

}  // namespace copeel
