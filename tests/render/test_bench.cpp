// brume bench as a user sees it: its table and JSON, and what changed from one JSON to another.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "shared/method.h"

namespace brume::test {
namespace {

using testing::HasSubstr;
using Json = nlohmann::ordered_json;

class Bench : public Program {
 protected:
  static Json row(const std::string& name, const std::vector<double>& seconds, double error) {
    return {{"name", name}, {"median", seconds[0]}, {"spread", 0}, {"seconds", seconds}, {"rel_rmse", error}};
  }

  void write_results(const std::string& name, const Json& rows, int size = 512, const char* version = "1") const {
    const Json all{{"version", version}, {"device", "a device"}, {"driver", "1"},
                   {"units", 2},         {"lanes", 8},           {"size", size}};
    Json results = all;
    results["benchmarks"] = rows;
    write(name, results.dump());
  }
};

TEST_F(Bench, SaysWhatChangedByMoreThanItsNoise) {
  const std::vector<double> steady{1.00, 1.01, 0.99};
  write_results("before.json", {row("render/a/quick", steady, 0.01), row("render/a/slow", steady, 0.01),
                                row("render/a/same", steady, 0.01), row("render/a/once", {1}, 0.01),
                                row("render/a/worse", steady, 0.01), row("render/a/gone", steady, 0.01)});
  write_results("after.json",
                {row("render/a/quick", {0.70, 0.71, 0.69}, 0.01), row("render/a/slow", {2.00, 2.02, 1.98}, 0.005),
                 row("render/a/same", {1.02, 1.00, 1.01}, 0.01), row("render/a/once", {1.02}, 0.0100001),
                 row("render/a/worse", steady, 0.02), row("render/a/new", steady, 0.01)},
                512, "2");
  const Outcome r = run("bench --compare before.json after.json");
  ASSERT_EQ(r.exit_code, 0) << r.err;
  const auto line_of = [&](const std::string& name) {
    const std::size_t at = r.out.find("render/a/" + name + " ");
    return at == std::string::npos ? "" : r.out.substr(at, r.out.find('\n', at) - at);
  };
  EXPECT_THAT(line_of("quick"), HasSubstr("-30.0 %"));
  EXPECT_THAT(line_of("quick"), HasSubstr("  quicker"));
  EXPECT_THAT(line_of("slow"), HasSubstr("+100.0 %"));
  EXPECT_THAT(line_of("slow"), HasSubstr("  slower, closer: 1.00 % to 0.50 %"));
  EXPECT_THAT(line_of("worse"), HasSubstr("  further off: 1.00 % to 2.00 %"));
  EXPECT_EQ(line_of("same"), "");
  EXPECT_EQ(line_of("once"), "");
  EXPECT_THAT(r.out, HasSubstr("1 quicker, 1 slower, 3 within their noise"));
  EXPECT_THAT(r.out, HasSubstr("versions 1 and 2\n"));
  EXPECT_THAT(r.out, HasSubstr("only in the first: render/a/gone\n"));
  EXPECT_THAT(r.out, HasSubstr("only in the second: render/a/new\n"));
}

// Two runs of a quarter more or less are no change where all others scatter as much.
TEST_F(Bench, TakesNoNoiseForAChange) {
  Json before, after;
  for (int i = 0; i < 9; ++i) {
    const std::string name = "render/" + std::to_string(i);
    before.push_back(row(name, {1.0, 1.2, 0.9}, 0));
    after.push_back(row(name, {1.1, 0.9, 1.25}, 0));
  }
  after[4] = row("render/4", {1.25, 1.25, 1.25}, 0);
  write_results("before.json", before);
  write_results("after.json", after);
  const Outcome r = run("bench --compare before.json after.json");
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("0 quicker, 0 slower, 9 within their noise"));
}

TEST_F(Bench, RefusesWhatCannotBeCompared) {
  const std::vector<double> once{1};
  write_results("a.json", Json::array({row("render/a", once, 0)}));
  write_results("b.json", Json::array({row("render/b", once, 0)}));
  write_results("small.json", Json::array({row("render/a", once, 0)}), 64);
  write_results("broken.json", Json::array({row("render/a", {-1}, 0)}));
  write("scene.json", "{}");
  expect_refused("bench --compare a.json b.json", 2, "--compare: the two have no benchmark in common");
  expect_refused("bench --compare a.json small.json", 2, "pictures of 512 and 64 pixels a side");
  expect_refused("bench --compare a.json scene.json", 2,
                 "scene.json: /: no result of brume bench: it has no 'version'");
  expect_refused("bench --compare a.json broken.json", 2,
                 "broken.json: /benchmarks/0/seconds/0: expected a number > 0, got -1");
  expect_refused("bench --compare a.json no.json", 2, "no.json");
}

// Within a closed sphere every ray hits it, and nothing lies between it and the lamp; so says the peer, where it is.
TEST_F(Bench, FollowsRaysBesideEmbree) {
  const Outcome r = run("bench --peers --repetitions 1 --filter sphere70k/ --json rays.json");
  ASSERT_EQ(r.exit_code, 0) << r.err;
  const Json json = Json::parse(text(folder_ / "rays.json"));
  ASSERT_EQ(json["benchmarks"].size(), 8u);
  for (const Json& row : json["benchmarks"]) {
    const std::string name = row["name"];
    if (row.contains("failure") || name.find("build") != std::string::npos) continue;
    EXPECT_EQ(row["seconds"].size(), 5u) << name;
    EXPECT_GT(row["rays"], 262000) << name;
    const double share = row["hits"].get<double>() / row["rays"].get<double>();
    EXPECT_NEAR(share, name.find("shadow") != std::string::npos ? 0 : 1, 1e-4) << name;
  }
}

TEST_F(Bench, MeasuresARowForEachBenchmark) {
  const Outcome r = run("bench --size 16 --filter 'render/fog128/march_midpoint_(1/trace|4/grid32)' --json out.json");
  ASSERT_EQ(r.exit_code, 0) << r.err;
  const Json json = Json::parse(text(folder_ / "out.json"));
  ASSERT_EQ(json["benchmarks"].size(), 2u);
  const Json traced = json["benchmarks"][0], grid = json["benchmarks"][1];
  EXPECT_EQ(traced["name"], "render/fog128/march_midpoint_1/trace");
  EXPECT_EQ(traced["seconds"].size(), 1u);
  EXPECT_EQ(grid["seconds"].size(), 3u);
  for (const Json& row : {traced, grid}) {
    EXPECT_GT(row["median"], 0);
    EXPECT_GT(row["rel_rmse"], 0);
    EXPECT_GT(row["lookups"], 0);
    EXPECT_GT(row["device_bytes"], 0);
    EXPECT_THAT(r.out, HasSubstr("\n" + row["name"].get<std::string>() + " "));
  }
  EXPECT_EQ(run("bench --compare out.json out.json").exit_code, 0);
  expect_refused("bench --size 16 --filter nothing_4711", 2, "--filter: no benchmark matches 'nothing_4711'");
}

// What only absorbs is held against VTK: the same picture to a percent where that is, else the row says what is
// missing.
TEST_F(Bench, AbsorbsBesideVtk) {
  const std::string filter = " --size 32 --repetitions 1 --filter 'absorb/fog128/|peer/fog128/vtk' ";
  const Outcome r = run("bench --peers" + filter + "--json out.json");
  ASSERT_EQ(r.exit_code, 0) << r.err;
  std::map<std::string, Json> rows;
  const Json json = Json::parse(text(folder_ / "out.json"));
  for (const Json& row : json["benchmarks"]) rows[row["name"]] = row;
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows["absorb/fog128/dda_gauss2"]["rel_rmse"], 0);
  for (const char* name : {"dda_midpoint", "march_midpoint_1"}) {
    const Json& row = rows[std::string("absorb/fog128/") + name];
    EXPECT_EQ(row["seconds"].size(), 5u) << name;
    EXPECT_GT(row["rel_rmse"], 0) << name;
    EXPECT_LT(row["rel_rmse"], 1e-4) << name;
    EXPECT_GT(row["lookups"], 0) << name;
  }
  const Json& vtk = rows["peer/fog128/vtk"];
  if (!vtk.contains("failure")) {
    EXPECT_EQ(vtk["seconds"].size(), 5u);
    EXPECT_LT(vtk["rel_rmse"], 0.01);
  }
  const Outcome without = run("bench --peers" + filter, "BRUME_PYTHON=/bin/false");
  EXPECT_EQ(without.exit_code, 0) << without.err;
  EXPECT_THAT(without.out, HasSubstr("no VTK here (BRUME_PYTHON names a Python that has it)"));
}

