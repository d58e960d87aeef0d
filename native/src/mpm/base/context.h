// Progress and cancel of one long call, shared between the thread that works and the one that watches.
#pragma once

#include <atomic>
#include <cstddef>

namespace mpm {

// The worker counts `done` up to `total`; any thread may read both and may call cancel(). A cancelled call
// returns soon (each item is short) with what it has; items it did not reach keep their "not computed"
// status. A cancel is for good: the next call with the same context does nothing either.
//
// Threads: start() is the worker's alone, all else is any thread's.
class Context {
 public:
  explicit Context(int threads = 0) : threads_(threads) {}

  int threads() const { return threads_; }  // 0: all cores
  void start(std::size_t total) {
    total_ = total;
    done_ = 0;
  }
  void advance(std::size_t n = 1) { done_.fetch_add(n, std::memory_order_relaxed); }
  std::size_t done() const { return done_.load(std::memory_order_relaxed); }
  std::size_t total() const { return total_.load(std::memory_order_relaxed); }
  void cancel() { cancelled_ = true; }
  bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }

 private:
  int threads_;
  std::atomic<std::size_t> done_{0}, total_{0};
  std::atomic<bool> cancelled_{false};
};

}  // namespace mpm
