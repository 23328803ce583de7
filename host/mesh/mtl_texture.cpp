// Values of map_* lines: options in front of the name of the image, or, as some programs write them, behind it.
#include <cctype>
#include <cmath>
#include <limits>

#include "mesh/mtl_reader.hpp"

namespace brume {

namespace {

constexpr const char* NOT_READ = "is not read";

struct Option {
  const char* name;
  int numbers_min, numbers_max;                                                          // 0, 0: one word
  bool (*set)(MeshTexture&, const std::vector<double>& numbers, std::string_view word);  // false: not what it takes
  const char* told;
};

bool set_offset(MeshTexture& t, const std::vector<double>& n, std::string_view) {
  t.offset = {n[0], n.size() > 1 ? n[1] : 0};
  return true;
}
bool set_scale(MeshTexture& t, const std::vector<double>& n, std::string_view) {
  t.scale = {n[0], n.size() > 1 ? n[1] : 1};
  return true;
}
bool set_range(MeshTexture& t, const std::vector<double>& n, std::string_view) {
  t.base = n[0];
  t.gain = n[1];
  return true;
}
bool set_clamp(MeshTexture& t, const std::vector<double>&, std::string_view word) {
  const bool once = text_lower(word) == "on";
  t.wrap = once ? MeshWrap::ONCE : MeshWrap::REPEAT;
  return once || text_lower(word) == "off";
}

constexpr Option OPTIONS[] = {{"-o", 1, 3, set_offset, nullptr},
                              {"-s", 1, 3, set_scale, nullptr},
                              {"-mm", 2, 2, set_range, "is base + gain times the linear color of the image"},
                              {"-clamp", 0, 0, set_clamp, "on shows the image once, and Kd or Ke alone around it"},
                              {"-t", 1, 3, nullptr, NOT_READ},
                              {"-bm", 1, 1, nullptr, NOT_READ},
                              {"-boost", 1, 1, nullptr, NOT_READ},
                              {"-texres", 1, 2, nullptr, NOT_READ},
                              {"-blendu", 0, 0, nullptr, NOT_READ},
                              {"-blendv", 0, 0, nullptr, NOT_READ},
                              {"-imfchan", 0, 0, nullptr, NOT_READ},
                              {"-type", 0, 0, nullptr, NOT_READ},
                              {"-cc", 0, 0, nullptr, NOT_READ},
                              {"-colorspace", 0, 0, nullptr, NOT_READ}};

const Option* option_of(std::string_view word) {
  for (const Option& option : OPTIONS)
    if (text_lower(word) == option.name) return &option;
  return nullptr;
}

// Takes the values of an option off the line; false where they are not what it needs.
bool option_read(const Option& option, std::string_view& words, MeshTexture& out) {
  std::vector<double> numbers;
  std::string_view word;
  if (option.numbers_max == 0) {
    word = word_take(words);
    if (word.empty()) return false;
  }
  while (static_cast<int>(numbers.size()) < option.numbers_max) {
    std::string_view after = words;
    const std::optional<double> number = number_of(word_take(after));
    if (!number) break;
    if (!(std::abs(*number) <= std::numeric_limits<float>::max())) return false;
    numbers.push_back(*number);
    words = after;
  }
  if (static_cast<int>(numbers.size()) < option.numbers_min) return false;
  return !option.set || option.set(out, numbers, word);
}

// Takes values that could not be read off the line, so that the name of the image is left.
void values_skip(std::string_view& words, int count) {
  for (; count > 0; --count) {
    std::string_view after = words;
    const std::string_view word = word_take(after);
    const bool like_number = !word.empty() && word.find_first_of("+-.0123456789") == 0;
    if (!like_number || name_of(after).empty()) return;
    words = after;
  }
}

// Takes what stands before the next option off the line.
std::string_view name_take(std::string_view& words) {
  const std::string_view all = words;
  for (std::string_view rest = words; !rest.empty();) {
    const std::string_view word = word_take(rest);
    if (!option_of(word) || word.data() == all.data()) continue;
    words.remove_prefix(static_cast<std::size_t>(word.data() - all.data()));
    return name_of(all.substr(0, all.size() - words.size()));
  }
  words = {};
  return name_of(all);
}

constexpr int VALUES_MAX = 3;  // of an option that is not known

class MapReader {
 public:
  MapReader(FileFinder& images, std::size_t line, LineNotes& notes) : images_(images), line_(line), notes_(notes) {}

  MeshTexture run(std::string_view words) {
    for (words = name_of(words); !words.empty(); words = name_of(words)) {
      std::string_view after = words;
      const std::string_view word = word_take(after);
      const Option* option = option_of(word);
      if (!option && !is_unknown_option(word, words)) {
        name_ = name_take(words);
        continue;
      }
      words = after;
      option ? option_take(*option, words) : unknown_take(word, words);
    }
    image_find();
    return out_;
  }

 private:
  bool is_unknown_option(std::string_view word, std::string_view words) {
    return word.size() > 1 && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[1])) &&
           word.size() < words.size() && !images_.find(name_of(words)).found;
  }
  void unknown_take(std::string_view word, std::string_view& words) {
    notes_.add(line_, "the map option " + std::string(word.substr(0, 40)) + " is not understood; it is not read",
               "unknown option");
    values_skip(words, VALUES_MAX);
  }

  void option_take(const Option& option, std::string_view& words) {
    const std::string name = option.name;
    if (!option_read(option, words, out_)) {
      notes_.add(line_, "what follows " + name + " is not what it takes; it is not read");
      values_skip(words, option.numbers_max);
    } else if (option.told && (option.set != set_clamp || out_.wrap == MeshWrap::ONCE)) {
      notes_.add(line_, "the map option " + name + " " + option.told);
    }
  }

  void image_find() {
    if (name_.empty()) return notes_.add(line_, "no image is named");
    FoundFile image = images_.find(name_);
    const std::string_view shorter = name_before_hash(name_);
    if (!image.found && shorter != name_) image = images_.find(shorter);
    const std::string quoted = "'" + std::string(name_) + "' is not there; ";
    if (!image.found) return notes_.add(line_, quoted + "the material goes without it", "no image");
    if (!image.as_named) notes_.add(line_, quoted + image.path.string() + " is taken for it", "another image");
    out_.file = image.path;
  }

  FileFinder& images_;
  std::size_t line_;
  LineNotes& notes_;
  std::string_view name_;
  MeshTexture out_;
};

}  // namespace

MeshTexture mtl_texture(FileFinder& images, std::string_view words, std::size_t line, LineNotes& notes) {
  return MapReader(images, line, notes).run(words);
}

}  // namespace brume
