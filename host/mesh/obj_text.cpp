// See obj_text.hpp.
#include "mesh/obj_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

#include "base/error.hpp"
#include "base/file_read.hpp"

namespace brume {

namespace {

using Path = std::filesystem::path;

constexpr std::size_t OBJ_BYTES_MAX = std::size_t(1) << 30;

[[noreturn]] void fail(const Path& file, const std::string& cause) { throw InputError(file.string() + ": " + cause); }

// Takes the next word off the line; empty at its end.
std::string_view word_take(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(" \t"));
  line.remove_prefix(word.size());
  return word;
}

bool is_number(std::string_view word) {
  if (word.find_first_not_of("+-.0123456789eE") != std::string_view::npos) return false;
  if (word.substr(0, 1) == "+") word.remove_prefix(1);
  double value;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error != std::errc::invalid_argument && end == word.data() + word.size();
}

// What the corners of faces index, in the order in which a corner names them: v/vt/vn.
struct Kind {
  const char *keyword, *name;
  int numbers;  // at least
  std::size_t count = 0;
  int largest = 0;  // index so far, and the line that names it: vertices may follow their faces
  std::size_t line = 0;
};

class Reader {
 public:
  explicit Reader(const Path& file) : file_(file) {}

  ObjText run() {
    const std::string text = file_read_text(file_, OBJ_BYTES_MAX, "an OBJ file");
    for (std::string_view rest = text; !rest.empty();) line_read(line_take(rest));
    for (const Kind& kind : kinds_)
      if (kind.largest > 0 && static_cast<std::size_t>(kind.largest) > kind.count)
        refuse_index(kind, kind.largest, kind.line);
    return std::move(out_);
  }

 private:
  [[noreturn]] void refuse(std::size_t line, const std::string& cause) const {
    fail(file_, "line " + std::to_string(line) + ": " + cause);
  }
  [[noreturn]] void refuse_index(const Kind& kind, int index, std::size_t line) const {
    refuse(line, "names " + std::string(kind.name) + " " + std::to_string(index) + "; the file has " +
                     std::to_string(kind.count) + (index < 0 ? " before it" : ""));
  }

  // A line with those that continue it: "\" at the end of a line does.
  std::string line_take(std::string_view& rest) {
    std::string line;
    first_ = next_;
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
      line += rest.substr(0, end);
      rest.remove_prefix(end);
      rest.remove_prefix(rest.substr(0, 2) == "\r\n" ? 2 : std::min<std::size_t>(1, rest.size()));
      ++next_;
      if (line.empty() || line.back() != '\\' || rest.empty()) break;
      line.back() = ' ';
    }
    return line;
  }

  void line_read(std::string line) {
    std::string_view words = line;
    const std::string_view keyword = word_take(words);
    const auto kind = std::find_if(kinds_.begin(), kinds_.end(), [&](const Kind& k) { return k.keyword == keyword; });
    if (kind != kinds_.end() || keyword == "f") {
      words = words.substr(0, words.find('#'));
      line.resize(static_cast<std::size_t>(words.data() + words.size() - line.data()));
      if (kind != kinds_.end()) {
        numbers_read(words, *kind);
      } else {
        face_read(words);
      }
    }
    out_.text += line + '\n';
  }

  void numbers_read(std::string_view words, Kind& kind) {
    int count = 0;
    for (std::string_view word = word_take(words); !word.empty(); word = word_take(words), ++count)
      if (!is_number(word)) refuse(first_, "'" + std::string(word.substr(0, 40)) + "' is not a number");
    if (count < kind.numbers)
      refuse(first_, "a " + std::string(kind.name) + " has " + std::to_string(count) + " numbers, expected at least " +
                         std::to_string(kind.numbers));
    ++kind.count;
  }

  void face_read(std::string_view words) {
    std::size_t corners = 0;
    for (std::string_view word = word_take(words); !word.empty(); word = word_take(words), ++corners) corner_read(word);
    if (corners >= 3) out_.corners.push_back(corners);
  }

  // v, v/vt, v//vn or v/vt/vn
  void corner_read(std::string_view word) {
    std::string_view rest = word;
    for (std::size_t k = 0; k < kinds_.size(); ++k) {
      const std::string_view number = rest.substr(0, rest.find('/'));
      rest.remove_prefix(number.size());
      if (k != 1 || !number.empty() || rest.empty()) index_read(number, kinds_[k], word);
      if (rest.empty()) return;
      rest.remove_prefix(1);
    }
    refuse_corner(word);
  }

  void index_read(std::string_view number, Kind& kind, std::string_view corner) {
    int index = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), index);
    if (error != std::errc() || end != number.data() + number.size() || index == 0) refuse_corner(corner);
    if (index < 0 && static_cast<std::size_t>(-static_cast<long long>(index)) > kind.count)
      refuse_index(kind, index, first_);
    if (index <= kind.largest) return;
    kind.largest = index;
    kind.line = first_;
  }

  [[noreturn]] void refuse_corner(std::string_view word) const {
    refuse(first_,
           "'" + std::string(word.substr(0, 40)) +
               "' is not a corner of a face: expected v, v/vt, v//vn or v/vt/vn, each an index from 1 or -1 on");
  }

  const Path& file_;
  std::size_t first_ = 1,
              next_ = 1;  // numbers of the line at hand, before continued lines were joined, and of what follows
  std::array<Kind, 3> kinds_{{{"v", "vertex", 3}, {"vt", "texture coordinate", 1}, {"vn", "normal", 3}}};
  ObjText out_;
};

}  // namespace

ObjText obj_text_read(const Path& file) { return Reader(file).run(); }

}  // namespace brume