TEST_F(Bench, LongKernelsOfASceneAreHeldAgainstGenericOnes) {
  write("a.json", R"({"lights": [{"type": "directional", "direction": [0, -1, 0], "irradiance": 1}],
    "media": [{"density": {"type": "perlin", "resolution": [8, 8, 8]}, "sigma_a": 1, "sigma_s": 1}]})");
  const Outcome r = run("bench --kernels a.json --size 24 --repetitions 1 --json out.json");
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("\na.json "));
  const Json row = Json::parse(text(folder_ / "out.json"))["scenes"][0];
  EXPECT_EQ(row["pixels"], 24 * 24);
  for (const char* kind : {"specialised", "generic"}) {
    EXPECT_GT(row[kind]["cold_build_s"], row[kind]["warm_build_s"]) << kind;
    EXPECT_GT(row[kind]["warm_build_s"], 0) << kind;
    EXPECT_GT(row[kind]["render_s"], 0) << kind;
  }
  EXPECT_LT(row["specialised"]["cold_build_s"], row["generic"]["cold_build_s"]);
  EXPECT_EQ(files(), (std::set<std::string>{"a.json", "out.json"}));
}

TEST_F(Bench, RefusesKernelsOfWhatIsNoScene) {
  write("broken.json", "{");
  expect_refused("bench --kernels none.json", 2, "none.json");
  const Outcome r = run("bench --kernels broken.json");
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_THAT(r.err, HasSubstr("broken.json: was not rendered"));
}

