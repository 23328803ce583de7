// The densities that a scene file may name (host/scene) and those that there are (host/volume) stand in two tables,
// which must hold the same names, as must the schema: the one says which keys a type reads, the other makes the field.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "unit/scene/scene_texts.hpp"
#include "volume/density_source.hpp"

namespace brume {
namespace {

std::string medium(const std::string& density) { return R"({"media": [{"density": )" + density + "}]}"; }

// What the reader lists when it meets an unknown one: "...; known: a, b, c".
std::vector<std::string> names_of_reader() {
  const std::string error = scene_error(medium(R"({"type": "no such density"})")), start = "known: ";
  const std::size_t at = error.find(start);
  if (at == std::string::npos) return {};
  std::istringstream words(error.substr(at + start.size()));
  std::vector<std::string> names;
  for (std::string name; std::getline(words >> std::ws, name, ',');) names.push_back(name);
  return names;
}

TEST(DensityNames, ReaderAndSourceKnowTheSame) {
  std::vector<std::string> sources;
  for (const FamilyRow& row : density_family()) sources.emplace_back(row.name);
  EXPECT_FALSE(sources.empty());
  EXPECT_THAT(names_of_reader(), testing::UnorderedElementsAreArray(sources));
  EXPECT_EQ(std::set<std::string>(sources.begin(), sources.end()).size(), sources.size());
}

TEST(DensityNames, TheSchemaListsThem) {
  std::ifstream in(std::string(BRUME_SOURCE_DIR) + "/scenes/scene.schema.json");
  const nlohmann::json schema = nlohmann::json::parse(in);
  std::vector<std::string> listed, sources;
  for (const nlohmann::json& one : schema["definitions"]["density"]["oneOf"])
    listed.push_back(one["properties"]["type"]["const"]);
  for (const FamilyRow& row : density_family()) sources.emplace_back(row.name);
  EXPECT_EQ(listed, sources);
}

// Not by the message alone: each is read, with whatever its type cannot do without.
TEST(DensityNames, EveryOneIsRead) {
  for (const FamilyRow& row : density_family()) {
    const std::string name(row.name), start = R"({"type": ")" + name + '"';
    const std::string more = name == "sphere" ? R"(, "of": {"type": "constant"})"
                             : name == "file" ? R"(, "path": "a.vdb")"
                                              : "";
    EXPECT_EQ(scene_error(medium(start + more + "}")), "no error") << name;
    EXPECT_EQ(scene_of(medium(start + more + "}")).media.at(0).density.type, name);
  }
}

}  // namespace
}  // namespace brume
