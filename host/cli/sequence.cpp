// See sequence.hpp.
#include "cli/sequence.hpp"

#include <algorithm>
#include <exception>
#include <set>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/foreign_lines.hpp"
#include "base/interrupt.hpp"
#include "base/text_printable.hpp"
#include "cli/camera_file.hpp"
#include "cli/output_files.hpp"
#include "cli/picture.hpp"
#include "cli/sequence_loader.hpp"
#include "cli/sequence_report.hpp"
#include "cli/sequence_scene.hpp"
#include "image/image_format.hpp"
#include "scene/scene_writer.hpp"

namespace brume {

namespace {

// Pictures of a sequence are often named as what they are made of.
void outputs_check(const RenderArguments& arguments, const SequenceScene& scene, int first) {
  const RenderArguments one = arguments.of_frame(first);
  std::vector<NamedFile> files;
  for (const std::filesystem::path& output : one.outputs) files.push_back({"-o", output});
  files.insert(
      files.end(),
      {{"--stats", arguments.stats}, {"--save-scene", arguments.save_scene}, {"--save-camera", arguments.save_camera}});
  std::vector<NamedFile> inputs{{"the input", one.scene}, {"--camera", one.camera}};
  for (const std::filesystem::path& file : scene.files(first)) inputs.push_back({"the scene's", file});
  output_files_check(files, inputs);
  for (const std::filesystem::path& output : one.outputs) image_check_writable(output);
  if (!arguments.stats.empty()) AtomicFile(arguments.stats);
}

// Of the sequence, not of what is chosen for a goal of a frame.
void scene_save(const RenderArguments& arguments, const SequenceScene& scene, int first) {
  if (!arguments.save_scene.empty()) {
    if (scene.scene_each()) throw InputError("--save-scene: every frame has a scene of its own already");
    atomic_write(arguments.save_scene, scene_write(scene.describe_all(first), arguments.save_scene.parent_path()));
  }
  if (!arguments.save_camera.empty()) camera_save(arguments.save_camera, scene.describe(first).camera);
}

// The frames that are to be rendered and can be; the others are told before the first of them.
std::vector<int> frames_begin(const RenderArguments& arguments, const SequenceScene& scene,
                              const std::vector<int>& wanted, SequenceReport& report) {
  const auto missing = frames_missing(scene, wanted);
  if (missing.empty()) return wanted;
  report.missing(missing);
  if (arguments.strict) throw InputError("stopped by --strict before the first frame");
  std::vector<int> frames;
  for (const int frame : wanted)
    if (!missing.count(frame)) frames.push_back(frame);
  return frames;
}

class Sequence {
 public:
  Sequence(const RenderArguments& arguments, const SequenceScene& scene, SequenceReport& report)
      : arguments_(arguments), report_(report), loader_(arguments, scene) {}

  void run(const std::vector<int>& frames) {
    const auto at = [&](std::size_t i) { return i < frames.size() ? std::optional<int>(frames[i]) : std::nullopt; };
    loader_.begin(frames.front(), at(1));
    const DeviceInfo device = device_choose(arguments_.device);
    const int lanes = lanes_choose(device, arguments_.lanes);
    Context context(device);
    loader_.lanes_known(lanes);
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const Stopwatch watch;
      try {
        std::optional<LoadedFrame> frame = taken(frames[i]);
        const double waited_s = watch.seconds();
        std::optional<Prepared> prepared = frame ? settled(frames[i], *frame, context, lanes) : std::nullopt;
        interrupt_check();
        if (at(i + 1)) loader_.begin(*at(i + 1), at(i + 2));
        if (prepared) render(frames[i], *prepared, {frame->load_s, prepared->pilot_s, 0}, waited_s, context, lanes);
      } catch (const Interrupted&) {
        leave();
      }
    }
  }

