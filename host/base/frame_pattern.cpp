// See frame_pattern.hpp.
#include "base/frame_pattern.hpp"

#include <cstdio>
#include <optional>
#include <set>
#include <sstream>

#include "base/error.hpp"

namespace brume {

namespace {

constexpr int FRAME_MAX = 999'999'999;
constexpr std::size_t FRAMES_MAX = 1'000'000;
constexpr int RUNS_TOLD = 8;

struct Place {
  std::size_t begin, length;
  int digits;
};

// The first %d or %0Nd from `from` on.
std::optional<Place> place_find(const std::string& text, std::size_t from) {
  for (std::size_t at = text.find('%', from); at != std::string::npos; at = text.find('%', at + 1)) {
    if (text.compare(at, 2, "%d") == 0) return Place{at, 2, 1};
    const bool padded = at + 3 < text.size() && text[at + 1] == '0' && text[at + 3] == 'd';
    if (padded && text[at + 2] >= '1' && text[at + 2] <= '9') return Place{at, 4, text[at + 2] - '0'};
  }
  return std::nullopt;
}

std::string number_padded(int number, int digits) {
  char text[16];
  std::snprintf(text, sizeof text, "%0*d", digits, number);
  return text;
}

struct Run {
  int first, last, step;
};

// "A", "A-B" or "A-B:S".
std::optional<Run> run_parse(const std::string& text) {
  long first = 0, last = 0, step = 1;
  int length = 0;
  if (text.empty() || text.size() > 32 || text.find_first_not_of("0123456789-:") != std::string::npos) return {};
  const auto whole = [&](int read, int wanted) { return read == wanted && length == static_cast<int>(text.size()); };
  if (!whole(std::sscanf(text.c_str(), "%9ld-%9ld:%9ld%n", &first, &last, &step, &length), 3)) {
    step = 1;
    if (!whole(std::sscanf(text.c_str(), "%9ld-%9ld%n", &first, &last, &length), 2)) {
      if (!whole(std::sscanf(text.c_str(), "%9ld%n", &first, &length), 1)) return {};
      last = first;
    }
  }
  if (first < 0 || last < first || last > FRAME_MAX || step < 1) return {};
  return Run{static_cast<int>(first), static_cast<int>(last), static_cast<int>(step)};
}

}  // namespace

bool frame_pattern(const std::string& text) { return place_find(text, 0).has_value(); }

std::string frame_name(const std::string& text, int frame) {
  std::string name;
  std::size_t done = 0;
  while (const std::optional<Place> place = place_find(text, done)) {
    name += text.substr(done, place->begin - done) + number_padded(frame, place->digits);
    done = place->begin + place->length;
  }
  return name + text.substr(done);
}

std::vector<int> frames_parse(const std::string& option, const std::string& text) {
  std::set<int> frames;
  const auto refuse = [&](const std::string& cause) { throw InputError(option + cause + ", got '" + text + "'"); };
  std::istringstream parts(text + ",");
  for (std::string part; std::getline(parts, part, ',');) {
    const std::optional<Run> run = run_parse(part);
    if (!run) refuse(": expected A-B, A-B:STEP or A with 0 <= A <= B, e.g. 1-60");
    if (frames.size() + static_cast<std::size_t>((run->last - run->first) / run->step) >= FRAMES_MAX)
      refuse(": more than " + std::to_string(FRAMES_MAX) + " frames");
    for (long frame = run->first; frame <= run->last; frame += run->step) frames.insert(static_cast<int>(frame));
  }
  return {frames.begin(), frames.end()};
}

std::string frames_name(const std::vector<int>& frames) {
  std::string text = frames.size() == 1 ? "frame " : "frames ";
  int runs = 0;
  for (std::size_t i = 0; i < frames.size(); ++runs) {
    if (runs == RUNS_TOLD) return text + " and " + std::to_string(frames.size() - i) + " more";
    std::size_t end = i + 1;
    while (end < frames.size() && frames[end] == frames[end - 1] + 1) ++end;
    text += (runs == 0 ? "" : ", ") + std::to_string(frames[i]);
    if (end - i > 1) text += "-" + std::to_string(frames[end - 1]);
    i = end;
  }
  return text;
}

}  // namespace brume
