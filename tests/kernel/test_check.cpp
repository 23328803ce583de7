// brume check on PoCL for every lane width: each device function and each picture within its tolerance. PoCL is never
// skipped.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "check/check.hpp"
#include "check/check_parts.hpp"
#include "check/ray_moves.hpp"
#include "check/row_scenes.hpp"
#include "scene/families.hpp"
#include "shared/layout.h"
#include "shared/shape.h"
#include "volume/density_source.hpp"

namespace brume {
namespace {

using testing::Contains;

Context& pocl() {
  static Context context(device_choose("portable computing language"));
  return context;
}

void expect_passed(const CheckRow& row) {
  EXPECT_TRUE(row.passed()) << row.name << ": max error " << row.max_error << ", allowed " << row.allowed.limit
                            << ", edges " << row.edges << " of " << row.items;
}

class Check : public testing::TestWithParam<int> {};

TEST_P(Check, KernelsAgreeWithTheReference) {
  CheckOptions options;
  options.lanes = {GetParam()};
  options.size = 64;
  EXPECT_EQ(check_run(pocl(), options, expect_passed).size(), check_names().size());
}

INSTANTIATE_TEST_SUITE_P(Lanes, Check, testing::Values(1, 4, 8, 16), testing::PrintToStringParamName());

// A tolerance that fits one size is none.
class LongCheck : public testing::TestWithParam<int> {};

TEST_P(LongCheck, KernelsAgreeAtThisSize) {
  CheckOptions options;
  options.lanes = {1, 8};
  options.size = GetParam();
  check_run(pocl(), options, expect_passed);
}

INSTANTIATE_TEST_SUITE_P(Sizes, LongCheck, testing::Values(16, 24, 32, 48, 96), testing::PrintToStringParamName());

TEST(CheckOptionsTest, LeavesOutWhatIsSkipped) {
  CheckOptions options;
  options.lanes = {4};
  options.filter = "layout/P";
  const std::vector<CheckRow> all = check_run(pocl(), options, expect_passed);
  options.skip = {"nothing", "/Packed3"};
  const std::vector<CheckRow> rest = check_run(pocl(), options, expect_passed);
  ASSERT_EQ(rest.size() + 1, all.size());
  for (const CheckRow& row : rest) EXPECT_NE(row.name, "layout/Packed3");
}

TEST(CheckRow, AMissIsSeen) {
  ErrorSum sum("x", 1, "hit");
  sum.add(1.0, 1.0);
  EXPECT_TRUE(sum.row().passed());
  sum.add(1.001, 1.0);
  EXPECT_FALSE(sum.row().passed());
  ErrorSum nan("x", 1, "hit");
  nan.add(NAN, 1.0);
  EXPECT_FALSE(nan.row().passed());
  ErrorSum nothing("x", 1, "hit");
  EXPECT_FALSE(nothing.row().passed());
  nothing.set_items(100);  // compared nothing all the same
  EXPECT_FALSE(nothing.row().passed());
}

// An edge is what the reference is not sure of itself: neither a plain error nor a NaN is one.
TEST(RayMoves, ExcuseOnlyWhatTheReferenceIsNotSureOf) {
  const auto row = [](double kernel, double reference, double moved) {
    ErrorSum sum("x", 1, "image");
    for (int i = 0; i < 2; ++i)
      add_or_edge(sum, {kernel}, {reference}, [&](int) { return std::vector<double>{moved}; });
    sum.add(0, 0);
    sum.set_items(10000);
    return sum.row();
  };
  EXPECT_EQ(row(1.1, 1.0, 1.0).edges, 0u);
  EXPECT_FALSE(row(1.1, 1.0, 1.0).passed());
  EXPECT_EQ(row(1.1, 1.0, 1.2).edges, 2u);
  EXPECT_TRUE(row(1.1, 1.0, 1.2).passed());
  EXPECT_FALSE(row(NAN, 1.0, 1.2).passed());
  EXPECT_FALSE(row(1.0, NAN, 1.2).passed());
}

// What a filter names is worked out and nothing else, be it the head of a row, its middle or its end.
TEST(CheckFilter, FindsEveryRowThatIsPrinted) {
  for (const std::string filter :
       {"hit", "occluded", "cells", "integral/dda", "layout/LightGrid", "quad", "phase/", "rng"}) {
    std::vector<std::string> expected, found;
    for (const std::string& name : check_names())
      if (name.find(filter) != std::string::npos) expected.push_back(name);
    CheckOptions options;
    options.lanes = {8};
    options.size = 8;
    options.filter = filter;
    check_run(pocl(), options, [&](const CheckRow& row) { found.push_back(row.name); });
    EXPECT_FALSE(found.empty()) << filter;
    EXPECT_EQ(found, expected) << filter;
  }
}

TEST(CheckNames, AreUnique) {
  const std::vector<std::string> names = check_names();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
}

// Every row of every family has a row in the table.
TEST(CheckNames, HoldEveryRowOfEveryFamily) {
  const std::vector<std::string> names = check_names();
  const auto expect_rows = [&](const std::string& head, const Family& family) {
    for (const FamilyRow& row : family)
      EXPECT_THAT(names, Contains(testing::AnyOf(head + std::string(row.name),
                                                 testing::StartsWith(head + std::string(row.name) + "/"))));
  };
  expect_rows("scatter/", method_family());
  expect_rows("phase/", phase_family());
  expect_rows("scatter/phase/", phase_family());
  expect_rows("light/", light_family());
  expect_rows("camera/", camera_family());
  expect_rows("material/", material_family());
  expect_rows("texture/", texture_family());
  expect_rows("storage/", storage_family());
  expect_rows("in_scattering/", in_scattering_family());
  expect_rows("image/shadow_", shadow_family());
  for (const FamilyRow& row : interpolation_family())
    EXPECT_THAT(names, Contains(testing::EndsWith("/" + std::string(row.name))));
  for (const FamilyRow& row : density_family()) {
    if (row.name == "file") continue;
    EXPECT_THAT(names, Contains("density/" + std::string(row.name)));
  }
  for (const FamilyRow& row : shape_family()) {
    if (row.id >= SHAPE_COUNT) continue;
    for (const char* head : {"hit/", "occluded/", "surface/"})
      EXPECT_THAT(names, Contains(head + std::string(row.name)));
  }
}

// A shape that the scene "surfaces" lacks is compared as its keys' defaults make it.
TEST(RowScenes, AShapeIsOfItsType) {
  for (int type = 0; type < SHAPE_COUNT; ++type) {
    const PlannedScene scene = row_scene(shape_desc(type), "shape", 8, 8);
    ASSERT_EQ(scene.shapes.size(), 1u);
    EXPECT_EQ(scene.shapes[0].type, type);
  }
}

// A struct whose size is asserted crosses; then its fields are compared too.
TEST(Layout, ListsEveryStructThatCrosses) {
  std::set<std::string> listed, asserted;
#define STRUCT(type, fields) listed.insert(#type);
  BRUME_STRUCTS(STRUCT)
#undef STRUCT
  const std::regex layout(R"(\nBRUME_LAYOUT\((\w+),)");
  for (const auto& file : std::filesystem::directory_iterator(BRUME_SOURCE_DIR "/kernels/shared")) {
    std::ostringstream text;
    text << std::ifstream(file.path()).rdbuf();
    const std::string all = text.str();
    for (std::sregex_iterator i(all.begin(), all.end(), layout), end; i != end; ++i) asserted.insert((*i)[1]);
  }
  EXPECT_EQ(listed, asserted);
}

}  // namespace
}  // namespace brume
