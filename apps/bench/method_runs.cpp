#include "apps/bench/method_runs.h"

#include "core/error.h"

namespace copeel::bench {
namespace {

// Among the methods of a bench, `auto` is the one of that name, not a choice of back end.
std::string_view backendOf(std::string_view backend, std::string_view name) { return name == "auto" && backend == "auto" ? "gl" : backend; }

}  // namespace

std::vector<MethodRun> runsOf(std::string_view backend, std::string_view text, std::uint32_t k) {
  if (text == "auto" && backend == "cpu") failUsage("--methods auto is one of the gl back end, not of cpu");
  MethodRun run{nullptr, {}, std::string(text)};
  run.options.k = k;
  const std::string name = parseMethod(text, run.options);
  run.method = &chooseMethod(backendOf(backend, name), name);
  return {run};
}

std::vector<MethodRun> allRuns(std::string_view backend, std::uint32_t k) {
  std::vector<MethodRun> all;
  for (const MethodInfo& method : methods()) {
    if (backend == "auto" || backend == method.backend) append(all, runsOf(backend, method.name, k));
  }
  return all;
}

std::vector<MethodRun> runsThatAre(const std::vector<std::string>& names, std::string_view backend, std::uint32_t k) {
  std::vector<MethodRun> found;
  for (const std::string& text : names) {
    const MethodInfo* method = findMethod(text.substr(0, text.find('+')));
    if (method && (backend == "auto" || backend == method->backend)) append(found, runsOf(backend, text, k));
  }
  return found;
}

std::vector<MethodRun> withHardwareDepth(const std::vector<MethodRun>& runs) {
  std::vector<MethodRun> hardware;
  for (MethodRun run : runs) {
    if (run.method->backend != "gl") continue;
    run.options.hardwareDepth = true;
    run.label += " (hardware depth)";
    hardware.push_back(std::move(run));
  }
  return hardware;
}

void append(std::vector<MethodRun>& all, const std::vector<MethodRun>& some) { all.insert(all.end(), some.begin(), some.end()); }

}  // namespace copeel::bench
