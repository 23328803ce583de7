// See render_part.hpp.
#include "cli/render_part.hpp"

#include <algorithm>
#include <cinttypes>
#include <cstdio>

#include "base/error.hpp"
#include "base/number_text.hpp"
#include "plan/scene_hash.hpp"
#include "scene/families.hpp"
#include "version.hpp"

namespace brume {

SampleRange samples_parse(const std::string& text, int spp) {
  if (text.empty()) return {0, std::uint32_t(spp)};
  unsigned first = 0, last = 0;
  int length = 0;
  const bool digits = text.find_first_not_of("0123456789-") == std::string::npos && text.size() < 16;
  if (!digits || std::sscanf(text.c_str(), "%u-%u%n", &first, &last, &length) != 2 || length != int(text.size()) ||
      first > last)
    throw InputError("--samples: expected A-B, two numbers with A <= B, got '" + text + "'");
  if (last >= unsigned(spp))
    throw InputError("--samples: the samples of a pixel are 0 to " + std::to_string(spp - 1) + ", got '" + text + "'");
  return {first, last - first + 1};
}

WorkList work_missing(const Frame& frame, SampleRange range, const SampleCover& held) {
  const WorkList all = work_all(frame);
  WorkList list;
  list.reserve(all.size());
  for (const PixelWork& work : all) {
    if (held.has_none(work.pixel))
      list.push_back({work.pixel, range.first, range.count});
    else
      for (const SampleRange& gap : held.missing(work.pixel, range)) list.push_back({work.pixel, gap.first, gap.count});
  }
  return list;
}

SampleCover cover_after(const SampleCover& held, const WorkList& work, const Film& film) {
  std::vector<std::uint32_t> rendered(film.pixels().size());
  for (std::size_t i = 0; i < rendered.size(); ++i) {
    rendered[i] = std::uint32_t(film.pixels()[i].samples + film.pixels()[i].invalid);
    for (const SampleRange& range : held.of(i)) rendered[i] -= range.count;
  }
  SampleCover cover = held;
  for (const PixelWork& entry : work) {  // each pixel's entries are rendered in order
    const std::uint32_t count = std::min(entry.samples, rendered[entry.pixel]);
    cover.add(entry.pixel, {entry.first_sample, count});
    rendered[entry.pixel] -= count;
  }
  return cover;
}

ImageMetadata part_metadata(const SceneDesc& desc, const PlannedScene& flat) {
  char hash[17];
  std::snprintf(hash, sizeof hash, "%016" PRIx64, scene_hash(flat));
  return {{"version", VERSION},
          {"size", std::to_string(desc.film.size.x) + "x" + std::to_string(desc.film.size.y)},
          {"spp", std::to_string(desc.film.spp)},
          {"seed", std::to_string(desc.render.seed)},
          {"scene_hash", hash},
          {"exposure", number_text(desc.film.exposure, 17)},
          {"transfer", std::string(family_name(transfer_family(), desc.film.transfer))},
          {"alpha", flat.frame.hides_background ? "1" : "0"}};
}

FilmPart part_begin(const std::filesystem::path& resume, const SceneDesc& desc, const PlannedScene& flat) {
  if (resume.empty()) {
    const std::size_t pixels = std::size_t(desc.film.size.x) * std::size_t(desc.film.size.y);
    return {"", {}, Film(desc.film.size), SampleCover(pixels), desc.film.spp};
  }
  FilmPart part = film_part_read(resume);
  SceneDesc begun = desc;
  // Samples do not depend on how many there are to be, but for a single one, which is the pixel's centre.
  if (part.spp > 1 && part.spp < desc.film.spp) begun.film.spp = part.spp;
  film_parts_match(desc.file.string(), part_metadata(begun, flat), part);
  part.spp = desc.film.spp;
  return part;
}

}  // namespace brume
