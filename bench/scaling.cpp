// See scaling.hpp.
#include "scaling.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/atomic_file.hpp"
#include "base/command_line.hpp"
#include "base/json_text.hpp"
#include "base/statistics.hpp"
#include "process.hpp"

namespace brume::bench {

namespace {

// What is turned; 0 steps: cell by cell; 0 light_grid: light is traced; 0 threads: all.
struct Fog {
  int side = 96, voxels = 64, steps = 0, lights = 1, media = 1, light_grid = 0, threads = 0;
};

struct AxisRow {
  const char* name;
  int Fog::*knob;
  std::vector<int> values;
  double expected;
  const char *because, *suspect;
  Fog fog;
};

Fog with(int Fog::*knob, int value, Fog fog = {}) {
  fog.*knob = value;
  return fog;
}

const std::vector<AxisRow>& axis_rows() {
  static const Fog grid = with(&Fog::light_grid, 32);
  static const char *caches = "voxels beyond the caches: rays that lie cells apart share none of what they read",
                    *other = "other work on the machine", *shared = "cores that are busy with other work";
  static const std::vector<AxisRow> rows{
      {"pixels a side", &Fog::side, {32, 64, 128, 256, 512}, 2, "every pixel is rays of its own", other, grid},
      {"steps, light grid", &Fog::steps, {32, 64, 128, 256, 512}, 1, "a lookup each", other, grid},
      {"steps, light traced",
       &Fog::steps,
       {16, 32, 64, 128, 256},
       2,
       "a light ray of as many steps from each",
       other,
       {}},
      {"voxels a side, light grid",
       &Fog::voxels,
       {16, 32, 64, 128, 256, 512},
       1,
       "a ray crosses as many",
       caches,
       grid},
      {"voxels a side, light traced",
       &Fog::voxels,
       {16, 32, 64, 128, 256},
       2,
       "a light ray from each cell",
       caches,
       {}},
      {"lights", &Fog::lights, {1, 2, 4, 8, 16}, 1, "a ray to each", other, with(&Fog::voxels, 32)},
      {"overlapping media, light grid",
       &Fog::media,
       {1, 2, 4, 8, 16},
       1,
       "each is walked once",
       "a light grid about turned boxes is larger than each",
       with(&Fog::voxels, 32, grid)},
      {"overlapping media, light traced",
       &Fog::media,
       {1, 2, 4, 8, 16},
       1,
       "light rays through all, from places that all share",
       other,
       with(&Fog::voxels, 32)},
      {"threads", &Fog::threads, {1, 2}, -1, "batches are shared out", shared, with(&Fog::side, 192)},
  };
  return rows;
}

nlohmann::json medium_json(const Fog& fog, int index) {
  return {{"density",
           {{"type", "perlin"}, {"resolution", {fog.voxels, fog.voxels, fog.voxels}}, {"scale", 4}, {"seed", index}}},
          {"sigma_a", 0.4 / fog.media},
          {"sigma_s", 3.0 / fog.media}};
}

// As many lights round the fog, together as bright as one.
nlohmann::json light_json(const Fog& fog, int index) {
  const double turn = 2 * M_PI * index / fog.lights;
  return {
      {"type", "directional"}, {"direction", {std::cos(turn), -1, std::sin(turn)}}, {"irradiance", 3.0 / fog.lights}};
}

std::string scene_text(const Fog& fog) {
  nlohmann::json media = nlohmann::json::array(), lights = nlohmann::json::array();
  for (int i = 0; i < fog.media; ++i) media.push_back(medium_json(fog, i + 1));
  for (int i = 0; i < fog.lights; ++i) lights.push_back(light_json(fog, i));
  nlohmann::json render{{"method", fog.steps > 0 ? "march_midpoint" : "dda_midpoint"},
                        {"shadow", fog.light_grid > 0 ? "grid" : "trace"}};
  if (fog.steps > 0) render["step"] = 1.0 / fog.steps;
  if (fog.light_grid > 0) render["light_grid"] = fog.light_grid;
  return nlohmann::json{{"camera", {{"eye", {1.9, 1.1, 2.6}}, {"target", {0, 0, 0}}, {"vfov", 40}}},
                        {"film", {{"size", {fog.side, fog.side}}, {"spp", 1}}},
                        {"lights", lights},
                        {"media", media},
                        {"render", render}}
      .dump();
}

ScalingPoint point_of(const Fog& fog, int value, const ScalingOptions& options, const std::filesystem::path& folder) {
  const std::filesystem::path scene = folder / "scaling.json";
  atomic_write(scene, scene_text(fog));
  const std::string device = options.device.empty() ? "" : "--device " + shell_quoted(options.device);
  const std::string threads = fog.threads > 0 ? "POCL_MAX_PTHREAD_COUNT=" + std::to_string(fog.threads) : "";
  ScalingPoint point{value, 0, 0, 0};
  std::vector<double> seconds;
  for (int run = 0; run < options.repetitions; ++run) {
    const ProcessTimes times = process_render(scene, device, threads, folder);
    seconds.push_back(times.render);
    point.lookups = times.lookups;
  }
  const Summary summary = summary_of(seconds);
  point.seconds = summary.median;
  point.spread = summary.spread;
  return point;
}

std::optional<double> fitted(const std::vector<ScalingPoint>& points, double ScalingPoint::*what) {
  std::vector<double> x, y;
  for (std::size_t i = points.size() > SCALING_FITTED ? points.size() - SCALING_FITTED : 0; i < points.size(); ++i)
    x.push_back(points[i].value), y.push_back(points[i].*what);
  return power_fitted(x, y);
}

}  // namespace

std::optional<double> ScalingAxis::exponent() const { return fitted(points, &ScalingPoint::seconds); }
std::optional<double> ScalingAxis::lookups_exponent() const { return fitted(points, &ScalingPoint::lookups); }

std::vector<ScalingAxis> scaling_run(const ScalingOptions& options, const std::filesystem::path& folder,
                                     const std::function<void(const ScalingAxis&)>& begin,
                                     const std::function<void(const ScalingPoint&)>& report,
                                     const std::function<void(const ScalingAxis&)>& end) {
  std::vector<ScalingAxis> axes;
  for (const AxisRow& row : axis_rows()) {
    ScalingAxis axis{row.name, row.expected, row.because, row.suspect, {}};
    begin(axis);
    for (const int value : row.values) {
      if (value > options.most) continue;
      axis.points.push_back(point_of(with(row.knob, value, row.fog), value, options, folder));
      report(axis.points.back());
    }
    end(axis);
    axes.push_back(axis);
  }
  return axes;
}

std::string scaling_json(const std::string& device, const std::vector<ScalingAxis>& axes) {
  const auto optional = [](const std::optional<double>& number) {
    return number ? nlohmann::ordered_json(*number) : nlohmann::ordered_json();
  };
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const ScalingAxis& axis : axes) {
    nlohmann::ordered_json points = nlohmann::ordered_json::array();
    for (const ScalingPoint& p : axis.points)
      points.push_back({{"value", p.value}, {"seconds", p.seconds}, {"spread", p.spread}, {"lookups", p.lookups}});
    list.push_back({{"name", axis.name},
                    {"exponent", optional(axis.exponent())},
                    {"expected", axis.expected},
                    {"because", axis.because},
                    {"suspect", axis.suspect},
                    {"lookups_exponent", optional(axis.lookups_exponent())},
                    {"points", points}});
  }
  return json_text({{"device", device}, {"axes", list}});
}

}  // namespace brume::bench
