// See chart_folder.hpp.
#include "chart/chart_folder.hpp"

#include <algorithm>
#include <system_error>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "chart/chart_text.hpp"
#include "chart/pictures.hpp"

namespace brume {

namespace {

namespace fs = std::filesystem;

template <std::size_t N>
std::string list_text(const std::array<int, N>& values) {
  std::string text;
  for (const int value : values) text += (text.empty() ? "" : ",") + std::to_string(value);
  return text;
}

}  // namespace

std::string identity_difference(const ChartIdentity& there, const ChartIdentity& here) {
  const auto flag = [](bool b) { return std::string(b ? "on" : "off"); };
  const struct {
    const char* what;
    std::string there, here;
  } parts[] = {{"the scene", there.hash, here.hash},
               {"--size", list_text(there.size), list_text(here.size)},
               {"--crop", list_text(there.crop), list_text(here.crop)},
               {"--spp", std::to_string(there.spp), std::to_string(here.spp)},
               {"--seed", std::to_string(there.seed), std::to_string(here.seed)},
               {"the device", there.device, here.device},
               {"--lanes", std::to_string(there.lanes), std::to_string(here.lanes)},
               {"--generic", flag(there.generic), flag(here.generic)},
               {"the version of brume", there.version, here.version}};
  for (const auto& part : parts)
    if (part.there != part.here)
      return std::string(part.what) + " is " + part.there + " there and " + part.here + " here";
  return "";
}

ChartFolder::ChartFolder(const fs::path& folder, const ChartIdentity& identity, bool overwrite) : folder_(folder) {
  const fs::path json = file("chart.json");
  std::error_code failure;
  if (fs::exists(json, failure) && !overwrite) {
    try {
      kept_ = chart_read(json);
    } catch (const InputError& error) {
      throw InputError(std::string(error.what()) + "; allowed: another folder, or --overwrite");
    }
    const std::string difference = identity_difference(kept_.identity, identity);
    if (!difference.empty())
      throw InputError(json.string() + ": is another chart, of " + kept_.identity.scene + ": " + difference +
                       "; allowed: another folder, or --overwrite");
    same_ = true;
    auto& points = kept_.points;
    points.erase(std::remove_if(points.begin(), points.end(),
                                [&](const ChartPoint& p) {
                                  return !fs::exists(picture_file(p.knobs)) || !fs::exists(error_file(p.knobs));
                                }),
                 points.end());
  }
  if (fs::exists(folder_, failure) && !fs::is_directory(folder_, failure))
    throw InputError("-o " + folder_.string() + ": is a file, expected a folder");
  made_ = fs::create_directories(folder_ / "points", failure);
  if (failure) throw RuntimeError(folder_.string() + ": cannot be made: " + failure.message());
  AtomicFile probe(json);  // that it can be written is known before anything is rendered
}

ChartFolder::~ChartFolder() {
  std::error_code ignored;
  if (!made_) return;
  fs::remove(folder_ / "points", ignored);  // neither is removed where something is in it
  fs::remove(folder_, ignored);
}

fs::path ChartFolder::exact_file(int spp) const { return folder_ / ("exact-spp" + std::to_string(spp) + ".exr"); }
fs::path ChartFolder::picture_file(const Knobs& knobs) const { return folder_ / "points" / (knobs_id(knobs) + ".jpg"); }
fs::path ChartFolder::error_file(const Knobs& knobs) const {
  return folder_ / "points" / (knobs_id(knobs) + "-error.jpg");
}

std::optional<Image> ChartFolder::exact_read(int spp, int width, int height) const {
  const fs::path file = exact_file(spp);
  if (!same_ || !fs::exists(file)) return std::nullopt;
  Image image = image_read(file);
  // Channels of a file are in the order of their names.
  const int rgb[] = {image_channel(image, "R"), image_channel(image, "G"), image_channel(image, "B")};
  if (image.width != width || image.height != height || *std::min_element(rgb, rgb + 3) < 0) return std::nullopt;
  Image exact{width, height, 3, {}, {"R", "G", "B"}, false, 0, file.string()};
  for (std::size_t i = 0; i < image.values.size(); i += std::size_t(image.channels))
    for (const int c : rgb) exact.values.push_back(image.values[i + std::size_t(c)]);
  return exact;
}

void ChartFolder::exact_write(int spp, const Image& image) const {
  std::vector<ImageChannel> channels;
  for (std::size_t c = 0; c < 3; ++c) channels.push_back({image.channel_names[c], image.values.data() + c, 3});
  image_write_exr(exact_file(spp), image.width, image.height, channels, {});
}

void ChartFolder::exact_show(const Image& image, const FilmDesc& film) const {
  picture_write(image, film, file("exact.jpg"));
}

void ChartFolder::point_write(const Knobs& knobs, const Image& image, const Image& exact, const FilmDesc& film) const {
  picture_write(image, film, picture_file(knobs));
  error_map_write(image, exact, error_file(knobs));
}

void ChartFolder::json_write(const Chart& chart) const { atomic_write(file("chart.json"), chart_json(chart)); }

}  // namespace brume
