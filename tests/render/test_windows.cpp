// Pictures in part: --crop, --trim and --alpha, as files hold them.
#include <array>
#include <cmath>
#include <cstring>

#include "image/image.hpp"
#include "program.hpp"

namespace brume::test {
namespace {

// A slab of tau = 2 in front of the background on the left, nothing at all on the right, and between them a sphere that
// mirrors.
constexpr const char* SCENE = R"({"film": {"size": [8, 4]}, "background": [0.5, 0.25, 0.125],
  "camera": {"type": "orthographic", "eye": [0, 0, 5], "target": [0, 0, 0], "height": 4},
  "materials": {"mirror": {"diffuse": 0, "specular": 0, "reflection": 1}},
  "shapes": [{"type": "sphere", "center": [0.5, 0.5, -3], "radius": 0.4, "material": "mirror"}],
  "media": [{"bounds": [[-4, -2, -1], [-1, 2, 1]], "density": {"type": "constant"}, "sigma_a": 1}]})";

class Windows : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("a.json", SCENE);
  }
  Image render(const std::string& options, const std::string& file) const {
    const Outcome r = run("render a.json --quiet -o " + file + " " + options);
    EXPECT_EQ(r.exit_code, 0) << r.err;
    return image_read(folder_ / file);
  }
  // "dataWindow" or "displayWindow" of an OpenEXR file: x0, y0, x1, y1, all inclusive.
  std::array<int, 4> window(const std::string& file, const std::string& name) const {
    const std::string head = text(folder_ / file), key = name + '\0' + "box2i" + '\0';
    std::array<int, 4> box{};
    const std::size_t at = head.find(key);
    EXPECT_NE(at, std::string::npos);
    if (at != std::string::npos) std::memcpy(box.data(), &head[at + key.size() + 4], sizeof box);
    return box;
  }
  static float value(const Image& image, int x, int y, const std::string& channel) {
    const int c = image_channel(image, channel);
    EXPECT_GE(c, 0) << channel;
    return image.values[std::size_t((y * image.width + x) * image.channels + std::max(c, 0))];
  }
};

TEST_F(Windows, ACropIsADataWindow) {
  const Image whole = render("--aov transmittance", "whole.exr");
  const Image crop = render("--aov transmittance --crop 1,1,5,3", "crop.exr");
  EXPECT_EQ(window("whole.exr", "dataWindow"), (std::array<int, 4>{0, 0, 7, 3}));
  EXPECT_EQ(window("crop.exr", "dataWindow"), (std::array<int, 4>{1, 1, 4, 2}));
  EXPECT_EQ(window("crop.exr", "displayWindow"), (std::array<int, 4>{0, 0, 7, 3}));
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 8; ++x)
      for (const std::string& channel : whole.channel_names)
        EXPECT_EQ(value(crop, x, y, channel), x >= 1 && x < 5 && y >= 1 && y < 3 ? value(whole, x, y, channel) : 0.0f);
  EXPECT_EQ(render("--crop 1,1,5,3", "crop.png").width, 8);
}

TEST_F(Windows, TrimmedItIsTheWholePicture) {
  const Image whole = render("", "whole.exr");
  for (const std::string file : {"trim.exr", "trim.png", "trim.jpg"}) {
    const Image trim = render("--crop 1,1,5,3 --trim", file);
    EXPECT_EQ(trim.width, 4);
    EXPECT_EQ(trim.height, 2);
    for (int i = 0; i < 8 && file == "trim.exr"; ++i)
      EXPECT_EQ(value(trim, i % 4, i / 4, "G"), value(whole, 1 + i % 4, 1 + i / 4, "G"));
  }
  EXPECT_EQ(window("trim.exr", "displayWindow"), (std::array<int, 4>{0, 0, 3, 1}));
  expect_refused("render a.json -o b.png --trim", 2, "--trim: expected together with --crop");
}

// Alpha 1 - exp(-2) in the slab, 1 on the sphere, 0 beside them; the sphere goes on mirroring the background that the
// camera does not see.
TEST_F(Windows, AlphaIsWhatHidesTheBackground) {
  for (const std::string lanes : {"", "--spp 4", "--generic --lanes 4"}) {
    const Image image = render("--alpha " + lanes, "a.exr");
    ASSERT_EQ(image.channel_names, (std::vector<std::string>{"R", "G", "B", "A"}));
    const float slab = 1 - std::exp(-2.0f);
    EXPECT_NEAR(value(image, 1, 1, "A"), slab, 1e-5);
    EXPECT_NEAR(value(image, 1, 1, "R"), 0, 1e-6);
    EXPECT_EQ(value(image, 7, 1, "A"), 0);
    EXPECT_EQ(value(image, 7, 1, "R"), 0);
  }
  const Image image = render("--alpha", "a.exr"), seen = render("", "b.exr");
  EXPECT_EQ(value(image, 4, 1, "A"), 1);
  for (const char* channel : {"R", "G", "B"}) {
    EXPECT_EQ(value(image, 4, 1, channel), value(seen, 4, 1, channel));
    EXPECT_GT(value(image, 4, 1, channel), 0.1f);
    EXPECT_NEAR(value(seen, 1, 1, channel), std::exp(-2.0f) * value(seen, 7, 1, channel), 1e-6);
  }
  const Image png = render("--alpha", "a.png");
  ASSERT_EQ(png.channels, 4);
  EXPECT_NEAR(value(png, 1, 1, "A"), 1 - std::exp(-2.0), 0.5 / 255 + 1e-6);
  EXPECT_NEAR(value(png, 4, 1, "R"), std::pow(value(seen, 4, 1, "R"), 1 / 2.2), 0.5 / 255 + 1e-6);
  EXPECT_EQ(render("--alpha", "a.jpg").channels, 3);
}

// A grey haze that scatters: what lies before a background B is C + (1 - A) B, in both kinds of files.
TEST_F(Windows, OverTheBackgroundItIsThePictureWithIt) {
  const std::string lit =
      R"( --set /media/0/sigma_s=1 --set '/lights=[{"type": "directional", "direction": [0, 0, -1], "irradiance": 9}]')";
  const Image exr = render("--alpha" + lit, "a.exr"), png = render("--alpha" + lit, "a.png"),
              seen = render(lit, "b.exr");
  const double a = value(exr, 1, 1, "A");
  EXPECT_GT(value(exr, 1, 1, "R"), 0.1f);
  EXPECT_NEAR(value(exr, 1, 1, "R") + (1 - a) * 0.5, value(seen, 1, 1, "R"), 1e-5);
  EXPECT_NEAR(value(png, 1, 1, "R"), std::pow(value(exr, 1, 1, "R") / a, 1 / 2.2), 0.5 / 255 + 1e-5);
}

}  // namespace
}  // namespace brume::test
