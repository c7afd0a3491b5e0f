// Loops over oneTBB whose fork and join ThreadSanitizer can see.
//
// Distributions ship libtbb without instrumentation, so ThreadSanitizer takes what a loop hands to its threads and back for races. Under
// it, a loop says by itself what happens before what: release before the loop, acquire where a body begins, release where it ends, acquire
// after the loop. Two bodies of one loop stay unordered, so a race between them is still found. The templates of TBB's loops are kept to
// parallel.cpp, which the tsan preset leaves uninstrumented like the library itself. In other builds this costs a call by pointer a chunk.
// enumerable_thread_specific needs nothing more as long as it is combined after the join.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>

#if defined(__SANITIZE_THREAD__)
#define COPEEL_TSAN 1
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define COPEEL_TSAN 1
#endif
#endif

#ifdef COPEEL_TSAN
#include <algorithm>

#include <sanitizer/tsan_interface.h>
#else
#include <tbb/parallel_sort.h>
#endif

namespace copeel {

// How a range is split: as far as the threads need, or down to the grain (for items of very different cost, such as tiles).
enum class Split { AsNeeded, ToGrain };

namespace parallel {

using Call = void (*)(void* body, std::size_t begin, std::size_t end);

void forRanges(std::size_t count, std::size_t grain, Split split, Call call, void* body);

// What is handed to the threads, and back; empty unless under ThreadSanitizer.
class ForkJoin {
 public:
#ifdef COPEEL_TSAN
  ForkJoin() { __tsan_release(&fork_); }
  ~ForkJoin() { __tsan_acquire(&join_); }
  void beginBody() { __tsan_acquire(&fork_); }
  void endBody() { __tsan_release(&join_); }

 private:
  char fork_ = 0, join_ = 0;
#else
  ForkJoin() {}
  ~ForkJoin() {}
  void beginBody() {}
  void endBody() {}
#endif
  ForkJoin(const ForkJoin&) = delete;
  ForkJoin& operator=(const ForkJoin&) = delete;
};

// Around one body; left by an exception too, as TBB carries it to the join.
class BodyScope {
 public:
  explicit BodyScope(ForkJoin& forkJoin) : forkJoin_(forkJoin) { forkJoin_.beginBody(); }
  ~BodyScope() { forkJoin_.endBody(); }
  BodyScope(const BodyScope&) = delete;
  BodyScope& operator=(const BodyScope&) = delete;

 private:
  ForkJoin& forkJoin_;
};

template <class Body>
struct Bound {
  Body& body;
  ForkJoin& forkJoin;

  static void call(void* bound, std::size_t begin, std::size_t end) {
    const Bound& self = *static_cast<Bound*>(bound);
    const BodyScope scope(self.forkJoin);
    self.body(begin, end);
  }
};

}  // namespace parallel

// `body(begin, end)` for ranges that make up [0, count), none split below `grain`. An exception of a body is thrown on.
template <class Body>
void parallelFor(std::size_t count, std::size_t grain, Body&& body, Split split = Split::AsNeeded) {
  using Bound = parallel::Bound<std::remove_reference_t<Body>>;
  parallel::ForkJoin forkJoin;
  Bound bound{body, forkJoin};
  parallel::forRanges(count, grain, split, &Bound::call, &bound);
}

// The order must be total: equal elements may come in any order.
template <class Iterator, class Less>
void parallelSort(Iterator begin, Iterator end, Less less) {
#ifdef COPEEL_TSAN
  std::sort(begin, end, less);
#else
  tbb::parallel_sort(begin, end, less);
#endif
}

// The threads that a loop called from here may use.
std::size_t threadLimit();

// Loops called inside `execute` use this many threads; 0: as many as the machine has.
class Threads {
 public:
  explicit Threads(int count);
  ~Threads();

  // Where the calling thread finds no place, another one runs `body`.
  template <class Body>
  void execute(Body&& body) {
    const auto once = [&](std::size_t, std::size_t) { body(); };
    using Bound = parallel::Bound<decltype(once)>;
    parallel::ForkJoin forkJoin;
    Bound bound{once, forkJoin};
    run(&Bound::call, &bound);
  }

 private:
  struct Arena;
  void run(parallel::Call call, void* body);

  std::unique_ptr<Arena> arena_;
};

}  // namespace copeel
