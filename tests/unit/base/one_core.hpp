// Code that may run on one core only, as under taskset.
#pragma once
#include <gtest/gtest.h>
#include <sched.h>

#include <functional>
#include <thread>

namespace brume {

// Runs it on a thread of its own, which alone may use no other core.
inline void on_one_core(const std::function<void()>& run) {
  std::thread([&] {
    cpu_set_t all, one;
    ASSERT_EQ(::sched_getaffinity(0, sizeof all, &all), 0);
    int cpu = 0;
    while (!CPU_ISSET(cpu, &all)) ++cpu;
    CPU_ZERO(&one);
    CPU_SET(cpu, &one);
    ASSERT_EQ(::sched_setaffinity(0, sizeof one, &one), 0);
    run();
  }).join();
}

}  // namespace brume