// Lookups grow as they should, whatever the machine is busy with.
TEST_F(Bench, LongScalingTurnsOneNumberAtATime) {
  const Outcome r = run("bench --scaling out --most 2 --repetitions 1");
  ASSERT_EQ(r.exit_code, 0) << r.err;
  const Json json = Json::parse(text(folder_ / "out/scaling.json"));
  std::map<std::string, Json> axes;
  for (const Json& axis : json["axes"]) axes[axis["name"]] = axis;
  EXPECT_EQ(axes.size(), 9u);
  EXPECT_EQ(axes["pixels a side"]["points"].size(), 0u);
  EXPECT_TRUE(axes["pixels a side"]["exponent"].is_null());
  ASSERT_EQ(axes["lights"]["points"].size(), 2u);
  EXPECT_GT(axes["lights"]["points"][1]["seconds"], 0);
  EXPECT_NEAR(axes["lights"]["lookups_exponent"].get<double>(), 1, 0.2);
  EXPECT_NEAR(axes["overlapping media, light grid"]["lookups_exponent"].get<double>(), 1, 0.2);
  EXPECT_NEAR(axes["overlapping media, light traced"]["lookups_exponent"].get<double>(), 1, 0.2);
  EXPECT_EQ(axes["threads"]["lookups_exponent"].get<double>(), 0);
  EXPECT_THAT(r.out, HasSubstr("\noverlapping media, light grid\n       1 "));
  if (std::system("command -v gnuplot >/dev/null") == 0) {
    EXPECT_THAT(text(folder_ / "out/scaling.svg"), HasSubstr("overlapping media, light grid: "));
    EXPECT_GT(fs::file_size(folder_ / "out/scaling.png"), 1000u);
    EXPECT_FALSE(fs::exists(folder_ / "out/scaling.gnuplot"));
  }
}

