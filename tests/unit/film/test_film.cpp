// The film: sums to planes, planes to files and back, the display curve, and the numbers of the comparison.
#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "base/error.hpp"
#include "film/film_compare.hpp"
#include "film/film_display.hpp"
#include "film/film_write.hpp"

namespace fs = std::filesystem;
using namespace brume;
using testing::HasSubstr;

namespace {

constexpr float INF = std::numeric_limits<float>::infinity();
constexpr float NOT_A_NUMBER = std::numeric_limits<float>::quiet_NaN();

class FilmTest : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_ = fs::temp_directory_path() / ("brume-film-" + std::to_string(::getpid()));
};

// 3 x 2 pixels: a full one, one that missed, four that were never rendered.
Film small_film() {
  Film film({3, 2});
  FilmPixel& full = film.pixels()[0];
  full.samples = 4;
  full.hits = 2;
  full.radiance = {2, 1, 0.5f};
  full.normal = {1, 0, 1};
  full.depth = 7;
  full.transmittance = {4, 2, 1};
  full.lookups = 10;
  film.pixels()[1].samples = 1;
  film.pixels()[1].transmittance = {1, 1, 1};
  return film;
}

Image image_of(int width, std::vector<float> values, std::vector<std::string> names = {"R", "G", "B"}) {
  const int channels = static_cast<int>(names.size());
  const int height = static_cast<int>(values.size()) / width / channels;
  return {width, height, channels, std::move(values), std::move(names), false, 0, "test"};
}

// Reproducible noise in [0,1).
std::vector<float> noise(std::size_t count, unsigned seed) {
  std::vector<float> values;
  for (unsigned x = seed; values.size() < count;)
    values.push_back(float((x = x * 1664525u + 1013904223u) >> 8) / float(1 << 24));
  return values;
}

TEST(Film, PlanesAreMeansOfTheSums) {
  const Film film = small_film();
  const Plane radiance = film.radiance(), depth = film.aov(AOV_DEPTH), normal = film.aov(AOV_NORMAL);
  EXPECT_EQ(radiance.channels, 3);
  EXPECT_FLOAT_EQ(radiance.values[0], 0.5f);
  EXPECT_FLOAT_EQ(radiance.values[2], 0.125f);
  EXPECT_EQ(radiance.values[6], 0);  // never rendered
  EXPECT_EQ(depth.values, (std::vector<float>{3.5f, INF, INF, INF, INF, INF}));
  EXPECT_FLOAT_EQ(normal.values[0], float(std::sqrt(0.5)));
  EXPECT_EQ(normal.values[3], 0);
  EXPECT_FLOAT_EQ(film.aov(AOV_TRANSMITTANCE).values[1], 0.5f);
  EXPECT_FLOAT_EQ(film.aov(AOV_COST).values[0], 2.5f);
  EXPECT_EQ(film.aov(AOV_COST).values[2], 0);
}

TEST(Film, EveryAovHasARowNamesAndValues) {
  ASSERT_EQ(aov_family().size(), std::size_t(AOV_COUNT));
  const Film film = small_film();
  for (const FamilyRow& row : aov_family()) {
    const Aov aov = static_cast<Aov>(row.id);
    const Plane plane = film.aov(aov);
    EXPECT_EQ(plane.name, row.name);
    EXPECT_EQ(plane.channels, aov_channels(aov));
    EXPECT_EQ(aov_channel_names(aov).size(), std::size_t(plane.channels)) << row.name;
    EXPECT_EQ(plane.values.size(), film.pixels().size() * std::size_t(plane.channels)) << row.name;
  }
  EXPECT_EQ(family_find(aov_family(), "normal")->id, AOV_NORMAL);
}

