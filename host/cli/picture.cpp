// See picture.hpp.
#include "cli/picture.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/out_of_memory.hpp"
#include "base/stopwatch.hpp"
#include "cli/picture_goal.hpp"
#include "film/film_partial.hpp"
#include "film/film_write.hpp"
#include "image/image_format.hpp"
#include "scene/scene_writer.hpp"

namespace brume {

namespace {

std::string size_text(glm::ivec2 size) { return std::to_string(size.x) + " x " + std::to_string(size.y) + " pixels"; }

std::filesystem::path part_output(const RenderArguments& arguments, ivec2 size) {
  if (arguments.trim || !part_size_problem(size, film_channels(arguments.aovs(), arguments.alpha)).empty()) return {};
  for (const std::filesystem::path& output : arguments.outputs)
    if (image_format_of_output(output).output == ImageOutput::LINEAR) return output;
  return {};
}

}  // namespace

void attempt(std::string& failures, const std::filesystem::path& file, const std::function<void()>& write) {
  try {
    with_memory(file.string(), write);
  } catch (const RuntimeError& error) {
    failures += (failures.empty() ? "" : "; ") + std::string(error.what());
  }
}

bool only_displayed(const RenderArguments& arguments) {
  return std::all_of(arguments.outputs.begin(), arguments.outputs.end(), [](const std::filesystem::path& output) {
    return image_format_of_output(output).output == ImageOutput::DISPLAY;
  });
}

void part_check(const RenderArguments& arguments, ivec2 size) {
  if (!arguments.partial || !part_output(arguments, size).empty()) return;
  if (arguments.trim) throw InputError("--partial: a picture cut out by --trim cannot be joined to others");
  const std::string problem = part_size_problem(size, film_channels(arguments.aovs(), arguments.alpha));
  throw InputError("--partial: " + (problem.empty() ? "expected an output of type .exr" : problem));
}

FlattenOptions flatten_options(const RenderArguments& arguments, int lanes) {
  return {bvh_width_for(lanes), arguments.crop_box(), arguments.alpha, arguments.witness != 0};
}

Prepared prepared_of(const RenderArguments& arguments, const SceneDesc& desc, LoadedScene& loaded, int lanes) {
  Prepared made;
  made.desc = desc;
  const bool asks_full = desc.render.level > 0 && arguments.witness != 0;
  loaded.needed_again = asks_full;  // one picture needs the files no longer
  made.flat = flatten(desc, loaded, flatten_options(arguments, lanes));
  if (asks_full) {
    SceneDesc full = desc;
    full.render.level = 0;
    loaded.needed_again = false;
    made.full = flatten(full, loaded, flatten_options(arguments, lanes));
  }
  made.notes = made.flat.all_notes();
  return made;
}

Prepared prepare(const RenderArguments& arguments, const SceneDesc& asked, LoadedScene& loaded, Context& context,
                 int lanes, const Say& say) {
  const std::string input = arguments.scene.string();
  const Stopwatch pilot;
  std::vector<std::string> notes;
  loaded.needed_again = asked.render.has_goal();
  const SceneDesc desc =
      with_memory(input, [&] { return picture_for_goal(arguments, asked, loaded, context, lanes, notes, say); });
  const double pilot_s = pilot.seconds();
  Prepared made = with_memory(input, [&] { return prepared_of(arguments, desc, loaded, lanes); });
  made.pilot_s = pilot_s;
  made.notes.insert(made.notes.begin(), notes.begin(), notes.end());
  return made;
}

Picture::Picture(const RenderArguments& arguments, const Prepared& prepared, Context& context, int lanes, bool sooner,
                 Say say, Say note)
    : arguments_(arguments),
      prepared_(prepared),
      context_(context),
      say_(std::move(say)),
      note_(std::move(note)),
      part_(with_memory("a film of " + size_text(prepared.desc.film.size),
                        [&] { return part_begin(arguments.resume, prepared.desc, prepared.flat); })),
      work_(work_missing(prepared.flat.frame, samples_parse(arguments.samples, prepared.desc.film.spp), part_.cover)),
      renderer_(context, prepared.flat, {lanes, arguments.generic, 0, sooner}),
      notes_(prepared.notes) {}

std::filesystem::path Picture::part_file() const { return part_output(arguments_, prepared_.desc.film.size); }

bool Picture::render(const Progress& progress) { return renderer_.render(part_.film, work_, progress); }

bool Picture::measure() {
  const SceneDesc& desc = prepared_.desc;
  try {
    if (!arguments_.samples.empty()) return true;
    error_ =
        picture_error(prepared_.true_scene(), part_.film, arguments_.witness, renderer_.stats().render_s, desc.render);
    // What is refined is no sum of the samples that parts are joined of.
    if (!arguments_.in_part() && arguments_.resume.empty())
      picture_refine_for_goal(arguments_, desc, prepared_.true_scene(), context_, renderer_, part_.film, error_, say_);
    return true;
  } catch (const Interrupted&) {
    return false;
  }
}

void Picture::notes_finish() {
  const std::size_t known = notes_.size();
  if (dropped_count(renderer_.stats())) notes_.push_back(dropped_note(renderer_.stats(), prepared_.flat.frame.cutoff));
  if (renderer_.stats().invalid_samples > 0) notes_.push_back(invalid_note(renderer_.stats()));
  const std::string missed = goal_missed_note(prepared_.desc.render, error_.witness);
  if (!missed.empty()) notes_.push_back(missed);
  for (std::size_t i = known; i < notes_.size(); ++i) note_(notes_[i]);
}

// cover: where the picture is one in part, what of it there is.
void Picture::write_outputs(const SampleCover* cover, std::string& failures) const {
  const SceneDesc& desc = prepared_.desc;
  const Film& film = part_.film;
  FilmWriteOptions options;
  options.cover = cover;
  options.exposure = desc.film.exposure;
  options.transfer = desc.film.transfer;
  options.aovs = arguments_.aovs();
  options.alpha = arguments_.alpha;
  const Frame& frame = prepared_.flat.frame;
  const Film trimmed =
      arguments_.trim ? film.cut({frame.crop_x0, frame.crop_y0}, {frame.crop_x1, frame.crop_y1}) : Film({0, 0});
  if (!arguments_.trim) options.window = {frame.crop_x0, frame.crop_y0, frame.crop_x1, frame.crop_y1};
  options.metadata = render_metadata(desc, prepared_.flat, context_.device(), renderer_.stats(), error_);
  if (cover) {
    options.window = cover->window(film.size().x);
    for (const auto& entry : part_metadata(desc, prepared_.flat))
      if (!metadata_find(options.metadata, entry.first)) options.metadata.push_back(entry);
  }
  for (const std::filesystem::path& output : arguments_.outputs)
    attempt(failures, output, [&] {
      film_write(arguments_.trim ? trimmed : film, output, options);
      std::printf("%s\n", output.string().c_str());
    });
}

void Picture::write(bool complete, std::string& failures) {
  notes_finish();
  std::optional<SampleCover> cover;
  if (!part_file().empty() && (arguments_.in_part() || !complete)) cover = cover_after(part_.cover, work_, part_.film);
  write_outputs(cover ? &*cover : nullptr, failures);
}

std::string Picture::stats_json(const RunTimes& times) const {
  return render_stats_json(prepared_.desc, prepared_.flat, context_.device(), renderer_.stats(), error_, times);
}

std::string Picture::summary(const RunTimes& times) const {
  return render_summary(prepared_.desc, prepared_.flat, context_.device(), renderer_.stats(), error_, times);
}

}  // namespace brume
