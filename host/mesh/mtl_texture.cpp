// Values of map_* lines: options in front of the name of the image, or, as some programs write them, behind it.
#include <cmath>
#include <limits>

#include "mesh/file_find.hpp"
#include "mesh/mtl_reader.hpp"

namespace brume {

namespace {

constexpr const char* NOT_READ = "is not read";

struct Option {
  const char* name;
  int numbers_min, numbers_max;  // 0, 0: one word
  void (*set)(MeshTexture&, const std::vector<double>& numbers, std::string_view word);
  const char* told;
};

void set_offset(MeshTexture& t, const std::vector<double>& n, std::string_view) {
  t.offset = {n[0], n.size() > 1 ? n[1] : 0};
}
void set_scale(MeshTexture& t, const std::vector<double>& n, std::string_view) {
  t.scale = {n[0], n.size() > 1 ? n[1] : 1};
}
void set_range(MeshTexture& t, const std::vector<double>& n, std::string_view) {
  t.base = n[0];
  t.gain = n[1];
}
void set_clamp(MeshTexture& t, const std::vector<double>&, std::string_view word) {
  t.clamp = text_lower(word) == "on";
}

constexpr Option OPTIONS[] = {{"-o", 1, 3, set_offset, nullptr},
                              {"-s", 1, 3, set_scale, nullptr},
                              {"-mm", 2, 2, set_range, "is base + gain times the linear color of the image"},
                              {"-clamp", 0, 0, set_clamp, nullptr},
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
  if (option.set) option.set(out, numbers, word);
  return true;
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

}  // namespace

MeshTexture mtl_texture(const std::filesystem::path& folder, std::string_view words, std::size_t line,
                        LineNotes& notes) {
  MeshTexture out;
  std::string_view name;
  words = name_of(words);
  while (!words.empty()) {
    std::string_view after = words;
    const std::string_view word = word_take(after);
    const Option* option = option_of(word);
    if (!option) {
      name = name_take(words);
      words = name_of(words);
      continue;
    }
    words = after;
    if (!option_read(*option, words, out))
      notes.add(line, "what follows " + std::string(option->name) + " is not what it takes; it is not read");
    else if (option->told)
      notes.add(line, "the map option " + std::string(option->name) + " " + option->told);
    words = name_of(words);
  }
  if (name.empty()) {
    notes.add(line, "no image is named");
    return out;
  }
  FoundFile image = file_find(folder, name);
  if (!image.found && name_before_hash(name) != name) image = file_find(folder, name_before_hash(name));
  if (!image.as_named)
    notes.add(line, "'" + std::string(name) + "' is not there; " + image.path.string() + " is taken for it",
              "another image");
  out.file = image.path;
  return out;
}

}  // namespace brume