TEST_F(FilmTest, APartIsWhatACutShows) {
  Film film({3, 2});
  for (std::size_t i = 0; i < film.pixels().size(); ++i) {
    film.pixels()[i].samples = 2;
    film.pixels()[i].radiance = {float(i), float(10 * i), 1};
  }
  const Image part = film_image(film, {1, 0}, {3, 2});
  EXPECT_EQ(part.width, 2);
  EXPECT_EQ(part.height, 2);
  EXPECT_EQ(part.values, film.cut({1, 0}, {3, 2}).radiance().values);
  EXPECT_THAT(part.values, testing::ElementsAre(0.5f, 5, 0.5f, 1, 10, 0.5f, 2, 20, 0.5f, 2.5f, 25, 0.5f));
  EXPECT_TRUE(film_image(film, {1, 1}, {1, 2}).values.empty());
}

TEST_F(FilmTest, ExrRoundTripWithLayersAndMetadata) {
  const Film film = small_film();
  const FilmWriteOptions options{3.0,
                                 {AOV_COST, AOV_DEPTH, AOV_NORMAL, AOV_TRANSMITTANCE},
                                 {{"scene", "smoke.json"}, {"version", "0.1"}, {"type", "any"}}};
  film_write(film, folder_ / "a.exr", options);
  auto in = OIIO::ImageInput::open((folder_ / "a.exr").string());
  ASSERT_TRUE(in);
  EXPECT_EQ(in->spec().get_string_attribute("brume:scene"), "smoke.json");
  EXPECT_EQ(in->spec().get_string_attribute("brume:version"), "0.1");
  EXPECT_EQ(in->spec().get_string_attribute("brume:type"), "any");
  EXPECT_EQ(in->spec().get_string_attribute("compression"), "zip");
  EXPECT_EQ(in->spec().format, OIIO::TypeDesc::FLOAT);

  const Image image = image_read(folder_ / "a.exr");
  EXPECT_FALSE(image.from_integers);
  EXPECT_THAT(image.channel_names,
              testing::UnorderedElementsAre("R", "G", "B", "depth.Z", "normal.X", "normal.Y", "normal.Z",
                                            "transmittance.R", "transmittance.G", "transmittance.B", "cost.Y"));
  const Plane radiance = film.radiance(), normal = film.aov(AOV_NORMAL), depth = film.aov(AOV_DEPTH);
  const auto at = [&](std::size_t pixel, const char* name) {
    return image.values[pixel * std::size_t(image.channels) + std::size_t(image_channel(image, name))];
  };
  for (std::size_t i = 0; i < 6; ++i) {  // linear: the exposure does not touch it
    EXPECT_EQ(at(i, "R"), radiance.values[i * 3]);
    EXPECT_EQ(at(i, "B"), radiance.values[i * 3 + 2]);
    EXPECT_EQ(at(i, "normal.Z"), normal.values[i * 3 + 2]);
    EXPECT_EQ(at(i, "depth.Z"), depth.values[i]);
  }
  EXPECT_EQ(image_compare(image, image, "depth").rmse, 0);
  EXPECT_EQ(image_compare(film_image(film), image).max_abs, 0);
}

TEST_F(FilmTest, DisplayFilesHoldTheCurveThatIsAskedFor) {
  Film film({1, 1});
  film.pixels()[0].samples = 1;
  film.pixels()[0].radiance = {0.001f, 0.18f, 5};
  FilmWriteOptions options;
  options.transfer = TRANSFER_SRGB;
  film_write(film, folder_ / "a.png", options);
  film_write(film, folder_ / "a.exr", options);
  const Image shown = image_read(folder_ / "a.png"), linear = image_read(folder_ / "a.exr");
  const int codes[] = {3, 118, 255};
  for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(std::lround(shown.values[c] * 255), codes[c]);
  EXPECT_EQ(linear.values[std::size_t(image_channel(linear, "B"))], 5);  // nothing is cut
}

