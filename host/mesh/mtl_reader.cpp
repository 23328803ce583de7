// A reader of our own: tinyobjloader carries what one material says into the next, reads "0,2" as 0, keeps float only,
// and drops without a word what it does not know; who renders other people's files has to hear of each such line.
#include "mesh/mtl_reader.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "mesh/mtl_material.hpp"

namespace brume {

namespace {

using Path = std::filesystem::path;

class MtlReader {
 public:
  MtlReader(const Path& file, FileFinder& images, std::vector<MeshMaterial>& materials)
      : file_(file), images_(images), notes_(file), materials_(materials) {}

  void run(std::string_view text, std::vector<std::string>& notes) {
    for (TextLines lines(text); lines.next();) {
      line_ = lines.number();
      line_read(lines.line());
    }
    material_end();
    notes_.write(notes);
  }

 private:
  struct Row {
    const char* keyword;
    void (MtlReader::*read)(std::string_view words);
    std::optional<glm::dvec3> MtlMaterial::*color;
    std::optional<double> MtlMaterial::*number;
    MeshTexture MtlMaterial::*map;
  };
  static const std::vector<Row>& rows() {
    static const std::vector<Row> table = {{"newmtl", &MtlReader::material_begin, {}, {}, {}},
                                           {"Kd", &MtlReader::color_read, &MtlMaterial::diffuse, {}, {}},
                                           {"Ks", &MtlReader::color_read, &MtlMaterial::specular, {}, {}},
                                           {"Ka", &MtlReader::color_read, &MtlMaterial::ambient, {}, {}},
                                           {"Ke", &MtlReader::color_read, &MtlMaterial::emission, {}, {}},
                                           {"Tf", &MtlReader::color_read, &MtlMaterial::filter, {}, {}},
                                           {"Ns", &MtlReader::number_read, {}, &MtlMaterial::shininess, {}},
                                           {"Ni", &MtlReader::number_read, {}, &MtlMaterial::ior, {}},
                                           {"d", &MtlReader::number_read, {}, &MtlMaterial::dissolve, {}},
                                           {"Tr", &MtlReader::number_read, {}, &MtlMaterial::transparency, {}},
                                           {"illum", &MtlReader::number_read, {}, &MtlMaterial::illum, {}},
                                           {"map_Kd", &MtlReader::map_read, {}, {}, &MtlMaterial::diffuse_map},
                                           {"map_Ke", &MtlReader::map_read, {}, {}, &MtlMaterial::emission_map}};
    return table;
  }

  void line_read(const std::string& line) {
    std::string_view words = line;
    const std::string keyword(word_take(words));
    if (keyword.empty() || keyword[0] == '#') return;
    for (const Row& row : rows()) {
      if (text_lower(keyword) != text_lower(row.keyword)) continue;
      if (keyword != row.keyword)
        notes_.add(line_, "'" + keyword + "' is read as '" + row.keyword + "'", "other case of " + text_lower(keyword));
      row_ = &row;
      if (row.read != &MtlReader::material_begin && !material_)
        notes_.add(line_, "stands before the first newmtl; it is not read");
      else
        (this->*row.read)(words);
      return;
    }
    not_read(keyword);
  }

  // What other programs write and brume does not show is told by its name, everything else once in all.
  void not_read(const std::string& keyword) {
    static const char* const KNOWN[] = {
        "map_ka",   "map_ks",  "map_ns",    "map_d",    "map_tr", "map_tf",  "map_refl", "map_bump",   "bump",
        "map_norm", "norm",    "disp",      "decal",    "refl",   "map_aat", "pr",       "pm",         "ps",
        "pc",       "pcr",     "aniso",     "anisor",   "map_pr", "map_pm",  "map_ps",   "map_pc",     "map_pcr",
        "map_rma",  "map_orm", "sharpness", "map_disp", "map_ni", "kn",      "map_kn",   "map_opacity"};
    const bool known = std::find(std::begin(KNOWN), std::end(KNOWN), text_lower(keyword)) != std::end(KNOWN);
    notes_.add(line_,
               "'" + keyword.substr(0, 40) + (known ? "' is not read" : "' is not understood; the line is not read"),
               known ? text_lower(keyword) : "not understood");
  }

  void material_begin(std::string_view words) {
    material_end();
    material_.emplace();
    material_->line = line_;
    material_->name = std::string(name_of(words));
    if (material_->name.empty()) notes_.add(line_, "a material has no name");
  }
  void material_end() {
    if (!material_) return;
    const auto same = [&](const MeshMaterial& m) { return m.name == material_->name; };
    if (std::any_of(materials_.begin(), materials_.end(), same))
      notes_.add(material_->line, "material '" + material_->name + "' is there already; this one is not read",
                 "same name");
    else
      materials_.push_back(mtl_material(*material_, notes_));
    material_.reset();
  }

  // Finite numbers up to the first word that is none; beyond float they are refused.
  std::vector<double> numbers_read(std::string_view words, std::size_t count) {
    words = words.substr(0, words.find('#'));
    std::vector<double> out;
    for (std::string_view word = word_take(words); !word.empty(); word = word_take(words)) {
      const std::optional<double> number = number_of(word);
      if (!number || out.size() == count) {
        const std::string what = "'" + std::string(word.substr(0, 40)) + "' behind " + row_->keyword;
        notes_.add(line_, what + (number ? " is one number too many" : " is not a number") + "; it is not read",
                   number ? "too many" : "no number");
        return number ? out : std::vector<double>{};
      }
      if (!(std::abs(*number) <= std::numeric_limits<float>::max()))
        throw InputError(file_.string() + ": line " + std::to_string(line_) + ": '" + std::string(word.substr(0, 40)) +
                         "' is beyond 3.4e38, the largest number that " + row_->keyword + " may be");
      out.push_back(*number);
    }
    if (out.empty()) notes_.add(line_, std::string(row_->keyword) + " has no number; it is not read", "no value");
    return out;
  }

  void color_read(std::string_view words) {
    const std::vector<double> n = numbers_read(words, 3);
    if (n.size() == 2) notes_.add(line_, std::string(row_->keyword) + " has two numbers; it is not read", "two");
    if (n.size() == 1) (*material_).*(row_->color) = glm::dvec3(n[0]);
    if (n.size() != 3) return;
    (*material_).*(row_->color) = glm::dvec3(n[0], n[1], n[2]);
    if (std::min({n[0], n[1], n[2]}) < 0)
      notes_.add(line_, std::string(row_->keyword) + " is negative; 0 is taken", "negative");
  }
  void number_read(std::string_view words) {
    const std::vector<double> n = numbers_read(words, 1);
    if (!n.empty()) (*material_).*(row_->number) = n[0];
  }
  void map_read(std::string_view words) { (*material_).*(row_->map) = mtl_texture(images_, words, line_, notes_); }

  const Path& file_;
  FileFinder& images_;
  LineNotes notes_;
  std::vector<MeshMaterial>& materials_;
  std::size_t line_ = 0;
  const Row* row_ = nullptr;  // of the line at hand
  std::optional<MtlMaterial> material_;
};

}  // namespace

void mtl_read(const Path& file, std::string_view text, FileFinder& images, std::vector<MeshMaterial>& materials,
              std::vector<std::string>& notes) {
  MtlReader(file, images, materials).run(text, notes);
}

}  // namespace brume
