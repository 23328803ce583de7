// chart.csv and chart.json, the folder that they stand in, the page and the script for gnuplot.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "chart/chart_folder.hpp"
#include "chart/chart_text.hpp"
#include "chart/page.hpp"
#include "chart_fixture.hpp"

namespace brume {
namespace {

using test::chart_example;
using testing::HasSubstr;

TEST(ChartCsv, AColumnForEveryKnobAndNumber) {
  EXPECT_EQ(chart_csv(chart_example()),
            "method,step,tolerance,level,light_grid,storage,rule,spp,seconds,seconds_spread,build_seconds,lookups,"
            "rel_rmse,max_abs,display,pareto\n"
            "dda_gauss2,,,,,f32,segment,1,0.5,0.005,1.25,123456789,0,0,0,0\n"
            "march_midpoint,0.125,,,64,u8,rectangle,4,0.01234568,0.0001234568,1.25,123456789,0.03,0.06,0.015,0\n");
}

TEST(ChartJson, HasTheKeysThatPeopleRely) {
  const auto json = nlohmann::json::parse(chart_json(chart_example()));
  for (const char* key : {"scene", "hash", "size", "device", "lanes", "version", "exact", "points", "orders"})
    EXPECT_TRUE(json.contains(key)) << key;
  EXPECT_EQ(json["exact"]["witness"]["pixels"], 48);
  EXPECT_EQ(json["exact"]["witness"]["interval95"][1], 1.2e-4);
  EXPECT_EQ(json["points"][1]["id"], "march_midpoint-step0.125-grid64-u8-rectangle-spp4");
  EXPECT_TRUE(json["points"][0]["step"].is_null());
  EXPECT_EQ(json["orders"][0]["fitted"], 1.98);
}

class ChartFiles : public test::ChartFolderTest {
 protected:
  void refused(const std::function<void()>& call, const std::string& cause) {
    try {
      call();
      ADD_FAILURE() << "not refused: " << cause;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(cause));
    }
  }
  // A chart of an earlier run, with the pictures of its first point only.
  void leave(const Chart& chart) {
    const ChartFolder folder(folder_, chart.identity, true);
    folder.json_write(chart);
    std::ofstream(folder.picture_file(chart.points[0].knobs)) << "picture";
    std::ofstream(folder.error_file(chart.points[0].knobs)) << "error";
  }
};

TEST_F(ChartFiles, ReadBackAsTheyWere) {
  const Chart chart = chart_example();
  atomic_write(folder_ / "chart.json", chart_json(chart));
  Chart read = chart_read(folder_ / "chart.json");
  read.orders = chart.orders, read.peers = chart.peers, read.missing = chart.missing;  // made anew by each run
  EXPECT_EQ(chart_json(read), chart_json(chart));
}

TEST_F(ChartFiles, ThatAreNoChartAreRefused) {
  const std::string text = chart_json(chart_example());
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string other = text;
    other.replace(other.find(from), from.size(), to);
    atomic_write(folder_ / "chart.json", other);
    return [this] { chart_read(folder_ / "chart.json"); };
  };
  refused(changed("\"hash\"", "\"hush\""), "the key 'hash' is missing");
  refused(changed("\"march_midpoint\"", "\"marsh\""), "/points/1/method: unknown method 'marsh'");
  refused(changed("0.0123456789", "\"soon\""), "/points/1/seconds: expected a number");
  refused(changed("\"points\"", "\"points"), "chart.json: line");
  refused(
      [&] {
        changed("\"hash\"", "\"hush\"");
        ChartFolder(folder_, chart_example().identity, false);
      },
      "(it has 'hush'); allowed: another folder, or --overwrite");
}

TEST_F(ChartFiles, GoOnWithThePointsWhosePicturesAreThere) {
  const Chart chart = chart_example();
  leave(chart);
  const ChartFolder folder(folder_, chart.identity, false);
  ASSERT_EQ(folder.kept().points.size(), 1u);
  EXPECT_EQ(knobs_id(folder.kept().points[0].knobs), knobs_id(chart.points[0].knobs));
  EXPECT_EQ(folder.kept().exact.pixels, 48);
}