TEST_F(FilmTest, DisplayFilesHoldTheCurve) {
  Film film({3, 1});
  const Packed3 radiance[] = {{0, 0.25f, 0.09f}, {NOT_A_NUMBER, -1, 5}, {0.001f, 0.5f, INF}};
  for (std::size_t i = 0; i < 3; ++i) film.pixels()[i].samples = 1, film.pixels()[i].radiance = radiance[i];
  film_write(film, folder_ / "a.png", {1, {AOV_DEPTH}, {}});
  const Image image = image_read(folder_ / "a.png");
  EXPECT_TRUE(image.from_integers);
  EXPECT_EQ(image.channels, 3);
  const int codes[] = {0, 186, 117, 0, 0, 255, 15, 255, 255};  // 255 (2 r)^(1/2.2), worked out by hand
  for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(std::lround(image.values[i] * 255), codes[i]) << i;

  film_write(film, folder_ / "a.jpg", {});
  EXPECT_EQ(image_read(folder_ / "a.jpg").width, 3);
  EXPECT_THROW(film_write(film, folder_ / "a.bmp", {}), InputError);
}

TEST(FilmCompare, NumbersOfASmallCase) {
  std::vector<float> a(12, 1), b(12, 1);
  a[7] = 3;     // pixel (0,1), G: +2
  a[9] = 1.5f;  // pixel (1,1), R: +0.5
  a[0] = 1.00005f;
  const CompareResult result = image_compare(image_of(2, a), image_of(2, b));
  EXPECT_NEAR(result.rmse, std::sqrt(4.25 / 12), 1e-7);
  EXPECT_NEAR(result.mean_a, 14.5 / 12, 1e-5);
  EXPECT_EQ(result.mean_b, 1);
  EXPECT_NEAR(result.rel_rmse, result.rmse, 1e-12);
  EXPECT_EQ(result.max_abs, 2);
  EXPECT_EQ(result.max_x, 0);
  EXPECT_EQ(result.max_y, 1);
  EXPECT_EQ(result.max_channel, "G");
  EXPECT_EQ(result.different, 2u);  // 5e-5 relative is no difference
  EXPECT_EQ(result.nan, 0u);
  EXPECT_EQ(result.display_rmse, 0);  // 1 and 3 are both white
  EXPECT_FALSE(result.on_display);
}

TEST(FilmCompare, NanAndInfinity) {
  const std::vector<std::string> z = {"depth.Z"};
  const Image a = image_of(4, {INF, 1, NOT_A_NUMBER, 2}, z), b = image_of(4, {INF, 1, 5, 4}, z);
  const CompareResult result = image_compare(a, b, "depth");
  EXPECT_EQ(result.nan, 1u);
  EXPECT_EQ(result.different, 2u);
  EXPECT_NEAR(result.rmse, std::sqrt(4.0 / 3), 1e-12);
  EXPECT_EQ(result.mean_b, 2.5);
  const CompareResult missed = image_compare(image_of(1, {INF}, z), image_of(1, {1}, z));
  EXPECT_EQ(missed.max_abs, INF);
  EXPECT_EQ(missed.rmse, INF);
  EXPECT_EQ(image_compare(image_of(1, {1}, z), image_of(1, {INF}, z)).different, 1u);
}

TEST(FilmCompare, PercentileAndDisplayValues) {
  std::vector<float> a(300, 0), b(300, 0);
  for (std::size_t i = 0; i < 4; ++i) a[i * 50] = 1;  // 4 of 300 values: more than 1 %
  EXPECT_EQ(image_compare(image_of(10, a), image_of(10, b)).display_p99, 1);
  a[0] = 0;  // 3 of 300: exactly 1 %
  EXPECT_EQ(image_compare(image_of(10, a), image_of(10, b)).display_p99, 0);

  Image codes = image_of(1, {0.72974005f, 1, 0});
  codes.from_integers = true;  // against integers, floats are seen through the display curve
  const CompareResult result = image_compare(image_of(1, {0.5f, 3, -1}), codes);
  EXPECT_TRUE(result.on_display);
  EXPECT_NEAR(result.max_abs, 0, 1e-7);
}

