// Benchmarks whose runs are measured all at once and told one by one.
#pragma once
#include <benchmark/benchmark.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace brume::bench {

// One benchmark: its permanent name and what measures it.
struct Bench {
  std::string name;
  std::function<void(::benchmark::State&)> measure;
};

using Counters = std::map<std::string, double>;

class Runs {
 public:
  using Measure = std::function<std::vector<double>()>;
  // `missing`: what there is to say where nothing was measured.
  Runs(Measure measure, std::string missing) : measure_(std::move(measure)), missing_(std::move(missing)) {}

  void tell(::benchmark::State& state) {
    if (next_ == seconds_.size()) {
      seconds_ = measure_();
      next_ = 0;
    }
    if (seconds_.empty()) return state.SkipWithError(missing_.c_str());
    for (auto unused : state) {
      (void)unused;
      state.SetIterationTime(seconds_[next_]);
    }
    ++next_;
  }

 private:
  Measure measure_;
  std::string missing_;
  std::vector<double> seconds_;
  std::size_t next_ = 0;
};

// The seconds of all runs and what they count by `measure`.
inline Bench bench_of(const std::string& name, const std::string& missing,
                      const std::function<std::vector<double>(Counters&)>& measure) {
  const auto counters = std::make_shared<Counters>();
  const auto runs = std::make_shared<Runs>([=] { return measure(*counters); }, missing);
  return {name, [=](::benchmark::State& state) {
            runs->tell(state);
            for (const auto& [key, value] : *counters) state.counters[key] = value;
          }};
}

}  // namespace brume::bench
