// See ply_check.hpp.
#include "mesh/ply_check.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace brume {

namespace {

constexpr std::size_t HEADER_LINES_MAX = 1000, LINE_MAX_BYTES = 4096;

struct PlyProperty {
  std::size_t count_bytes = 0;  // of a list: of its length
  std::size_t bytes = 0;        // of a value
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  bool has_lists() const {
    return std::any_of(properties.begin(), properties.end(), [](const PlyProperty& p) { return p.count_bytes > 0; });
  }
  std::uint64_t bytes() const {  // where there are no lists
    std::uint64_t sum = 0;
    for (const PlyProperty& p : properties) sum += p.bytes;
    return sum;
  }
};

struct PlyHeader {
  std::string format;
  std::vector<PlyElement> elements;
};

class PlyCheck {
 public:
  explicit PlyCheck(const std::filesystem::path& file) : file_(file.string()), in_(file, std::ios::binary) {
    in_.seekg(0, std::ios::end);
    size_ = static_cast<std::uint64_t>(in_.tellg());
    in_.seekg(0);
  }

  void run() {
    read_header();
    const auto begin = static_cast<std::uint64_t>(in_.tellg());
    if (header_.format == "ascii") return check_lines();
    std::uint64_t at = begin;
    for (const PlyElement& element : header_.elements) at = check_element(element, at);
  }

 private:
  [[noreturn]] void fail(const std::string& cause) const { throw InputError(file_ + ": " + cause); }
  [[noreturn]] void fail_short(const PlyElement& element) const {
    fail("its header promises " + std::to_string(element.count) + " of '" + element.name +
         "', but the file ends before; it is cut short or damaged");
  }

  static std::size_t type_bytes(const std::string& type) {
    static const std::map<std::string, std::size_t> known = {
        {"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},  {"short", 2}, {"ushort", 2},
        {"int16", 2}, {"uint16", 2},  {"int", 4},    {"uint", 4},   {"int32", 4}, {"uint32", 4},
        {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
    const auto found = known.find(type);
    return found == known.end() ? 0 : found->second;
  }

  void read_property(std::istringstream& words) {
    std::string type, count;
    words >> type;
    if (header_.elements.empty()) fail("its header has a property of no element");
    PlyProperty property;
    if (type == "list") {
      words >> count >> type;
      property.count_bytes = type_bytes(count);
      if (property.count_bytes == 0) fail("its header has a list with a length of type '" + count.substr(0, 20) + "'");
    }
    property.bytes = type_bytes(type);
    if (property.bytes == 0) fail("its header has a property of type '" + type.substr(0, 20) + "'");
    header_.elements.back().properties.push_back(property);
  }

  void read_header() {
    std::string line;
    for (std::size_t i = 0; i < HEADER_LINES_MAX && next_line(line); ++i) {
      std::istringstream words(line);
      std::string word;
      words >> word;
      if (word == "format") words >> header_.format;
      if (word == "element") {
        PlyElement element;
        if (!(words >> element.name >> element.count)) fail("its header has an element without a number");
        header_.elements.push_back(element);
      }
      if (word == "property") read_property(words);
      if (word == "end_header") return;
    }
    fail("is a PLY file whose header does not end");
  }

  bool next_line(std::string& line) {
    line.clear();
    for (int c; line.size() < LINE_MAX_BYTES && (c = in_.get()) != EOF;) {
      if (c == '\n') return true;
      line += static_cast<char>(c);
    }
    return false;
  }

  // A line of its own for each of them; empty ones are none.
  void check_lines() {
    std::string line;
    for (const PlyElement& element : header_.elements)
      for (std::uint64_t i = 0; i < element.count; ++i) {
        if (element.count - i > size_) fail_short(element);
        do
          if (!std::getline(in_, line)) fail_short(element);
        while (line.find_first_not_of(" \t\r") == std::string::npos);
      }
  }

  std::uint64_t check_element(const PlyElement& element, std::uint64_t at) {
    if (!element.has_lists()) {
      const std::uint64_t bytes = element.bytes();
      if (bytes > 0 && element.count > (size_ - at) / bytes) fail_short(element);
      return at + element.count * bytes;
    }
    in_.seekg(static_cast<std::streamoff>(at));
    for (std::uint64_t i = 0; i < element.count; ++i)
      for (const PlyProperty& p : element.properties) {
        at += p.count_bytes;
        if (at > size_) fail_short(element);
        const std::uint64_t bytes = p.count_bytes > 0 ? read_length(p.count_bytes) * p.bytes : p.bytes;
        if (bytes > size_ - at) fail_short(element);
        at += bytes;
        in_.ignore(static_cast<std::streamsize>(bytes));
      }
    return at;
  }

  // Negative ones are too long for any file.
  std::uint64_t read_length(std::size_t bytes) {
    unsigned char digits[8] = {};
    in_.read(reinterpret_cast<char*>(digits), static_cast<std::streamsize>(bytes));
    if (header_.format == "binary_big_endian") std::reverse(digits, digits + bytes);
    std::uint64_t length = 0;
    for (std::size_t i = bytes; i-- > 0;) length = length << 8 | digits[i];
    return length;
  }

  std::string file_;
  std::ifstream in_;
  std::uint64_t size_ = 0;
  PlyHeader header_;
};

}  // namespace

void ply_check(const std::filesystem::path& file) { PlyCheck(file).run(); }

}  // namespace brume
