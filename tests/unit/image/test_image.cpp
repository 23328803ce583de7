// Image files: what is read and how it is decoded.
#include <cmath>

#include "unit/image/image_fixture.hpp"

namespace brume::test {
namespace {

TEST(SrgbDecode, KnownValuesAndContinuity) {
  EXPECT_EQ(srgb_decode(0), 0);
  EXPECT_EQ(srgb_decode(1), 1);
  EXPECT_NEAR(srgb_decode(10 / 255.0), 10 / (255.0 * 12.92), 1e-16);
  EXPECT_NEAR(srgb_decode(128 / 255.0), 0.21586050011389926, 1e-15);
  EXPECT_NEAR(srgb_decode(0.04045), srgb_decode(0.0404500001), 1e-7);
}

TEST_F(ImageTest, IntegerTexturesAreDecodedExactly) {
  const Image bytes = image_read_texture(write<unsigned char>("a.png", 4, 1, OIIO::TypeDesc::UINT8, {0, 10, 128, 255}));
  ASSERT_EQ(bytes.values.size(), 12u);
  const float expected[] = {0, float(10 / (255 * 12.92)), 0.2158605f, 1};
  for (std::size_t i = 0; i < 12; ++i) EXPECT_FLOAT_EQ(bytes.values[i], expected[i / 3]) << i;
  EXPECT_TRUE(bytes.from_integers);

  const std::vector<unsigned short> codes = {0, 2570, 32896, 65535, 1, 40000};
  for (const char* name : {"b.png", "b.tif"}) {
    const Image words = image_read_texture(write(name, 6, 1, OIIO::TypeDesc::UINT16, codes));
    for (std::size_t i = 0; i < codes.size(); ++i)
      EXPECT_EQ(words.values[i * 3], float(srgb_decode(codes[i] / 65535.0))) << name << codes[i];
  }
}

// With alpha 0, what OpenImageIO writes is not divided by alpha, and a colour that reading multiplied would be 0.
TEST_F(ImageTest, AlphaIsDroppedAndNotMultipliedIn) {
  const std::vector<unsigned char> rgba = {128, 10, 255, 0}, grey_alpha = {128, 0};
  const Image color = image_read_texture(write("a.png", 1, 4, OIIO::TypeDesc::UINT8, rgba));
  const Image grey = image_read_texture(write("b.png", 1, 2, OIIO::TypeDesc::UINT8, grey_alpha));
  ASSERT_EQ(color.channels, 3);
  ASSERT_EQ(grey.channels, 3);
  EXPECT_FLOAT_EQ(color.values[0], 0.2158605f);
  EXPECT_FLOAT_EQ(color.values[1], float(10 / (255 * 12.92)));
  EXPECT_EQ(color.values[2], 1);
  for (float value : grey.values) EXPECT_FLOAT_EQ(value, 0.2158605f);
}

TEST_F(ImageTest, RowZeroIsTheTopRow) {
  const Image png =
      image_read_texture(write("a.png", 1, 1, OIIO::TypeDesc::UINT8, std::vector<unsigned char>{255, 0, 0}));
  EXPECT_EQ(png.height, 3);
  EXPECT_EQ(png.values[0], 1);
  EXPECT_EQ(png.values[6], 0);
  const fs::path exr =
      write("a.exr", 1, 1, OIIO::TypeDesc::FLOAT, std::vector<float>{7, 0, 0}, "openexr:lineOrder", "decreasingY");
  EXPECT_EQ(image_read_texture(exr).values[0], 7);
}

TEST_F(ImageTest, ContentDecidesAndNotTheExtension) {
  const fs::path file = write("a.png", 1, 1, OIIO::TypeDesc::UINT8, std::vector<unsigned char>{255});
  fs::rename(file, folder_ / "a.psd");
  EXPECT_EQ(image_read_texture(folder_ / "a.psd").values[0], 1);
  std::ofstream(folder_ / "text.png") << "not a picture";
  EXPECT_THAT(refusal(folder_ / "text.png"), HasSubstr("known: exr, png, jpg, hdr, tif"));
  EXPECT_THAT(refusal(folder_ / "absent.png"), HasSubstr("No such file"));
  EXPECT_THAT(refusal(folder_), HasSubstr("is a folder"));
}

TEST_F(ImageTest, OtherIntegersAreNoTexture) {
  const fs::path file = write("a.tif", 1, 1, OIIO::TypeDesc::UINT32, std::vector<unsigned>{1u << 31});
  EXPECT_THAT(refusal(file), HasSubstr("8- or 16-bit"));
  EXPECT_NEAR(image_read(file).values[0], 0.5, 1e-6);
}

// One value per pixel, x + 10 y in coordinates of the display window; data window [x0, x1) x [y0, y1) of a picture of 4
// x 3.
fs::path write_window(const fs::path& file, int x0, int y0, int x1, int y1, int tile = 0, int origin = 0) {
  OIIO::ImageSpec spec(x1 - x0, y1 - y0, 1, OIIO::TypeDesc::FLOAT);
  spec.x = x0 + origin, spec.y = y0 + origin, spec.full_x = spec.full_y = origin;
  spec.full_width = 4, spec.full_height = 3;
  spec.tile_width = spec.tile_height = tile;
  std::vector<float> values;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) values.push_back(float(x + 10 * y));
  auto out = OIIO::ImageOutput::create(file.string());
  EXPECT_TRUE(out && out->open(file.string(), spec) && out->write_image(OIIO::TypeDesc::FLOAT, values.data()) &&
              out->close());
  return file;
}

TEST_F(ImageTest, TheDisplayWindowOfAnExrIsThePicture) {
  const int windows[][4] = {{0, 0, 4, 3}, {-2, -1, 7, 5}, {1, 1, 3, 2}, {-1, 2, 2, 9}, {3, -4, 5, 1}, {9, 9, 12, 11}};
  for (const auto& w : windows)
    for (const auto& [tile, origin] : {std::pair(0, 0), std::pair(16, 0), std::pair(0, 100), std::pair(0, -7)}) {
      const Image image = image_read(write_window(folder_ / "a.exr", w[0], w[1], w[2], w[3], tile, origin));
      ASSERT_EQ(image.width, 4);
      ASSERT_EQ(image.height, 3);
      for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 4; ++x) {
          const bool stored = x >= w[0] && x < w[2] && y >= w[1] && y < w[3];
          EXPECT_EQ(image.values[std::size_t(y * 4 + x)], stored ? float(x + 10 * y) : 0.0f)
              << w[0] << " " << w[1] << " " << tile << " " << origin << ": " << x << " " << y;
        }
    }
}

