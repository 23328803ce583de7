// Which planes of a film become which channels of a file.
#include "film/film_write.hpp"

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
  std::vector<ImageChannel> channels;
  add_channels(channels, planes[0], {"R", "G", "B"});
  for (std::size_t i = 0; i < options.aovs.size(); ++i)
    add_channels(channels, planes[i + 1], aov_channel_names(options.aovs[i]));
  // With a prefix, because EXR gives plain names such as "version" and "type" a meaning of its own.
  ImageMetadata metadata;
  for (const auto& [key, value] : options.metadata) metadata.emplace_back("brume:" + key, value);
  image_write_exr(file, film.size().x, film.size().y, channels, metadata);
}

}  // namespace

void film_write(const Film& film, const std::filesystem::path& file, const FilmWriteOptions& options) {
  if (image_format_of_output(file).output == ImageOutput::LINEAR) return write_linear(film, file, options);
  image_write_display(file, film.size().x, film.size().y, film_display(film.radiance().values, options.exposure));
}

Image film_image(const Film& film) {
  return {film.size().x, film.size().y, 3, film.radiance().values, {"R", "G", "B"}, false, 0, "film"};
}

}  // namespace brume
