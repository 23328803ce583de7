// --witness, --max-error, --time-budget: what a picture says of its error, and pictures that are to reach one.
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace brume::test {
namespace {

const char* const FOG = R"({"film": {"size": [32, 24]}, "camera": {"eye": [1, 1, 4]},
  "lights": [{"type": "directional", "direction": [-0.3, -1, -0.4], "irradiance": [3, 2, 1]}],
  "media": [{"density": {"type": "perlin", "resolution": [24, 24, 24], "scale": 3}, "sigma_a": 0.4, "sigma_s": 1.6}],
  "render": {"method": "march_midpoint", "step": 0.2}})";

class Goals : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("fog.json", FOG);
  }
  // The "error" of the statistics of a render with all pixels as witnesses, unless `options` say otherwise.
  nlohmann::json error_of(const std::string& options, int exit_code = 0) {
    const Outcome outcome = run("render fog.json -o a.exr --stats s.json " + options);
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    said_ = outcome.err;
    return nlohmann::json::parse(text(folder_ / "s.json")).at("error");
  }
  std::string said_;
};

TEST_F(Goals, AreMetByTheWholePicture) {
  const double coarse = error_of("--witness 768").at("estimate");
  EXPECT_GT(coarse, 0.01);
  for (const double goal : {0.02, 0.005}) {
    const nlohmann::json error = error_of("--witness 768 --max-error " + std::to_string(goal));
    EXPECT_EQ(error.at("target"), goal);
    EXPECT_EQ(error.at("witnesses"), 768);
    EXPECT_LE(error.at("estimate"), goal) << said_;
    EXPECT_NE(said_.find("chosen of "), std::string::npos) << said_;
  }
  const nlohmann::json error = error_of("--witness 768 --max-error 0.05 --error-metric max_abs");
  EXPECT_EQ(error.at("metric"), "max_abs");
  EXPECT_LE(error.at("estimate"), 0.05) << said_;
}

// Witnesses ask the full voxels: what they say is how far the picture is from the one without a level.
TEST_F(Goals, ALevelOfDetailIsMeasuredAgainstTheVoxels) {
  const std::string fine = " --method dda_gauss2 --witness 768";
  const double none = error_of(fine).at("estimate"), one = error_of(fine + " --level 1").at("estimate"),
               two = error_of(fine + " --level 2").at("estimate");
  EXPECT_LT(none, 1e-3);
  EXPECT_GT(one, 5 * none);
  EXPECT_GT(two, 2 * one);
  EXPECT_LT(two, 0.5);
  EXPECT_NE(said_.find(", level 2, "), std::string::npos) << said_;
  EXPECT_EQ(nlohmann::json::parse(text(folder_ / "s.json")).at("level"), 2);
}

// A large volume of large shapes, of which a level shows as much as was asked for in less time; refined by its voxels
// where that turns out too coarse.
TEST_F(Goals, AreReachedThroughALevel) {
  const nlohmann::json error = error_of("--witness 768 --max-error 0.02 --set /render/level=2 --method dda_midpoint");
  EXPECT_LE(error.at("estimate"), 0.02) << said_;
}

// A method that is too coarse by itself, and whose pilot has no other choice: march_midpoint at light grids.
TEST_F(Goals, AreReachedByRefiningWhatIsThere) {
  const nlohmann::json error = error_of("--witness 768 --max-error 0.004 --method march_midpoint");
  EXPECT_LE(error.at("estimate"), 0.004) << said_;
}

TEST_F(Goals, OutOfReachAreTold) {
  const nlohmann::json error = error_of("--witness 768 --max-error 1e-9 --strict", 1);
  EXPECT_GT(error.at("estimate"), 1e-9);
  EXPECT_NE(said_.find("max_error 1e-09 is out of reach; the closest, "), std::string::npos) << said_;
  EXPECT_NE(said_.find("max_error 1e-09 is not reached: witnesses say rel_rmse"), std::string::npos) << said_;
  error_of("--time-budget 1e-6 --strict", 1);
  EXPECT_NE(said_.find("time_budget 1e-06 s is too little; the quickest, "), std::string::npos) << said_;
}

TEST_F(Goals, OfTimeComeCloserThanTheQuickest) {
  const double quickest = error_of("--witness 768 --time-budget 1e-6").at("estimate");
  const double closest = error_of("--witness 768 --time-budget 5").at("estimate");
  EXPECT_LT(closest, quickest / 4) << said_;
}

TEST_F(Goals, ThatMeanNothingAreRefusedOrNoted) {
  for (const auto& [options, message] :
       {std::pair{"--max-error 0", "max_error: expected"},
        {"--max-error 0.1 --time-budget 1", "expected without max_error"},
        {"--max-error 0.1 --error-metric mse", "unknown error metric 'mse'"},
        {"--max-error 0.1 --method dda_nearest", "fits no medium"},
        {"--max-error 0.1 --method ratio_tracking", "a method is needed that draws no random numbers"},
        {"--witness -1", "--witness"}}) {
    const Outcome outcome = run("render fog.json -o b.exr " + std::string(options));
    EXPECT_EQ(outcome.exit_code, 2) << options;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
    EXPECT_EQ(files().count("b.exr"), 0u);
  }
  write("empty.json", R"({"film": {"size": [8, 8]}})");
  const Outcome outcome = run("render empty.json -o c.exr --max-error 0.1");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("note: the scene has no media"), std::string::npos) << outcome.err;
}

TEST_F(Goals, WithoutThemAPictureIsToldItsErrorInItsFileToo) {
  const nlohmann::json error = error_of("--witness 64");
  EXPECT_EQ(error.at("witnesses"), 64);
  EXPECT_EQ(error.at("target"), nullptr);
  EXPECT_LT(error.at("interval")[0], error.at("estimate"));
  EXPECT_GT(error.at("interval")[1], error.at("estimate"));
  EXPECT_NE(said_.find("; error "), std::string::npos) << said_;
  EXPECT_NE(text(folder_ / "a.exr").find(" % ± "), std::string::npos);  // metadata of an EXR are plain text
  EXPECT_EQ(error_of("--witness 0").at("estimate"), nullptr);
  EXPECT_EQ(said_.find("; error "), std::string::npos) << said_;
}

// Draws random numbers: chance is a part of its error.
TEST_F(Goals, NoiseIsTold) {
  const nlohmann::json error = error_of("--witness 768 --method ratio_tracking --spp 16");
  EXPECT_GT(error.at("noise"), 0);
  EXPECT_LT(error.at("noise"), 2.0 * error.at("estimate").get<double>());
  EXPECT_GT(error.at("noise"), 0.3 * error.at("estimate").get<double>());
}

}  // namespace
}  // namespace brume::test
