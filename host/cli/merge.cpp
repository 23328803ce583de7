// brume merge: pictures in part → one picture. Crops, ranges of samples or interrupted renders of one scene.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "base/error.hpp"
#include "base/foreign_lines.hpp"
#include "base/out_of_memory.hpp"
#include "base/text_printable.hpp"
#include "cli/command.hpp"
#include "cli/output_files.hpp"
#include "cli/render_arguments.hpp"
#include "film/film_partial.hpp"
#include "film/film_write.hpp"
#include "image/image_format.hpp"
#include "scene/families.hpp"

namespace brume {

namespace {

struct MergeArguments {
  std::vector<std::filesystem::path> parts, outputs;
  std::string aov;
  std::optional<double> exposure;
};

struct Merged {
  FilmPart whole;                                           // of all parts so far
  std::vector<std::pair<std::string, SampleCover>> covers;  // of each of them, to name the one that overlaps

  [[noreturn]] void fail_overlap(const FilmPart& part, std::size_t pixel, SampleRange range) const {
    for (const auto& [source, cover] : covers)
      if (const auto sample = cover.held(pixel, range))
        throw InputError(part.source + ": overlaps " + source + ": both hold sample " + std::to_string(*sample) +
                         " of pixel " + pixel_text(pixel, part.film.size().x));
    throw RuntimeError(part.source + ": overlaps what none of the others holds");
  }

  void add(FilmPart&& part) {
    film_parts_match(whole.source, whole.metadata, part);
    for (std::size_t i = 0; i < part.cover.pixels(); ++i) {
      const std::vector<SampleRange> ranges = part.cover.of(i);
      for (const SampleRange& range : ranges) {
        if (whole.cover.held(i, range)) fail_overlap(part, i, range);
        whole.cover.add(i, range);
      }
      if (!ranges.empty()) film_pixel_merge(whole.film.pixels()[i], part.film.pixels()[i]);
    }
    keep_common_metadata(part);
    covers.emplace_back(part.source, std::move(part.cover));
  }

  // What all parts say alike: the device, say, where it was one.
  void keep_common_metadata(const FilmPart& part) {
    ImageMetadata common;
    for (const auto& [key, value] : whole.metadata)
      if (part.value(key) == value) common.emplace_back(key, value);
    whole.metadata = common;
  }
};

FilmPart part_read(const std::filesystem::path& file) {
  return with_memory(file.string(), [&] { return film_part_read(file); });
}

FilmPart merge(const std::vector<std::filesystem::path>& files) {
  Merged merged{part_read(files.front()), {}};
  merged.covers.emplace_back(merged.whole.source, merged.whole.cover);
  for (std::size_t i = 1; i < files.size(); ++i) merged.add(part_read(files[i]));
  return std::move(merged.whole);
}

// What the picture still lacks; "" where nothing.
std::string missing_text(const FilmPart& part) {
  std::size_t pixels = 0, incomplete = 0, samples = 0;
  std::string first_pixel, first_samples;
  const int width = part.film.size().x;
  for (std::size_t i = 0; i < part.cover.pixels(); ++i) {
    const std::vector<SampleRange> gaps = part.cover.missing(i, {0, std::uint32_t(part.spp)});
    if (gaps.empty()) continue;
    if (part.cover.of(i).empty()) {
      if (pixels++ == 0) first_pixel = pixel_text(i, width);
      continue;
    }
    if (incomplete++ == 0)
      first_samples =
          std::to_string(gaps[0].first) + "-" + std::to_string(gaps[0].end() - 1) + " of " + pixel_text(i, width);
    for (const SampleRange& gap : gaps) samples += gap.count;
  }
  std::string text;
  if (pixels > 0)
    text = std::to_string(pixels) + " of " + std::to_string(part.cover.pixels()) + " pixels are missing, the first " +
           first_pixel;
  if (incomplete > 0)
    text += (text.empty() ? "" : "; ") + std::to_string(samples) + " samples are missing in " +
            std::to_string(incomplete) + " other pixels, the first " + first_samples;
  return text;
}

// An .exr of it could be joined again.
void check_size(const MergeArguments& arguments, const FilmPart& whole) {
  const std::string problem =
      part_size_problem(whole.film.size(), film_channels(aovs_parse(arguments.aov), whole.value("alpha") == "1"),
                        whole.cover.layers().size());
  for (const auto& output : arguments.outputs)
    if (!problem.empty() && image_format_of_output(output).output == ImageOutput::LINEAR)
      throw InputError(output.string() + ": " + problem);
}

int merge_run(MergeArguments arguments) {
  std::vector<NamedFile> outputs, inputs;
  for (const auto& output : arguments.outputs) outputs.push_back({"-o", output});
  for (const auto& part : arguments.parts) inputs.push_back({"the part", part});
  output_files_check(outputs, inputs);
  for (const auto& output : arguments.outputs) image_check_writable(output);
  FilmWriteOptions options;
  options.aovs = aovs_parse(arguments.aov);
  const FilmPart whole = merge(arguments.parts);
  check_size(arguments, whole);
  options.metadata = whole.metadata;
  options.cover = &whole.cover;
  options.window = whole.cover.window(whole.film.size().x);
  options.alpha = whole.value("alpha") == "1";
  options.exposure = arguments.exposure ? *arguments.exposure : std::strtod(whole.value("exposure").c_str(), nullptr);
  if (const FamilyRow* row = family_find(transfer_family(), whole.value("transfer"))) options.transfer = row->id;
  const std::string missing = missing_text(whole);
  if (!missing.empty()) note_write(missing);
  for (const auto& output : arguments.outputs) {
    film_write(whole.film, output, options);
    std::printf("%s\n", output.string().c_str());
  }
  return 0;
}

}  // namespace

void command_merge(CLI::App& app, Command& run) {
  CLI::App* command = app.add_subcommand(
      "merge",
      "Join crops, ranges of samples and interrupted renders of one scene (.exr written by brume render "
      "--crop, --samples, --partial or after Ctrl-C)");
  auto arguments = std::make_shared<MergeArguments>();
  command->add_option("parts", arguments->parts, "Parts of one picture: same scene, size, spp, seed and version")
      ->required();
  command
      ->add_option("-o,--output", arguments->outputs,
                   "Picture: .exr (which can be joined again), .png, .jpg. Repeatable")
      ->allow_extra_args(false)
      ->required();
  command->add_option("--exposure", arguments->exposure, "Stops for the display formats; default: that of the render");
  command->add_option("--aov", arguments->aov, "Comma-separated planes for .exr: " + family_names(aov_family()));
  command->callback([arguments, &run] { run = [arguments] { return merge_run(*arguments); }; });
}

}  // namespace brume
