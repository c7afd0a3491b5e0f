#include "core/parallel.h"

#include <optional>

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace copeel {

void parallel::forRanges(std::size_t count, std::size_t grain, Split split, Call call, void* body) {
  const tbb::blocked_range<std::size_t> all(0, count, grain);
  const auto callRange = [call, body](const tbb::blocked_range<std::size_t>& range) { call(body, range.begin(), range.end()); };
  if (split == Split::ToGrain) {
    tbb::parallel_for(all, callRange, tbb::simple_partitioner());
  } else {
    tbb::parallel_for(all, callRange);
  }
}

std::size_t threadLimit() { return static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()); }

struct Threads::Arena {
  // More threads than the machine has cores are there only if TBB is told before the arena asks for them; it would warn on standard error.
  std::optional<tbb::global_control> more;
  tbb::task_arena arena;

  explicit Arena(int count) : arena(count > 0 ? count : int{tbb::task_arena::automatic}) {
    if (count > tbb::info::default_concurrency()) more.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count));
  }
};

Threads::Threads(int count) : arena_(new Arena(count)) {}
Threads::~Threads() = default;

void Threads::run(parallel::Call call, void* body) {
  arena_->arena.execute([call, body] { call(body, 0, 1); });
}

}  // namespace copeel