 private:
  // Nothing where the frame is damaged, which is told. What two frames say alike is no damage but the scene's mistake.
  template <class Work>
  auto unless_damaged(int frame, Work work) -> std::optional<decltype(work())> {
    std::string why;
    try {
      return work();
    } catch (const InputError& error) {
      why = error.what();
    } catch (const RuntimeError& error) {  // of memory, and of helper programs
      why = error.what();
    }
    if (arguments_.strict || !known_.insert(why).second) throw InputError(why);
    report_.failed(frame, why);
    return std::nullopt;
  }

  std::optional<LoadedFrame> taken(int frame) {
    return unless_damaged(frame, [&] { return loader_.take(); });
  }

  std::optional<Prepared> settled(int frame, LoadedFrame& loaded, Context& context, int lanes) {
    if (loaded.prepared) return std::move(loaded.prepared);
    return unless_damaged(frame, [&] {
      return prepare(arguments_.of_frame(frame), loaded.asked, loaded.loaded, context, lanes,
                     [&](const std::string& text) { report_.say("frame " + std::to_string(frame) + ": " + text); });
    });
  }

  void render(int frame, const Prepared& prepared, RunTimes times, double waited_s, Context& context, int lanes) {
    const RenderArguments one = arguments_.of_frame(frame);
    const Stopwatch watch;
    part_check(one, prepared.desc.film.size);
    Picture picture(
        one, prepared, context, lanes, false, [&](const std::string& text) { report_.say(text); },
        [&](const std::string& text) { report_.note(text); });
    for (const std::string& note : prepared.notes) report_.note(note);
    const bool complete = picture.render([&](double share) {
      report_.progress(frame, share);
      return !interrupt_requested();
    });
    if (!complete || !picture.measure()) throw Interrupted("");
    report_.progress_clear();
    std::string failures;
    picture.write(true, failures);
    if (!failures.empty()) throw RuntimeError(failures);
    times.total_s = watch.seconds() + waited_s;
    report_.rendered(frame, picture.stats_json(times), waited_s);
  }

  // At once: what is being loaded is not waited for.
  [[noreturn]] void leave() {
    interrupt_claim();
    report_.stats_write();
    interrupt_leave(("interrupted; " + report_.finished()).c_str());
  }

  const RenderArguments& arguments_;
  SequenceReport& report_;
  SequenceLoader loader_;
  std::set<std::string> known_;
};

}  // namespace

int sequence_render(const RenderArguments& arguments) {
  const std::vector<int> frames = frames_parse("--frames", arguments.frames);
  sequence_check(arguments);
  SequenceReport report(arguments, frames);
  const SequenceScene scene(arguments, frames, [&](const std::string& text) { report.say(text); });
  const std::vector<int> finished = arguments.overwrite ? std::vector<int>() : frames_finished(arguments, frames);
  report.kept(finished);
  if (!finished.empty())
    report.say("kept: " + frames_name(finished) + ", whose pictures are there; --overwrite renders them again");
  std::vector<int> wanted;
  std::set_difference(frames.begin(), frames.end(), finished.begin(), finished.end(), std::back_inserter(wanted));
  outputs_check(arguments, scene, wanted.empty() ? frames.front() : wanted.front());
  scene_save(arguments, scene, frames.front());
  const std::vector<int> todo = frames_begin(arguments, scene, wanted, report);
  const auto line = [](const std::string& text) { message_write(("brume: " + text_printable(text) + "\n").c_str()); };
  const InterruptRescue rescue([&] {
    line(report.finished());
    try {
      report.stats_write();
    } catch (const std::exception& error) {
      line(error.what());
    }
  });
  try {
    if (!todo.empty()) Sequence(arguments, scene, report).run(todo);
  } catch (const std::exception&) {
    report.say(report.finished());
    report.stats_write();
    throw;
  }
  report.stats_write();
  report.say(report.summary());
  return report.any_failed() || (arguments.strict && report.noted()) ? 1 : 0;
}

}  // namespace brume
