// brume chart as a user sees it: what stands in the folder, what is refused, how it goes on.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "program.hpp"

namespace brume::test {
namespace {

using testing::HasSubstr;

class ChartProgram : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("fog.json", R"({"camera": {"eye": [1.5, 1.2, 3]}, "film": {"size": [16, 12]},
      "lights": [{"type": "directional", "direction": [1, -1, -0.5], "irradiance": 5}],
      "media": [{"density": {"type": "perlin", "resolution": [16, 16, 16]}, "sigma_a": 0.2, "sigma_s": 1}]})");
    write("ball.json", R"({"film": {"size": [16, 12]}, "lights": [{"type": "point", "position": [3, 3, 3],
      "intensity": 50}], "shapes": [{"type": "sphere", "center": [0, 0, 0], "radius": 1}]})");
  }
  nlohmann::json chart(const std::string& folder) const {
    return nlohmann::json::parse(text(folder_ / folder / "chart.json"));
  }
};

TEST_F(ChartProgram, LeavesAChartAndGoesOnWithIt) {
  const Outcome one = run("chart fog.json -o out --methods dda_gauss2,march_midpoint");
  ASSERT_EQ(one.exit_code, 0) << one.err;
  EXPECT_THAT(one.out, HasSubstr("out/chart.csv\nout/chart.json\nout/chart.html\n"));
  const nlohmann::json json = chart("out");
  EXPECT_EQ(json["missing"], 0);
  EXPECT_GT(json["exact"]["witness"]["pixels"], 100);
  EXPECT_LT(json["exact"]["witness"]["rel_rmse"], 2e-3);
  EXPECT_GT(json["points"].size(), 20u);
  const std::string csv = text(folder_ / "out" / "chart.csv");
  EXPECT_EQ(std::size_t(std::count(csv.begin(), csv.end(), '\n')), json["points"].size() + 1);
  for (const auto& point : json["points"]) {
    EXPECT_GT(point["seconds"], 0);
    EXPECT_GE(point["runs"], 3);
    EXPECT_LT(point["rel_rmse"], 1);
    for (const char* ending : {".jpg", "-error.jpg"})
      EXPECT_TRUE(fs::exists(folder_ / "out" / "points" / (point["id"].get<std::string>() + ending))) << point["id"];
  }
  // What was measured stands; what another choice of methods adds comes to it.
  const Outcome two = run("chart fog.json -o out --methods dda_midpoint");
  ASSERT_EQ(two.exit_code, 0) << two.err;
  const nlohmann::json more = chart("out");
  EXPECT_GT(more["points"].size(), json["points"].size());
  for (const auto& point : json["points"]) {
    const auto same = [&](const nlohmann::json& p) {
      return p["id"] == point["id"] && p["seconds"] == point["seconds"];
    };
    EXPECT_TRUE(std::any_of(more["points"].begin(), more["points"].end(), same)) << point["id"];
  }
  expect_refused("chart ball.json -o out", 2, "out/chart.json: is another chart, of fog.json: the scene is ");
  expect_refused("chart fog.json -o out --size 8x6", 2, "--size is 16,12 there and 8,6 here; allowed: another folder");
}

TEST_F(ChartProgram, WithoutMediaChartsSamples) {
  const Outcome r = run("chart ball.json -o out");
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("brume: note: the scene has no media"));
  const nlohmann::json points = chart("out")["points"];
  ASSERT_EQ(points.size(), 7u);
  EXPECT_EQ(points[0]["method"], "none");
  EXPECT_EQ(points[6]["spp"], 64);
  EXPECT_LT(points[6]["rel_rmse"], points[0]["rel_rmse"].get<double>() / 3);
}

TEST_F(ChartProgram, RefusesWhatCannotBeCharted) {
  expect_refused("chart fog.json -o out --budget 1e-3", 2, "--budget: 0.001 s are too few for one point");
  expect_refused("chart fog.json -o out --budget 0", 2, "--budget");
  expect_refused("chart fog.json -o out --methods march", 2, "--methods: unknown method 'march'; known: dda_nearest");
  expect_refused("chart fog.json -o out --methods homogeneous", 2, "'homogeneous' fits no medium of fog.json");
  expect_refused("chart fog.json", 2, "--output is required");
  expect_refused("chart none.json -o out", 2, "none.json");
  expect_refused("chart fog.json -o fog.json", 2, "fog.json: is a file, expected a folder");
}

TEST_F(ChartProgram, CtrlCKeepsWhatWasMeasured) {
  write("wait.sh",
        "#!/bin/sh\n\"$@\" & p=$!\nfor i in $(seq 600); do [ -f out/chart.json ] && break; sleep 0.1; done\n"
        "kill -INT $p; wait $p\n");
  fs::permissions(folder_ / "wait.sh", fs::perms::owner_all);
  const Outcome r = run("chart fog.json -o out --size 64x48", "", "./wait.sh");
  EXPECT_EQ(r.exit_code, 130) << r.err;
  const nlohmann::json json = chart("out");
  EXPECT_GE(json["points"].size(), 1u);
  EXPECT_GT(json["missing"], 0);
  for (const auto& file : fs::directory_iterator(folder_ / "out"))
    EXPECT_EQ(file.path().string().find(".tmp-"), std::string::npos) << file.path();
}

}  // namespace
}  // namespace brume::test
