// Which planes of a film become which channels of a file.
#include "film/film_write.hpp"

#include <optional>

#include "film/film_display.hpp"
#include "image/image_format.hpp"

namespace brume {

namespace {

void add_channels(std::vector<ImageChannel>& channels, const Plane& plane, const std::vector<std::string>& names) {
  for (std::size_t c = 0; c < names.size(); ++c) channels.push_back({names[c], plane.values.data() + c, names.size()});
}

void write_linear(const Film& film, const std::filesystem::path& file, const FilmWriteOptions& options) {
  std::vector<Plane> planes = {film.radiance()};
  for (Aov aov : options.aovs) planes.push_back(film.aov(aov));
  if (options.alpha) planes.push_back(film.alpha());
  std::vector<ImageChannel> channels;
  add_channels(channels, planes.front(), {"R", "G", "B"});
  if (options.alpha) add_channels(channels, planes.back(), {"A"});
  for (std::size_t i = 0; i < options.aovs.size(); ++i)
    add_channels(channels, planes[i + 1], aov_channel_names(options.aovs[i]));
  std::optional<PartChannels> part;
  if (options.cover) {
    part.emplace(film, *options.cover);
    channels.insert(channels.end(), part->channels.begin(), part->channels.end());
  }
  // With a prefix, because EXR gives plain names such as "version" and "type" a meaning of its own.
  ImageMetadata metadata;
  for (const auto& [key, value] : options.metadata) metadata.emplace_back("brume:" + key, value);
  image_write_exr(file, film.size().x, film.size().y, channels, metadata, options.window);
}

// Four display values per pixel. The curve is not linear: it is applied to the colour before alpha is multiplied in.
std::vector<float> display_alpha(const std::vector<float>& radiance, const Plane& alpha,
                                 const FilmWriteOptions& options) {
  std::vector<float> rgba;
  rgba.reserve(alpha.values.size() * 4);
  for (std::size_t i = 0; i < alpha.values.size(); ++i) {
    const float a = alpha.values[i];
    for (std::size_t c = 0; c < 3; ++c)
      rgba.push_back(film_display(a > 0 ? radiance[3 * i + c] / a : 0.0f, options.exposure, options.transfer));
    rgba.push_back(a);
  }
  return rgba;
}

}  // namespace

int film_channels(const std::vector<Aov>& aovs, bool alpha) {
  int channels = alpha ? 4 : 3;
  for (const Aov aov : aovs) channels += aov_channels(aov);
  return channels;
}

void film_write(const Film& film, const std::filesystem::path& file, const FilmWriteOptions& options) {
  if (image_format_of_output(file).output == ImageOutput::LINEAR) return write_linear(film, file, options);
  const std::vector<float> radiance = film.radiance().values;
  if (options.alpha && image_format_of_output(file).alpha)
    return image_write_display(file, film.size().x, film.size().y, display_alpha(radiance, film.alpha(), options),
                               true);
  image_write_display(file, film.size().x, film.size().y, film_display(radiance, options.exposure, options.transfer));
}

Image film_image(const Film& film, glm::ivec2 lo, glm::ivec2 hi) {
  return {hi.x - lo.x, hi.y - lo.y, 3, film.radiance(lo, hi).values, {"R", "G", "B"}, false, 0, "film"};
}

}  // namespace brume