// As image editors write the place of a layer on its canvas.
TEST_F(ImageTest, OtherFormatsAreTheirPixels) {
  for (const char* name : {"a.png", "a.tif"}) {
    OIIO::ImageSpec spec(2, 1, 1, OIIO::TypeDesc::UINT8);
    spec.x = spec.y = 5;
    spec.full_width = spec.full_height = 20;
    spec.attribute("XResolution", 1.0f);
    spec.attribute("YResolution", 1.0f);
    const unsigned char values[] = {255, 0};
    auto out = OIIO::ImageOutput::create((folder_ / name).string());
    ASSERT_TRUE(out && out->open((folder_ / name).string(), spec) && out->write_image(OIIO::TypeDesc::UINT8, values) &&
                out->close());
    const Image image = image_read(folder_ / name);
    EXPECT_EQ(image.width, 2) << name;
    EXPECT_EQ(image.values, (std::vector<float>{1, 0})) << name;
  }
}

TEST(ImageData, NanInfAndNegativeTexelsAreCleanedAndCounted) {
  const fs::path file = data_path("textures/BrightRingsNanInf.exr");
  NEED_DATA(file);
  std::size_t bad = 0;
  const Image stored = image_read(file);
  ASSERT_EQ(stored.channels, 3);
  for (std::size_t i = 0; i < stored.values.size(); i += 3) {
    const auto is_bad = [](float value) { return !(std::isfinite(value) && value >= 0); };
    bad += std::any_of(&stored.values[i], &stored.values[i] + 3, is_bad);
  }
  const Image texture = image_read_texture(file);
  EXPECT_GT(bad, 0u);
  EXPECT_EQ(texture.cleaned, bad);
  for (float value : texture.values) ASSERT_TRUE(std::isfinite(value) && value >= 0);
}

TEST_F(ImageTest, CleanedTexelsAreCountedAndNotTheirChannels) {
  const float inf = INFINITY;
  const fs::path file =
      write<float>("a.exr", 2, 3, OIIO::TypeDesc::FLOAT, {1, inf, -inf, 1, 2, 3, -1, NAN, inf, 0, -1, 0});
  const Image texture = image_read_texture(file);
  EXPECT_EQ(texture.cleaned, 3u);
  EXPECT_EQ(texture.values, (std::vector<float>{1, 0, 0, 1, 2, 3, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(image_read_texture(write<float>("b.exr", 1, 1, OIIO::TypeDesc::FLOAT, {inf})).cleaned, 1u);
}

TEST(ImageData, FloatsAreLinearAndUntouched) {
  const fs::path file = data_path("textures/GammaChart.exr");
  NEED_DATA(file);
  auto in = OIIO::ImageInput::open(file.string());
  std::vector<float> expected(800 * 800 * 3);
  ASSERT_TRUE(in && in->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, expected.data()));
  EXPECT_EQ(image_read_texture(file).values, expected);
}

TEST(ImageData, OneChannelOfExtremeFloatsBecomesGrey) {
  const fs::path file = data_path("textures/WideFloatRange.exr");
  NEED_DATA(file);
  const Image raw = image_read(file), texture = image_read_texture(file);
  ASSERT_EQ(raw.channels, 1);
  EXPECT_GT(*std::max_element(raw.values.begin(), raw.values.end()), 1e37f);
  for (std::size_t i = 0; i < texture.values.size(); ++i)
    ASSERT_EQ(texture.values[i], std::max(raw.values[i / 3], 0.0f));
}

TEST(ImageData, JpegIsDecoded) {
  const fs::path file = data_path("textures/earthmap.jpg");
  NEED_DATA(file);
  const Image texture = image_read_texture(file), raw = image_read(file);
  EXPECT_EQ(texture.width, 1024);
  EXPECT_EQ(texture.height, 512);
  EXPECT_EQ(raw.channel_names, (std::vector<std::string>{"R", "G", "B"}));
  for (std::size_t i = 0; i < raw.values.size(); i += 1001)
    ASSERT_NEAR(texture.values[i], srgb_decode(raw.values[i]), 1e-6);
  EXPECT_EQ(texture.cleaned, 0u);
}

}  // namespace
}  // namespace brume::test
