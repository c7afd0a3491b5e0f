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

// The fork and the join of one loop; says nothing unless under ThreadSanitizer.
class ForkJoin {
 public:
  ForkJoin() = default;
  ForkJoin(const ForkJoin&) = delete;
  ForkJoin& operator=(const ForkJoin&) = delete;
#ifdef COPEEL_TSAN
  void fork() { __tsan_release(&fork_); }
  void beginBody() { __tsan_acquire(&fork_); }
  void endBody() { __tsan_release(&join_); }
  void join() { __tsan_acquire(&join_); }

 private:
  char fork_ = 0, join_ = 0;   // their addresses are the tags
#else
  void fork() {}
  void beginBody() {}
  void endBody() {}
  void join() {}
#endif
};

// A loop's body as TBB's side calls it. The tags lie inside, as nothing may be read before the fork is acquired.
template <class Body>
class Loop {
 public:
  explicit Loop(Body& body) : body_(&body) { forkJoin_.fork(); }
  ~Loop() { forkJoin_.join(); }
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  static void call(void* loop, std::size_t begin, std::size_t end) {
    Loop& self = *static_cast<Loop*>(loop);
    self.forkJoin_.beginBody();
    // Left by an exception too, as TBB carries it to the join.
    const End atEnd{self.forkJoin_};
    (*self.body_)(begin, end);
  }

 private:
  struct End {
    ForkJoin& forkJoin;
    ~End() { forkJoin.endBody(); }
  };

  Body* body_;
  ForkJoin forkJoin_;
};

}  // namespace parallel

// `body(begin, end)` for ranges that make up [0, count), none split below `grain`. An exception of a body is thrown on.
template <class Body>
void parallelFor(std::size_t count, std::size_t grain, Body&& body, Split split = Split::AsNeeded) {
  using Loop = parallel::Loop<std::remove_reference_t<Body>>;
  Loop loop(body);
  parallel::forRanges(count, grain, split, &Loop::call, &loop);
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
    using Loop = parallel::Loop<decltype(once)>;
    Loop loop(once);
    run(&Loop::call, &loop);
  }

 private:
  struct Arena;
  void run(parallel::Call call, void* body);

  std::unique_ptr<Arena> arena_;
};

}  // namespace copeel
