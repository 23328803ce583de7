// See specialised.hpp.
#include "specialised.hpp"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/command_line.hpp"
#include "base/json_text.hpp"
#include "base/statistics.hpp"
#include "base/text_printable.hpp"
#include "process.hpp"
#include "row.hpp"

namespace brume::bench {

namespace {

constexpr int SCENE_WIDTH = 34;

std::string options_text(const SpecialisedOptions& options, bool generic) {
  const std::string side = std::to_string(options.size);
  return (options.size > 0 ? " --size " + side + "x" + side : "") +
         (options.device.empty() ? "" : " --device " + shell_quoted(options.device)) + (generic ? " --generic" : "");
}

KernelTimes times_of(const std::filesystem::path& scene, const SpecialisedOptions& options, bool generic,
                     const std::filesystem::path& folder, double& pixels) {
  const std::filesystem::path cache = folder / "specialised_cache";
  std::filesystem::remove_all(cache);
  std::filesystem::create_directory(cache);
  KernelTimes times;
  std::vector<double> warm, render;
  for (int run = 0; run <= options.repetitions; ++run) {
    const ProcessTimes one =
        process_render(scene, options_text(options, generic), "POCL_CACHE_DIR=" + shell_quoted(cache), folder);
    pixels = one.pixels;
    if (run == 0)
      times.cold = one.build;
    else
      warm.push_back(one.build), render.push_back(one.render);
  }
  times.warm = quantile(warm, 0.5);
  times.render = quantile(render, 0.5);
  return times;
}

nlohmann::ordered_json times_json(const KernelTimes& times) {
  return {{"cold_build_s", times.cold}, {"warm_build_s", times.warm}, {"render_s", times.render}};
}

std::string ratio_text(double ratio) {
  char text[40];
  std::snprintf(text, sizeof text, "%.2f", ratio);
  return text;
}

std::string pixels_text(const std::optional<double>& pixels) {
  if (!pixels) return "never";
  const double side = std::sqrt(*pixels);
  return *pixels == 0 ? "any" : std::to_string(static_cast<int>(std::ceil(side))) + "²";
}

}  // namespace

std::optional<double> SpecialisedRow::break_even() const {
  const double waits = specialised.cold - generic.warm, gains = (generic.render - specialised.render) / pixels;
  if (waits <= 0) return 0;
  if (gains <= 0) return std::nullopt;
  return waits / gains;
}

std::vector<SpecialisedRow> specialised_run(const std::vector<std::filesystem::path>& scenes,
                                            const SpecialisedOptions& options, const std::filesystem::path& folder,
                                            const std::function<void(const SpecialisedRow&)>& report) {
  std::vector<SpecialisedRow> rows;
  for (const std::filesystem::path& scene : scenes) {
    SpecialisedRow row;
    row.scene = scene;
    row.specialised = times_of(scene, options, false, folder, row.pixels);
    row.generic = times_of(scene, options, true, folder, row.pixels);
    rows.push_back(row);
    report(row);
  }
  return rows;
}

std::string specialised_header() {
  std::string line = column("", -SCENE_WIDTH);
  for (const char* group : {"cold build", "warm build", "render"}) line += column(group, 22);
  line += "\n" + column("scene", -SCENE_WIDTH);
  for (int group = 0; group < 3; ++group) line += column("special.", 11) + column("generic", 11);
  return line + column("gain", 8) + column("break-even", 13) + "\n";
}

std::string specialised_text(const SpecialisedRow& row) {
  std::string line = column(text_printable(row.scene.filename().string()), -SCENE_WIDTH);
  const KernelTimes &s = row.specialised, &g = row.generic;
  for (const double seconds : {s.cold, g.cold, s.warm, g.warm, s.render, g.render})
    line += column(seconds_text(seconds), 11);
  const std::string pixels = pixels_text(row.break_even());
  const int bytes = pixels.find("²") == std::string::npos ? 0 : 1;  // two for one character
  return line + column(ratio_text(g.render / s.render), 8) + column(pixels, 13 + bytes) + "\n";
}

std::string specialised_legend() {
  return "\n"
         "cold, warm  seconds until the kernels are built: the first time, and when the driver has kept them\n"
         "gain        how many times as long generic kernels render\n"
         "break-even  pixels, at the scene's samples, from which building specialised kernels is sooner than taking\n"
         "            generic ones that are built already; never: those are as quick\n";
}

std::string specialised_json(const std::vector<SpecialisedRow>& rows) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const SpecialisedRow& row : rows) {
    const std::optional<double> pixels = row.break_even();
    list.push_back({{"scene", text_printable(row.scene.string())},
                    {"pixels", row.pixels},
                    {"specialised", times_json(row.specialised)},
                    {"generic", times_json(row.generic)},
                    {"break_even_pixels", pixels ? nlohmann::ordered_json(*pixels) : nlohmann::ordered_json()}});
  }
  return json_text({{"scenes", list}});
}

}  // namespace brume::bench
