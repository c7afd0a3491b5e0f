#include "apps/bench/method_runs.h"

#include <fmt/format.h>

#include "core/error.h"

namespace copeel::bench {
namespace {

// Among the methods of a bench, `auto` is the one of that name, not a choice of back end.
std::string_view backendOf(std::string_view backend, std::string_view name) { return name == "auto" && backend == "auto" ? "gl" : backend; }

}  // namespace

std::vector<MethodRun> runsOf(std::string_view backend, std::string_view text, std::uint32_t k) {
  if (text == "auto" && backend == "cpu") failUsage("--methods auto is one of the gl back end, not of cpu");
  // What there is none of is refused; what one back end alone has, or takes these modifiers, runs there.
  MethodRun run{nullptr, {}, {}};
  run.options.k = k;
  const MethodInfo& first = chooseMethod(backendOf(backend, text), text, run.options);
  std::vector<MethodRun> runs;
  for (const MethodInfo& method : methods()) {
    if (method.name != first.name || (backend != "auto" && backend != method.backend)) continue;
    if (&method != &first && text != method.name) continue;
    run.method = &method;
    const bool isShared = findMethod(method.name, "cpu") && findMethod(method.name, "gl");
    run.label = isShared ? fmt::format("{} ({})", text, method.backend) : text;
    runs.push_back(run);
  }
  return runs;
}

std::vector<MethodRun> allRuns(std::string_view backend, std::uint32_t k) {
  std::vector<MethodRun> all;
  for (const MethodInfo& method : methods()) {
    // A name that both back ends have comes once.
    if (&method == findMethod(method.name, backend)) append(all, runsOf(backend, method.name, k));
  }
  return all;
}

std::vector<MethodRun> runsThatAre(const std::vector<std::string>& names, std::string_view backend, std::uint32_t k) {
  std::vector<MethodRun> found;
  for (const std::string& text : names) {
    if (findMethod(text.substr(0, text.find('+')), backend)) append(found, runsOf(backend, text, k));
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