// Whatever the machine is busy with, no part is quicker than the device.
TEST_F(Bench, LongRooflineHoldsEveryPartAgainstTheDevice) {
  const Outcome r = run("bench --roofline out --size 32 --repetitions 2");
  ASSERT_EQ(r.exit_code, 0) << r.err;
  std::set<std::string> expected{"limit/copy",
                                 "limit/fma",
                                 "limit/loads",
                                 "cells",
                                 "light_grid/lookups",
                                 "light_grid/points",
                                 "rays/primary",
                                 "rays/shadow",
                                 "rays/secondary",
                                 "rays/one_mesh",
                                 "rays/100000_instances",
                                 "picture/primary_rays",
                                 "picture/shade",
                                 "picture/traverse_dda",
                                 "picture/accumulate",
                                 "picture/transfer",
                                 "picture/write",
                                 "build/bvh",
                                 "build/bricks",
                                 "image/write_png",
                                 "image/read_png",
                                 "image/write_exr",
                                 "image/read_exr"};
#define ROW(id, name, fits, placement, rule, share, jitter, draws, exact, help) \
  if ((fits) & (FITS_NEAREST | FITS_TRILINEAR)) expected.insert(std::string("lookups/") + (name));
  BRUME_METHODS(ROW)
#undef ROW
  std::set<std::string> names;
  const Json json = Json::parse(text(folder_ / "out/roofline.json"));
  for (const Json& row : json["benchmarks"]) {
    const std::string name = row["name"];
    names.insert(name);
    EXPECT_GT(row["items"], 0) << name;
    EXPECT_GT(row["item_bytes"].get<double>() + row["item_flops"].get<double>() + row["item_loads"].get<double>(), 0)
        << name;
    EXPECT_GT(row["share"], 0) << name;
    EXPECT_LE(row["share"], 1.5) << name;
    EXPECT_THAT(r.out, HasSubstr("\n" + name + " "));
  }
  EXPECT_EQ(names, expected);
  EXPECT_EQ(run("bench --compare out/roofline.json out/roofline.json").exit_code, 0);
  if (std::system("command -v gnuplot >/dev/null") == 0) {
    EXPECT_THAT(text(folder_ / "out/roofline.svg"), HasSubstr("lookups/march_midpoint"));
    EXPECT_GT(fs::file_size(folder_ / "out/roofline.png"), 1000u);
  }
}

// The counts of items do not hang on the clock: the rays of a picture, those that seven mirrors send on, its cells.
TEST_F(Bench, LongRooflineCountsWhatItSays) {
  ASSERT_EQ(run("bench --roofline out --size 32 --repetitions 1 --json out.json").exit_code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "out/roofline.json"));
  std::map<std::string, double> items;
  const Json json = Json::parse(text(folder_ / "out.json"));
  for (const Json& row : json["benchmarks"]) items[row["name"]] = row["items"];
  EXPECT_EQ(items["rays/primary"], 32 * 32);
  EXPECT_EQ(items["rays/shadow"], 32 * 32);
  EXPECT_EQ(items["rays/secondary"], 8 * 32 * 32);
  EXPECT_EQ(items["picture/accumulate"], 32 * 32);
  EXPECT_EQ(items["build/bricks"], 128 * 128 * 128);
  // Two lookups a cell, but for rays that are black before their end.
  EXPECT_NEAR(items["lookups/dda_gauss2"] / items["cells"], 2, 0.1);
  EXPECT_EQ(items["lookups/dda_gauss2"], 2 * items["lookups/dda_midpoint"]);
}

}  // namespace
}  // namespace brume::test
