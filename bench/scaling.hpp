// How the time of a render grows with what it is asked for: one number of a fog is turned at a time.
#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace brume::bench {

struct ScalingPoint {
  int value = 0;
  double seconds = 0, spread = 0, lookups = 0;
};

struct ScalingAxis {
  std::string name;     // "voxels a side, light traced"
  double expected = 0;  // seconds grow as value to this power, because:
  std::string because;
  std::string suspect;  // what makes it worse, where it is
  std::vector<ScalingPoint> points;

  // Of seconds over values, and of lookups, through the largest SCALING_FITTED: what is small is ruled by what every
  // render costs.
  std::optional<double> exponent() const;
  std::optional<double> lookups_exponent() const;
};
inline constexpr std::size_t SCALING_FITTED = 3;
inline constexpr double SCALING_WORSE = 0.15;  // an exponent that is larger by this much is told

struct ScalingOptions {
  std::string device;
  int repetitions = 3;
  int most = 1 << 20;  // larger values are left out
};

// Every axis, each point reported as it is finished. `folder` takes scenes and pictures.
std::vector<ScalingAxis> scaling_run(const ScalingOptions& options, const std::filesystem::path& folder,
                                     const std::function<void(const ScalingAxis&)>& begin,
                                     const std::function<void(const ScalingPoint&)>& report,
                                     const std::function<void(const ScalingAxis&)>& end);

std::string scaling_json(const std::string& device, const std::vector<ScalingAxis>& axes);
// By gnuplot; false where there is none.
bool scaling_plot(const std::string& device, const std::vector<ScalingAxis>& axes, const std::filesystem::path& svg,
                  const std::filesystem::path& png);

}  // namespace brume::bench
