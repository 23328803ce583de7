// See sequence_report.hpp. Programs read the JSON keys: they stay as they are.
#include "cli/sequence_report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "base/atomic_file.hpp"
#include "base/frame_pattern.hpp"
#include "base/json_text.hpp"
#include "base/text_printable.hpp"
#include "cli/sequence_scene.hpp"

namespace brume {

namespace {

using Lock = std::lock_guard<std::mutex>;

std::string seconds_text(double s) {
  char text[40];
  std::snprintf(text, sizeof text, "%.2f s", s);
  return text;
}

std::string count_text(std::size_t count, const char* what) {
  return count == 0 ? "" : ", " + std::to_string(count) + " " + what;
}

}  // namespace

SequenceReport::SequenceReport(const RenderArguments& arguments, const std::vector<int>& frames)
    : arguments_(arguments), frames_(frames), bar_(arguments.quiet) {}

void SequenceReport::say(const std::string& text) {
  if (arguments_.quiet) return;
  bar_.clear();
  std::fprintf(stderr, "brume: %s\n", text_printable(text).c_str());
}

void SequenceReport::note(const std::string& text) {
  if (std::find(notes_.begin(), notes_.end(), text) != notes_.end()) return;
  notes_.push_back(text);
  say("note: " + text);
}

nlohmann::ordered_json SequenceReport::row(int frame, const char* state) const {
  nlohmann::ordered_json json{{"frame", frame}, {"state", state}, {"outputs", nlohmann::ordered_json::array()}};
  for (const std::filesystem::path& output : arguments_.of_frame(frame).outputs)
    json["outputs"].push_back(output.string());
  return json;
}

// With what the file of --stats says of them, where it is there from the run that rendered them.
void SequenceReport::kept(const std::vector<int>& frames) {
  std::map<int, nlohmann::ordered_json> before;
  std::ifstream in(arguments_.stats);
  const auto file = nlohmann::ordered_json::parse(in, nullptr, false);
  if (file.is_object() && file.contains("frames") && file["frames"].is_array())
    for (const auto& old : file["frames"])
      if (old.is_object() && old.contains("frame") && old["frame"].is_number_integer()) before[old["frame"]] = old;
  const Lock lock(access_);
  for (const int frame : frames) {
    rows_[frame] = row(frame, "kept");
    if (const auto old = before.find(frame); old != before.end() && old->second["outputs"] == rows_[frame]["outputs"]) {
      rows_[frame] = old->second;
      rows_[frame]["state"] = "kept";
    }
  }
  kept_ = frames;
}

void SequenceReport::row_failed(int frame, const std::string& why) {
  const Lock lock(access_);
  failed_.push_back(frame);
  rows_[frame] = row(frame, "failed");
  rows_[frame]["why"] = text_printable(why);
}

// Told whatever --quiet says: it is why the exit code is 1.
void SequenceReport::failed(int frame, const std::string& why) {
  row_failed(frame, why);
  bar_.clear();
  std::fprintf(stderr, "brume: frame %d is left out: %s\n", frame, text_printable(why).c_str());
}

void SequenceReport::missing(const std::map<int, std::vector<std::filesystem::path>>& files) {
  std::vector<int> frames;
  for (const auto& [frame, names] : files) {
    frames.push_back(frame);
    row_failed(frame, names.front().string() + ": " + NOT_THERE);
  }
  const std::string first = files.at(frames.front()).front().string();
  std::fprintf(stderr, "brume: left out, since files are missing: %s, the first %s: %s\n", frames_name(frames).c_str(),
               text_printable(first).c_str(), NOT_THERE);
}

void SequenceReport::progress(int frame, double share) {
  const auto all = static_cast<double>(frames_.size() - kept_.size());
  bar_.show((static_cast<double>(done()) + share) / all, "frame " + std::to_string(frame) + ", " +
                                                             std::to_string(done() + 1) + " of " +
                                                             std::to_string(frames_.size() - kept_.size()));
}

void SequenceReport::rendered(int frame, const std::string& stats_json, double waited_s) {
  const auto stats = nlohmann::ordered_json::parse(stats_json);
  const double load_s = stats["load_s"], render_s = stats["render_s"];
  {
    const Lock lock(access_);
    if (done() > 0) {
      load_s_ += load_s;
      waited_s_ += waited_s;
      render_s_ += render_s;
    }
    rendered_.push_back(frame);
    rows_[frame] = row(frame, "rendered");
    rows_[frame]["waited_s"] = waited_s;
    rows_[frame].update(stats);
  }
  const std::size_t all = frames_.size() - kept_.size();
  const double share = static_cast<double>(done()) / static_cast<double>(all);
  const std::string left = done() < all ? time_left(since_start_.seconds(), share) : "";
  say("frame " + std::to_string(frame) + ", " + std::to_string(done()) + " of " + std::to_string(all) + ": render " +
      seconds_text(render_s) + ", load " + seconds_text(load_s) + " of which " + seconds_text(waited_s) +
      " waited for" + (left.empty() ? "" : "; " + left));
}

bool SequenceReport::any_failed() const { return !failed_.empty(); }

void SequenceReport::stats_write() {
  if (arguments_.stats.empty()) return;
  nlohmann::ordered_json json;
  {
    const Lock lock(access_);
    json = {{"frames", nlohmann::ordered_json::array()},
            {"rendered", rendered_.size()},
            {"kept", kept_.size()},
            {"failed", failed_.size()},
            {"total_s", since_start_.seconds()},
            {"after_the_first", {{"render_s", render_s_}, {"load_s", load_s_}, {"waited_s", waited_s_}}}};
    for (const int frame : frames_)
      if (const auto found = rows_.find(frame); found != rows_.end()) json["frames"].push_back(found->second);
  }
  atomic_write(arguments_.stats, json_line(json, 3) + "\n");
}

std::string SequenceReport::summary() const {
  std::string text = std::to_string(frames_.size()) + " frames in " + seconds_text(since_start_.seconds()) + ": " +
                     std::to_string(rendered_.size()) + " rendered" + count_text(kept_.size(), "kept") +
                     count_text(failed_.size(), "left out");
  if (load_s_ > 0) {
    const long hidden = std::lround(100 * std::max(0.0, 1 - waited_s_ / load_s_));
    text += "; after the first " + seconds_text(load_s_) + " of loading beside " + seconds_text(render_s_) +
            " of rendering, " + std::to_string(hidden) + " % of it hidden";
  }
  return text;
}

std::string SequenceReport::finished() const {
  const Lock lock(access_);
  std::vector<int> whole = kept_;
  whole.insert(whole.end(), rendered_.begin(), rendered_.end());
  std::sort(whole.begin(), whole.end());
  if (whole.empty()) return "no frame is finished";
  return "finished: " + frames_name(whole) + "; the same command goes on";
}

}  // namespace brume
