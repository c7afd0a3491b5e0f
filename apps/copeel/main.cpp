// The one program: it names the sub-commands and turns what they throw into one line and an exit code.
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/bench/command.h"
#include "apps/copeel/heap.h"
#include "apps/copeel/methods_command.h"
#include "apps/csg/command.h"
#include "apps/oit/command.h"
#include "core/error.h"
#include "core/on_signal.h"

namespace {

using copeel::ExitCode;

using AddCommand = void (*)(CLI::App&);

constexpr std::pair<std::string_view, AddCommand> kCommands[] = {
    {"csg", copeel::csg::addCommand},
    {"oit", copeel::oit::addCommand},
    {"bench", copeel::bench::addCommand},
    {"methods", copeel::addMethodsCommand},
};

constexpr std::pair<const char*, const char*> kNotBuilt[] = {
    {"wireframe", "line drawings without hidden lines"},
    {"collide", "where meshes cross"},      {"coplanar", "which faces lie on each other"},
    {"view", "a window to look around in"}, {"validate", "compares with exact references"},
};

// The one that is asked for, as the options of the others take time; all, where it is none of these.
void addCommands(CLI::App& program, std::string_view asked) {
  for (const auto& [name, add] : kCommands) {
    if (name == asked) return add(program);
  }
  for (const auto& [name, add] : kCommands) add(program);
  for (const auto& [name, what] : kNotBuilt) {
    CLI::App* command = program.add_subcommand(name, fmt::format("{} (not built in this version)", what));
    command->allow_extras();
    command->callback([name = std::string(name)] { copeel::failMachine("{}: not built in this version", name); });
  }
}

// Scripts read one line: whatever a message holds, it stays one.
int fail(ExitCode code, std::string message) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  fmt::print(stderr, "copeel: {}\n", message);
  return static_cast<int>(code);
}

// What was printed may still fail to arrive: a full disk, a closed pipe.
int finish() {
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return static_cast<int>(ExitCode::Done);
  return fail(ExitCode::Machine, fmt::format("cannot write to standard output: {}", std::strerror(errno)));
}

int run(int argc, char** argv) {
  CLI::App program{"Pictures of what overlaps: CSG models and transparent meshes whose coincident faces are right.", "copeel"};
  program.set_version_flag("--version", "copeel " COPEEL_VERSION);
  program.require_subcommand(1);
  addCommands(program, argc > 1 ? argv[1] : "");
  const auto named = [&](const CLI::App* command) { return command->get_name() == argv[1]; };
  if (argc > 1 && argv[1][0] != '-' && program.get_subcommands(named).empty()) {
    return fail(ExitCode::Usage, fmt::format("no command '{}' (see copeel --help)", argv[1]));
  }
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& asked) {   // --help and --version
    program.exit(asked);
  } catch (const CLI::ParseError& error) {
    return fail(ExitCode::Usage, std::string(error.what()) + " (see copeel --help)");
  }
  return finish();
}

}  // namespace

int main(int argc, char** argv) {
  copeel::keepHeap();
  copeel::cleanUpOnSignal();
  setenv("EGL_LOG_LEVEL", "fatal", 0);   // what Mesa has to say there comes as our one line
  std::signal(SIGPIPE, SIG_IGN);   // a closed pipe is an error of the write, and reported as one
  try {
    return run(argc, argv);
  } catch (const copeel::Error& error) {
    return fail(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::Machine, "not enough memory");
  } catch (const std::length_error&) {   // a container that no memory could hold
    return fail(ExitCode::Machine, "not enough memory");
  } catch (const std::exception& error) {
    // oneTBB's words.
    if (std::string_view(error.what()).starts_with("pthread_create")) return fail(ExitCode::Machine, "not enough memory, or too many processes, to start a thread");
    return fail(ExitCode::Machine, fmt::format("unexpected error: {}", error.what()));
  }
}
