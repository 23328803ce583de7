// See obj_materials.hpp.
#include "mesh/obj_materials.hpp"

#include <algorithm>
#include <map>

#include "base/error.hpp"
#include "base/file_read.hpp"
#include "mesh/file_find.hpp"
#include "mesh/mtl_reader.hpp"

namespace brume {

namespace {

using Path = std::filesystem::path;

constexpr std::size_t MTL_BYTES_MAX = 64u << 20;

// "a.mtl my b.mtl" names two files, unless there is one of that name.
std::vector<std::string> names_split(std::string_view words) {
  std::vector<std::string> names;
  const char* begin = nullptr;
  for (std::string_view word = word_take(words); !word.empty(); word = word_take(words)) {
    if (!begin) begin = word.data();
    const bool ends = word.size() >= 4 && text_lower(word.substr(word.size() - 4)) == ".mtl";
    if (ends) names.emplace_back(begin, word.data() + word.size());
    if (ends) begin = nullptr;
    if (!ends && words.find_first_not_of(" \t") == std::string_view::npos)
      names.emplace_back(begin, word.data() + word.size());
  }
  return names;
}

class Libraries {
 public:
  Libraries(const Path& file, ObjFile& obj, Mesh& mesh) : folder_(file.parent_path()), obj_(obj), mesh_(mesh) {}

  // False where some library is missing.
  bool read() {
    for (const ObjName& library : obj_.libraries) {
      std::vector<std::string> names{library.name};
      if (!file_find(folder_, library.name).found) names = names_split(name_before_hash(library.name));
      if (names.empty()) obj_.notes.add(library.line, "mtllib names no file");
      for (const std::string& name : names) read_one(name, library.line);
    }
    return complete_;
  }

 private:
  void read_one(const std::string& name, std::size_t line) {
    const FoundFile found = file_find(folder_, name);
    if (std::find(read_.begin(), read_.end(), found.path) != read_.end()) return;
    read_.push_back(found.path);
    if (!found.as_named)
      obj_.notes.add(line, "'" + name + "' is not there; " + found.path.string() + " is taken for it", "another MTL");
    std::string text;
    try {
      text = file_read_text(found.path, MTL_BYTES_MAX, "a material library");
    } catch (const InputError& failure) {
      mesh_.notes.push_back(std::string(failure.what()) + "; the mesh is grey");
      complete_ = false;
      return;
    }
    mtl_read(found.path, text, mesh_.materials, mesh_.notes);
  }

  const Path folder_;
  ObjFile& obj_;
  Mesh& mesh_;
  std::vector<Path> read_;
  bool complete_ = true;
};

}  // namespace

std::vector<int> obj_materials(const Path& file, ObjFile& obj, Mesh& mesh) {
  const bool complete = Libraries(file, obj, mesh).read();
  const std::vector<MeshMaterial>& all = mesh.materials;
  std::map<std::string, int> index;
  for (std::size_t i = 0; i < all.size(); ++i) index.emplace(all[i].name, static_cast<int>(i));
  for (std::size_t i = 0; i < all.size(); ++i)  // "m #old", where no material is called m
    index.emplace(std::string(name_before_hash(all[i].name)), static_cast<int>(i));
  std::vector<int> out;
  for (const ObjName& material : obj.materials) {
    auto found = index.find(material.name);
    if (found == index.end()) found = index.find(std::string(name_before_hash(material.name)));
    const bool known =
        found != index.end() && (found->first == material.name || all[found->second].name == found->first);
    out.push_back(known ? found->second : -1);
    if (!known && complete)
      obj.notes.add(material.line, "no library has the material '" + material.name + "'; its faces are grey",
                    "unknown material");
  }
  return out;
}

}  // namespace brume
