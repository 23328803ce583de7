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

std::vector<std::string> words_of(std::string_view words) {
  std::vector<std::string> out;
  for (std::string_view word = word_take(words); !word.empty(); word = word_take(words)) out.emplace_back(word);
  return out;
}

// "a.mtl my b.mtl": a.mtl, "my b.mtl".
std::vector<std::string> names_split(std::string_view line) {
  std::vector<std::string> names;
  bool within = false;  // a name that goes on
  for (const std::string& word : words_of(line)) {
    if (within)
      names.back() += " " + word;
    else
      names.push_back(word);
    within = word.size() < 4 || text_lower(word.substr(word.size() - 4)) != ".mtl";
  }
  return names;
}

class Libraries {
 public:
  Libraries(const Path& file, ObjFile& obj, Mesh& mesh)
      : folder_(file.parent_path()), files_({folder_}), obj_(obj), mesh_(mesh) {}

  // False where some library is missing.
  bool read() {
    for (const ObjName& library : obj_.libraries) {
      const std::vector<std::string> names = names_of(library.name);
      if (names.empty()) obj_.notes.add(library.line, "mtllib names no file");
      for (const std::string& name : names) read_one(name, library.line);
    }
    return complete_;
  }

 private:
  // One file where there is one called by the whole line, else as many as end in .mtl; of what is not there, each word
  // if all are.
  std::vector<std::string> names_of(const std::string& line) {
    if (const FoundFile& whole = files_.find(line); whole.found && whole.as_named) return {line};
    const auto there = [&](const std::string& name) { return files_.find(name).found; };
    std::vector<std::string> names;
    for (const std::string& name : names_split(name_before_hash(line))) {
      const std::vector<std::string> words = words_of(name);
      if (!there(name) && std::all_of(words.begin(), words.end(), there))
        names.insert(names.end(), words.begin(), words.end());
      else
        names.push_back(name);
    }
    return names;
  }

  void read_one(const std::string& name, std::size_t line) {
    const FoundFile& found = files_.find(name);
    if (std::find(read_.begin(), read_.end(), found.path) != read_.end()) return;
    read_.push_back(found.path);
    if (!found.as_named)
      obj_.notes.add(line, "'" + name + "' is not there; " + found.path.string() + " is taken for it", "another MTL");
    std::string text;
    try {
      text = file_read_text(found.path, MTL_BYTES_MAX, "a material library");
    } catch (const InputError& failure) {
      obj_.notes.add(line, std::string(failure.what()) + "; the mesh goes without it");
      complete_ = false;
      return;
    }
    FileFinder images({found.path.parent_path(), folder_});
    mtl_read(found.path, text, images, mesh_.materials, mesh_.notes);
  }

  const Path folder_;
  FileFinder files_;
  ObjFile& obj_;
  Mesh& mesh_;
  std::vector<Path> read_;
  bool complete_ = true;
};

// Materials by their names.
class Names {
 public:
  explicit Names(const std::vector<MeshMaterial>& materials) : materials_(materials) {
    for (std::size_t i = 0; i < materials.size(); ++i) {
      exact_.emplace(materials[i].name, static_cast<int>(i));
      lower_.emplace(text_lower(materials[i].name), static_cast<int>(i));
    }
    for (std::size_t i = 0; i < materials.size(); ++i)  // "m #old", where no material is called m
      exact_.emplace(std::string(name_before_hash(materials[i].name)), static_cast<int>(i));
  }

  // -1 for none.
  int find(const std::string& name) const {
    const auto whole = exact_.find(name);
    if (whole != exact_.end()) return whole->second;
    const auto part = exact_.find(std::string(name_before_hash(name)));
    return part != exact_.end() && materials_[part->second].name == part->first ? part->second : -1;
  }
  int find_any_case(const std::string& name) const {
    const auto found = lower_.find(text_lower(name));
    return found != lower_.end() ? found->second : -1;
  }

 private:
  const std::vector<MeshMaterial>& materials_;
  std::map<std::string, int> exact_, lower_;
};

}  // namespace

std::vector<int> obj_materials(const Path& file, ObjFile& obj, Mesh& mesh) {
  const bool complete = Libraries(file, obj, mesh).read();
  const Names names(mesh.materials);
  std::vector<int> out;
  for (const ObjName& material : obj.materials) {
    int found = names.find(material.name);
    if (found < 0 && (found = names.find_any_case(material.name)) >= 0)
      obj.notes.add(
          material.line,
          "no library has the material '" + material.name + "'; '" + mesh.materials[found].name + "' is taken for it",
          "other case of a material");
    else if (found < 0 && complete)
      obj.notes.add(material.line, "no library has the material '" + material.name + "'; its faces are grey",
                    "unknown material");
    out.push_back(found);
  }
  return out;
}

}  // namespace brume
