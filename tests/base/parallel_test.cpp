#include "base/parallel.h"

#include <gtest/gtest.h>
#include <immintrin.h>
#include <sched.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace sateen {
namespace {

class SlurmVariable : public testing::Test {
 protected:
  void TearDown() override { ::unsetenv("SLURM_CPUS_PER_TASK"); }
  static int allowed() {
    cpu_set_t set;
    CPU_ZERO(&set);
    sched_getaffinity(0, sizeof set, &set);
    return CPU_COUNT(&set);
  }
};

TEST_F(SlurmVariable, LimitsTheThreadsButNeverRaisesThem) {
  ::unsetenv("SLURM_CPUS_PER_TASK");
  EXPECT_EQ(thread_count(0), allowed());
  ::setenv("SLURM_CPUS_PER_TASK", "1", 1);
  EXPECT_EQ(thread_count(0), 1);
  ::setenv("SLURM_CPUS_PER_TASK", "100000", 1);
  EXPECT_EQ(thread_count(0), allowed());
}

TEST_F(SlurmVariable, GivesWayToARequest) {
  ::setenv("SLURM_CPUS_PER_TASK", "1", 1);
  EXPECT_EQ(thread_count(5), 5);
}

TEST_F(SlurmVariable, IsIgnoredWhereItIsNoNumberAboveZero) {
  for (const char* text : {"", "zero", "0", "-3", "99999999999999999999"}) {
    ::setenv("SLURM_CPUS_PER_TASK", text, 1);
    EXPECT_EQ(thread_count(0), allowed()) << '"' << text << '"';
  }
}

TEST(ParallelFor, RunsEachOnce) {
  for (const int threads : {1, 2, 3, 8})
    for (const int count : {0, 1, 2, 7, 1000}) {
      std::vector<std::atomic<int>> runs(static_cast<size_t>(count));
      parallel_for(count, threads, [&](int i) { ++runs[size_t(i)]; });
      for (const auto& n : runs) EXPECT_EQ(n, 1) << threads << " threads, " << count << " calls";
    }
  parallel_for(-3, 2, [](int) { FAIL(); });
}

TEST(ParallelFor, RethrowsWhatABodyThrows) {
  for (const int threads : {1, 2, 8}) try {
      parallel_for(100, threads, [](int i) {
        if (i == 57) throw std::runtime_error("at " + std::to_string(i));
      });
      FAIL() << threads << " threads swallowed the exception";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "at 57");
    }
}

TEST(ParallelFor, RunsAsManyThreadsAsAskedForAlsoBeyondTheProcessors) {
  // Every call waits until all eight are under way: fewer threads would stay there until the time is up.
  std::atomic<int> under_way = 0;
  const auto start = std::chrono::steady_clock::now();
  parallel_for(8, 8, [&](int) {
    ++under_way;
    while (under_way < 8 && std::chrono::steady_clock::now() - start < std::chrono::seconds(20))
      std::this_thread::yield();
  });
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST(ParallelFor, WorksInsideItself) {
  std::atomic<int> calls = 0;
  parallel_for(4, 2, [&](int) { parallel_for(5, 2, [&](int) { ++calls; }); });
  EXPECT_EQ(calls, 20);
}

TEST(ParallelFor, FlushesDenormalsInEveryWorker) {
  for (const int threads : {1, 2, 8}) {
    std::atomic<int> kept = 0;
    parallel_for(64, threads, [&](int) {
      volatile float smallest = std::numeric_limits<float>::min();
      if (smallest / 4 != 0) ++kept;
    });
    EXPECT_EQ(kept, 0) << threads;
  }
}

TEST(CpuSeconds, GrowWithWork) {
  const double start = cpu_seconds();
  volatile double sum = 0;
  while (cpu_seconds() < start + 0.01)
    for (int i = 0; i < 1000; ++i) sum = sum + i;
  EXPECT_GT(cpu_seconds(), start);
}

}  // namespace
}  // namespace sateen
