// What became of the frames of a sequence: the lines for the terminal and the file of --stats. Told from the thread
// that renders, and from the one that ends the program.
#pragma once
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/stopwatch.hpp"
#include "cli/progress.hpp"
#include "cli/render_arguments.hpp"

namespace brume {

class SequenceReport {
 public:
  SequenceReport(const RenderArguments& arguments, const std::vector<int>& frames);

  void say(const std::string& text);
  void note(const std::string& text);  // each once, however many frames say the same
  bool noted() const { return !notes_.empty(); }

  void kept(const std::vector<int>& frames);       // were there already
  void failed(int frame, const std::string& why);  // is told, and left out
  // The same of all whose files are not there, in one line.
  void missing(const std::map<int, std::vector<std::filesystem::path>>& files);
  void progress(int frame, double share);  // of the frame that is rendered
  void progress_clear() { bar_.clear(); }  // before anything else is printed
  void rendered(int frame, const std::string& stats_json, double waited_s);
  bool any_failed() const;

  void stats_write();            // --stats; as far as it goes, at any time
  std::string summary() const;   // how many of what, and how much of the loading was waited for
  std::string finished() const;  // "frames 1-4 are finished"

 private:
  void row_failed(int frame, const std::string& why);
  nlohmann::ordered_json row(int frame, const char* state) const;
  std::size_t done() const { return rendered_.size() + failed_.size(); }

  const RenderArguments& arguments_;
  const std::vector<int> frames_;
  mutable std::mutex access_;
  std::vector<int> kept_, rendered_, failed_;
  std::map<int, nlohmann::ordered_json> rows_;
  std::vector<std::string> notes_;
  double load_s_ = 0, waited_s_ = 0, render_s_ = 0;  // of all frames but the first, which nothing could hide
  Stopwatch since_start_;
  ProgressBar bar_;
};

}  // namespace brume
