// See obj_parse.hpp. A reader of our own: tinyobjloader keeps vertices in float, and drops, guesses at or reads as 0
// what it does not understand, so that most of its work had to be done before it.
#include "mesh/obj_parse.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "base/error.hpp"
#include "base/file_read.hpp"
#include "mesh/mesh.hpp"

namespace brume {

namespace {

using Path = std::filesystem::path;

constexpr std::size_t OBJ_BYTES_MAX = std::size_t(1) << 30;
constexpr double COORDINATE_MAX = 1e38;

std::string quoted(std::string_view word) { return "'" + std::string(word.substr(0, 40)) + "'"; }

// What the corners of faces index, in the order in which a corner names them: v/vt/vn.
struct Kind {
  const char* name;
  int numbers;  // at least
  std::size_t count = 0;
  int largest = 0;  // index so far, and the line that names it: vertices may follow their faces
  std::size_t line = 0;
};
enum { POSITION, UV, NORMAL };

class ObjReader {
 public:
  explicit ObjReader(const Path& file) : file_(file), out_(file) {}

  ObjFile run() {
    const std::string text = file_read_text(file_, OBJ_BYTES_MAX, "an OBJ file");
    for (TextLines lines(text); lines.next();) {
      line_ = lines.number();
      line_read(lines.line());
    }
    for (const Kind& kind : kinds_)
      if (kind.largest > 0 && static_cast<std::size_t>(kind.largest) > kind.count)
        refuse_index(kind, kind.largest, kind.line);
    if (line_ > 0 && !seen_)
      throw InputError(file_.string() + ": is not an OBJ file, holds no triangle: no line is a vertex or a face" +
                       (first_word_.empty() ? "" : ", the first begins with " + first_word_));
    return std::move(out_);
  }

 private:
  struct Row {
    const char* keyword;
    void (ObjReader::*read)(std::string_view words);
  };

  [[noreturn]] void refuse(std::size_t line, const std::string& cause) const {
    throw InputError(file_.string() + ": line " + std::to_string(line) + ": " + cause);
  }
  [[noreturn]] void refuse_index(const Kind& kind, int index, std::size_t line) const {
    refuse(line, "names " + std::string(kind.name) + " " + std::to_string(index) + "; the file has " +
                     std::to_string(kind.count) + (index < 0 ? " before it" : ""));
  }

  void line_read(const std::string& line) {
    static constexpr Row ROWS[] = {{"v", &ObjReader::position_read},
                                   {"vt", &ObjReader::uv_read},
                                   {"vn", &ObjReader::normal_read},
                                   {"f", &ObjReader::face_read},
                                   {"s", &ObjReader::group_read},
                                   {"usemtl", &ObjReader::material_read},
                                   {"mtllib", &ObjReader::library_read},
                                   {"o", nullptr},
                                   {"g", nullptr}};  // names of parts: nothing to see
    std::string_view words = line;
    const std::string_view keyword = word_take(words);
    if (keyword.empty() || keyword[0] == '#') return;
    if (first_word_.empty()) first_word_ = quoted(keyword);
    const auto find = [&](std::string_view name) {
      return std::find_if(std::begin(ROWS), std::end(ROWS), [&](const Row& row) { return row.keyword == name; });
    };
    const Row* row = find(keyword);
    if (row == std::end(ROWS) && (row = find(text_lower(keyword))) != std::end(ROWS))
      out_.notes.add(line_, quoted(keyword) + " is read as '" + row->keyword + "'", "other case");
    if (row == std::end(ROWS))
      not_read(keyword);
    else if (row->read)
      (this->*row->read)(words);
  }

  void not_read(std::string_view keyword) {
    static constexpr std::string_view KNOWN[] = {
        "l",    "p",     "vp",     "cstype", "deg",      "bmat",     "step",       "curv",     "curv2",
        "surf", "parm",  "trim",   "hole",   "scrv",     "sp",       "end",        "con",      "mg",
        "lod",  "bevel", "usemap", "maplib", "c_interp", "d_interp", "shadow_obj", "trace_obj"};
    const bool known = std::find(std::begin(KNOWN), std::end(KNOWN), keyword) != std::end(KNOWN);
    out_.notes.add(
        line_,
        quoted(keyword) + (known ? " is not read: only faces are shown" : " is not understood; the line is not read"),
        known ? std::string(keyword) : "not understood");
  }