TEST_F(ChartFiles, OfAnotherChartAreRefused) {
  leave(chart_example());
  ChartIdentity other = chart_example().identity;
  other.hash = "fedcba9876543210";
  refused([&] { ChartFolder(folder_, other, false); },
          "is another chart, of fog.json: the scene is 0123456789abcdef there and fedcba9876543210 here; allowed: "
          "another folder, or --overwrite");
  other = chart_example().identity;
  other.size = {16, 6};
  refused([&] { ChartFolder(folder_, other, false); }, "--size is 8,6 there and 16,6 here");
  other = chart_example().identity;
  other.version = "0.2.0";
  refused([&] { ChartFolder(folder_, other, false); }, "the version of brume is 0.1.0 there and 0.2.0 here");
  EXPECT_TRUE(ChartFolder(folder_, other, true).kept().points.empty());
}

TEST_F(ChartFiles, AFolderThatStaysEmptyGoesAgain) {
  const std::filesystem::path fresh = folder_ / "a" / "chart";
  { const ChartFolder folder(fresh, chart_example().identity, false); }
  EXPECT_FALSE(std::filesystem::exists(fresh));
  std::ofstream(folder_ / "file") << "text";
  refused([&] { ChartFolder(folder_ / "file", chart_example().identity, false); }, "is a file, expected a folder");
}

TEST(ChartPage, Base64) {  // RFC 4648, section 10
  EXPECT_EQ(base64_text(""), "");
  EXPECT_EQ(base64_text("f"), "Zg==");
  EXPECT_EQ(base64_text("fo"), "Zm8=");
  EXPECT_EQ(base64_text("foo"), "Zm9v");
  EXPECT_EQ(base64_text("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64_text("\xff\xfe"), "//4=");
}

TEST_F(ChartFiles, APageHoldsAllThatItShows) {
  Chart chart = chart_example();
  chart.points.resize(1);
  chart.identity.scene = "</script><b>.json";
  leave(chart);
  std::ofstream(folder_ / "exact.jpg") << "exact";
  const std::string page = chart_page(chart, ChartFolder(folder_, chart.identity, false));
  EXPECT_THAT(page, HasSubstr("data:image/jpeg;base64," + base64_text("picture")));
  EXPECT_THAT(page, HasSubstr("data:image/jpeg;base64," + base64_text("error")));
  EXPECT_THAT(page, HasSubstr("data:image/jpeg;base64," + base64_text("exact")));
  EXPECT_THAT(page, HasSubstr("<\\/script><b>.json"));
  for (const char* outside : {"</script><b>", "src=\"http", "href=", "@CHART@", "@PICTURES@"})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
}

TEST(ChartPlot, NamesCannotLeaveTheirQuotes) {
  Chart chart = chart_example();
  chart.identity.scene = "it's `rm`.json\nset output 'x'";
  const std::string script = plot_script(chart);
  EXPECT_THAT(script,
              HasSubstr("chart_title = 'it''s `rm`.json?set output ''x'', 8 x 6, a CPU (a platform), 8 lanes'\n"));
  EXPECT_THAT(script,
              HasSubstr("methods = 'dda_gauss2 march_midpoint'\nmarks = '" + std::to_string(METHOD_DDA_GAUSS2 + 1) +
                        " " + std::to_string(METHOD_MARCH_MIDPOINT + 1) + "'\n"));
  for (const char* array : {"array shapes[", "array colors["})
    EXPECT_THAT(script, HasSubstr(array + std::to_string(METHOD_COUNT) + "] = ["));
  EXPECT_THAT(script, HasSubstr("$points << EOD\n0.5 5e-05\n\n\n0.0123457 0.03\nEOD\n"));
  EXPECT_THAT(script, HasSubstr("4.5 0.047 \"vdb_render\"\n"));
}

}  // namespace
}  // namespace brume