TEST(FilmCompare, MismatchesAreInputErrors) {
  const auto message = [](const Image& a, const Image& b, const char* layer) -> std::string {
    try {
      image_compare(a, b, layer);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const Image wide = image_of(2, std::vector<float>(6)), tall = image_of(1, std::vector<float>(6));
  EXPECT_THAT(message(wide, tall, ""), testing::AllOf(HasSubstr("2 x 1"), HasSubstr("1 x 2")));
  EXPECT_THAT(message(wide, image_of(2, {0, 0}, {"Y"}), ""), HasSubstr("3 channels"));
  EXPECT_THAT(message(wide, wide, "depth"), HasSubstr("no layer 'depth'; channels: R, G, B"));
}

TEST(FilmCompare, DifferencePicture) {
  const Image picture =
      image_difference(image_of(2, {1, 1, 1, NOT_A_NUMBER, 1, 1}), image_of(2, {1, 1.5f, 3, 1, 1, 1}));
  EXPECT_EQ(picture.values, (std::vector<float>{0, 0.25f, 1, 1, 0, 0}));
  const Image grey = image_difference(image_of(1, {2}, {"Y"}), image_of(1, {2}, {"Y"}));
  EXPECT_EQ(grey.values, (std::vector<float>{0, 0, 0}));
}

TEST(FilmCompare, BlockMeans) {
  std::vector<float> values(5 * 3);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = float(i);
  const Image means = block_means(image_of(5, values, {"Y"}), 2);
  EXPECT_EQ(means.width, 3);
  EXPECT_EQ(means.height, 2);
  EXPECT_EQ(means.values, (std::vector<float>{3, 5, 6.5f, 10.5f, 12.5f, 14}));
}

// The same numbers as a program that nobody here wrote.
TEST_F(FilmTest, AgreesWithOiiotool) {
  if (std::system("command -v oiiotool > /dev/null 2>&1") != 0) GTEST_SKIP() << "absent: oiiotool";
  const Image a = image_of(40, noise(40 * 30 * 3, 1)), b = image_of(40, noise(40 * 30 * 3, 2));
  for (const auto& [name, image] : {std::pair{"a.exr", &a}, std::pair{"b.exr", &b}}) {
    const float* values = image->values.data();
    image_write_exr(folder_ / name, 40, 30, {{"R", values, 3}, {"G", values + 1, 3}, {"B", values + 2, 3}}, {});
  }
  const std::string command = "oiiotool --diff " + (folder_ / "a.exr").string() + " " + (folder_ / "b.exr").string();
  std::FILE* pipe = ::popen(command.c_str(), "r");
  std::string output(4096, '\0');
  output.resize(std::fread(output.data(), 1, output.size(), pipe));
  ::pclose(pipe);
  double mean = -1, rms = -1, max = -1;
  int x = -1, y = -1;
  const auto scan = [&](const char* key, const char* format, auto*... values) {
    const std::size_t at = output.find(key);
    return at == std::string::npos ? 0 : std::sscanf(output.c_str() + at, format, values...);
  };
  ASSERT_EQ(scan("Mean error", "Mean error = %lf", &mean), 1) << output;
  ASSERT_EQ(scan("RMS error", "RMS error = %lf", &rms), 1) << output;
  ASSERT_EQ(scan("Max error", "Max error = %lf @ (%d, %d", &max, &x, &y), 3) << output;

  const CompareResult result = image_compare(image_read(folder_ / "a.exr"), image_read(folder_ / "b.exr"));
  EXPECT_NEAR(result.rmse, rms, 1e-5 * rms);
  EXPECT_NEAR(result.max_abs, max, 1e-5 * max);
  EXPECT_EQ(result.max_x, x);
  EXPECT_EQ(result.max_y, y);
}

TEST(FilmCompare, AMissingLayerNamesSomeOfThoseThatThereAre) {
  std::vector<std::string> names;
  names.reserve(1000);
  for (int i = 0; i < 1000; ++i) names.push_back("layer" + std::to_string(i) + ".X");
  const Image image = image_of(1, std::vector<float>(1000), names);
  try {
    image_compare(image, image, "none");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::EndsWith(", layer22.X, layer23.X and 976 more"));
  }
}

}  // namespace