  // Three numbers; those behind them are told unless they say nothing.
  glm::dvec3 numbers_read(std::string_view words, Kind& kind) {
    glm::dvec3 out(0);
    double fourth = 1;
    int count = 0;
    words = words.substr(0, words.find('#'));
    for (std::string_view word = word_take(words); !word.empty(); word = word_take(words), ++count) {
      const std::optional<double> number = number_of(word);
      if (!number) refuse(line_, quoted(word) + " is not a number");
      if (count < 3) out[count] = *number;
      if (count == 3) fourth = *number;
    }
    if (count < kind.numbers)
      refuse(line_, "a " + std::string(kind.name) + " has " + std::to_string(count) + " numbers, expected at least " +
                        std::to_string(kind.numbers));
    ++kind.count;
    seen_ = true;
    for (int k = 0; k < 3; ++k)
      if (!(std::abs(out[k]) <= COORDINATE_MAX))
        refuse(line_, std::string(kind.name) + " " + std::to_string(kind.count) + " is not finite or beyond 1e38");
    if (&kind == &kinds_[POSITION] && count > 5)
      out_.notes.add(line_, "colors of vertices are not read");
    else if (count > 4 || fourth != 1)
      out_.notes.add(line_, "a " + std::string(kind.name) + " has more than three numbers; the rest is not read");
    return out;
  }
  void position_read(std::string_view words) { out_.positions.push_back(numbers_read(words, kinds_[POSITION])); }
  void uv_read(std::string_view words) {
    const glm::dvec3 uvw = numbers_read(words, kinds_[UV]);
    out_.uvs.emplace_back(uvw);
    if (uvw.z != 0) out_.notes.add(line_, "the third texture coordinate is not read: images have two");
  }
  void normal_read(std::string_view words) { out_.normals.push_back(numbers_read(words, kinds_[NORMAL])); }

  void face_read(std::string_view words) {
    seen_ = true;
    const std::size_t first = out_.corners.size();
    words = words.substr(0, words.find('#'));
    for (std::string_view word = word_take(words); !word.empty(); word = word_take(words)) corner_read(word);
    const std::size_t corners = out_.corners.size() - first;
    if (corners >= 3) {
      out_.faces.push_back({first, corners, line_, material_, group_});
    } else {
      out_.notes.add(line_, "a face has fewer than three corners; it is left out");
      out_.corners.resize(first);
    }
  }

  // v, v/vt, v//vn or v/vt/vn
  void corner_read(std::string_view word) {
    std::string_view rest = word;
    std::array<int, 3> corner{-1, -1, -1};
    for (std::size_t k = 0; k < kinds_.size(); ++k) {
      const std::string_view number = rest.substr(0, rest.find('/'));
      rest.remove_prefix(number.size());
      if (k != UV || !number.empty() || rest.empty()) corner[k] = index_read(number, kinds_[k], word);
      if (rest.empty()) {
        out_.corners.push_back(corner);
        return;
      }
      rest.remove_prefix(1);
    }
    refuse_corner(word);
  }

  int index_read(std::string_view number, Kind& kind, std::string_view corner) {
    int index = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), index);
    if (error != std::errc() || end != number.data() + number.size() || index == 0) refuse_corner(corner);
    if (index < 0) {
      if (static_cast<std::size_t>(-static_cast<long long>(index)) > kind.count) refuse_index(kind, index, line_);
      return static_cast<int>(kind.count) + index;
    }
    if (index > kind.largest) {
      kind.largest = index;
      kind.line = line_;
    }
    return index - 1;
  }

  [[noreturn]] void refuse_corner(std::string_view word) const {
    refuse(line_, quoted(word) +
                      " is not a corner of a face: expected v, v/vt, v//vn or v/vt/vn, each an index from 1 or -1 on");
  }

  void group_read(std::string_view words) {
    const std::string word = text_lower(word_take(words));
    int number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (word == "off")
      group_ = GROUP_FLAT;
    else if (word == "on")
      group_ = 1;
    else if (error == std::errc() && end == word.data() + word.size() && number >= 0)
      group_ = number;
    else
      out_.notes.add(line_, "a smoothing group is a number or off; the line is not read");
  }

  void material_read(std::string_view words) {
    const std::string name(name_of(words));
    const auto [known, is_new] = material_index_.emplace(name, static_cast<int>(out_.materials.size()));
    if (is_new) out_.materials.push_back({name, line_});
    material_ = known->second;
  }
  void library_read(std::string_view words) { out_.libraries.push_back({std::string(name_of(words)), line_}); }

  const Path& file_;
  std::size_t line_ = 0;
  std::array<Kind, 3> kinds_{{{"vertex", 3}, {"texture coordinate", 1}, {"normal", 3}}};
  bool seen_ = false;  // a vertex or a face
  std::string first_word_;
  int material_ = -1, group_ = GROUP_ALL;
  std::map<std::string, int> material_index_;
  ObjFile out_;
};

}  // namespace

ObjFile obj_parse(const Path& file) { return ObjReader(file).run(); }

}  // namespace brume
