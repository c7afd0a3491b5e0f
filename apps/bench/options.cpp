#include "apps/bench/options.h"

#include <algorithm>

#include <fmt/ranges.h>

#include "apps/command/parse_values.h"
#include "core/error.h"

namespace copeel::bench {
namespace {

// Each part where only a scene, only methods or both are given: parts with scenes or methods of their own would say nothing of them.
bool makesSense(std::string_view part, const Options& options) {
  if (options.scenes.empty() && options.methods.empty() && options.backend == "auto") return part != "peers" || !options.noPeer;
  if (part == "scenes") return true;
  if (!options.scenes.empty()) return false;
  const bool ofAnyMethods = part == "resolution" || part == "coplanarity" || part == "depth" || part == "memory";
  return ofAnyMethods || (options.methods.empty() && options.backend == "gl" && part != "speed" && part != "peers");
}

}  // namespace

std::vector<Part> chosenParts(const Options& options) {
  for (const std::string& name : options.parts) {
    if (std::any_of(kParts.begin(), kParts.end(), [&](const Part& part) { return part.name == name; })) continue;
    std::vector<std::string_view> names;
    for (const Part& part : kParts) names.push_back(part.name);
    failUsage("--parts: there is no '{}', but {}", name, fmt::join(names, ", "));
  }
  std::vector<Part> chosen;
  for (const Part& part : kParts) {
    const bool isNamed = std::find(options.parts.begin(), options.parts.end(), part.name) != options.parts.end();
    if (options.parts.empty() ? makesSense(part.name, options) : isNamed) chosen.push_back(part);
  }
  return chosen;
}

std::vector<MethodRun> chosenMethods(const Options& options) {
  std::vector<MethodRun> chosen;
  for (const std::string& name : options.methods) append(chosen, runsOf(options.backend, name, options.k));
  if (options.methods.empty()) chosen = allRuns(options.backend, options.k);
  if (chosen.empty()) failMachine("the {} back end is not in this build", options.backend);
  if (options.depthSource != "hardware") return chosen;
  // What the papers did, beside the cpu back end's methods, whose depth is always the planes'.
  const std::vector<MethodRun> hardware = withHardwareDepth(chosen);
  std::erase_if(chosen, [](const MethodRun& run) { return run.method->backend == "gl"; });
  append(chosen, hardware);
  return chosen;
}

std::vector<std::array<int, 2>> chosenSizes(const Options& options) {
  std::vector<std::array<int, 2>> sizes;
  for (const std::string& size : options.sizes) sizes.push_back(parseImageSize(size));
  if (sizes.empty()) sizes = {{256, 192}};
  return sizes;
}

}  // namespace copeel::bench
