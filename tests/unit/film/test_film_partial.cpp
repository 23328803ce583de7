// Pictures in part: which samples there are, files that keep them bit for bit, files that do not.
#include <cmath>
#include <cstring>
#include <limits>

#include "cli/render_part.hpp"
#include "film/film_partial.hpp"
#include "film/film_write.hpp"
#include "unit/image/image_fixture.hpp"

namespace brume::test {
namespace {

using Ranges = std::vector<SampleRange>;

TEST(SampleCover, JoinsWhatMeetsAndKeepsGaps) {
  SampleCover cover(3);
  EXPECT_EQ(cover.of(1), Ranges{});
  cover.add(1, {8, 2});
  cover.add(1, {0, 3});
  EXPECT_EQ(cover.of(1), (Ranges{{0, 3}, {8, 2}}));
  EXPECT_EQ(cover.layers().size(), 2u);
  EXPECT_EQ(cover.missing(1, {0, 12}), (Ranges{{3, 5}, {10, 2}}));
  EXPECT_EQ(cover.missing(1, {2, 3}), (Ranges{{3, 2}}));
  EXPECT_EQ(cover.missing(1, {8, 2}), Ranges{});
  EXPECT_EQ(cover.missing(0, {4, 2}), (Ranges{{4, 2}}));
  EXPECT_EQ(cover.held(1, {3, 5}), std::nullopt);
  EXPECT_EQ(cover.held(1, {3, 6}), 8u);
  EXPECT_EQ(cover.held(1, {1, 1}), 1u);
  cover.add(1, {3, 5});
  EXPECT_EQ(cover.of(1), (Ranges{{0, 10}}));
  cover.add(2, {5, 0});
  EXPECT_EQ(cover.of(2), Ranges{});
}

TEST(SampleCover, WindowIsTheSmallestAboutAllPixelsWithSamples) {
  SampleCover cover(20);  // 5 x 4
  EXPECT_EQ(cover.window(5).width(), 0);
  cover.add(8, {0, 1});
  cover.add(11, {0, 1});
  const ImageWindow window = cover.window(5);
  EXPECT_EQ(std::vector<int>({window.x0, window.y0, window.x1, window.y1}), std::vector<int>({1, 1, 4, 3}));
}

TEST(RenderPart, SamplesAreTwoNumbersWithinThePicture) {
  EXPECT_EQ(samples_parse("", 8), (SampleRange{0, 8}));
  EXPECT_EQ(samples_parse("0-7", 8), (SampleRange{0, 8}));
  EXPECT_EQ(samples_parse("5-5", 8), (SampleRange{5, 1}));
  for (const char* text : {"3", "4-3", "-1-2", "0-8", "1-2x", "a-b", "1--2", "99999999999-99999999999", "1-", " 1-2"})
    EXPECT_THROW(samples_parse(text, 8), InputError) << text;
}

// 4 x 1 pixels of 8 samples: nothing, all, a gap in the middle, two gaps.
TEST(RenderPart, WorkIsWhatIsMissingAndTheCoverWhatWasDoneOfIt) {
  Frame frame{};
  frame.camera.width = 4, frame.camera.height = 1, frame.camera.spp = 8;
  frame.crop_x1 = 4, frame.crop_y1 = 1;
  SampleCover held(4);
  held.add(1, {0, 8});
  held.add(2, {0, 2});
  held.add(2, {5, 3});
  held.add(3, {2, 2});
  const WorkList work = work_missing(frame, {0, 8}, held);
  ASSERT_EQ(work.size(), 4u);
  EXPECT_EQ(work[0].samples, 8u);
  EXPECT_EQ(work[1].first_sample, 2u);
  EXPECT_EQ(work[3].first_sample, 4u);
  EXPECT_EQ(work[3].samples, 4u);
  Film film({4, 1});  // stopped within the last gap of the last pixel
  const float samples[] = {6, 8, 8, 5};
  for (std::size_t i = 0; i < 4; ++i) film.pixels()[i].samples = samples[i];
  film.pixels()[0].invalid = 2;
  const SampleCover cover = cover_after(held, work, film);
  EXPECT_EQ(cover.of(0), (Ranges{{0, 8}}));
  EXPECT_EQ(cover.of(1), (Ranges{{0, 8}}));
  EXPECT_EQ(cover.of(2), (Ranges{{0, 8}}));
  EXPECT_EQ(cover.of(3), (Ranges{{0, 5}}));
}

class FilmPartial : public ImageTest {
 protected:
  // 3 x 2 pixels of 16 samples: the first one empty, the last one with a gap; every word of every other pixel of its
  // own.
  FilmPartial() {
    for (std::size_t i = 1; i < 6; ++i) {
      float words[sizeof(FilmPixel) / sizeof(float)];
      for (std::size_t w = 0; w < std::size(words); ++w) words[w] = std::ldexp(1.0f + float(w), int(i) * 20 - 60);
      FilmPixel& pixel = film_.pixels()[i];
      std::memcpy(&pixel, words, sizeof pixel);
      pixel.samples = float(i);
      pixel.invalid = 1;
      pixel.key = 0xfedcba98u + std::uint32_t(i);
      cover_.add(i, {std::uint32_t(i), std::uint32_t(i) - (i == 5 ? 2u : 0u)});
      cover_.add(i, {i == 5 ? 12u : std::uint32_t(2 * i), i == 5 ? 3u : 1u});
    }
    film_.pixels()[2].key = 0xffffffffu;
    film_.pixels()[3].squares.y = std::numeric_limits<float>::infinity();
    film_.pixels()[4].clear = std::numeric_limits<float>::denorm_min();
  }
  fs::path write_part(const std::string& name) {
    FilmWriteOptions options;
    options.metadata = metadata_;
    options.cover = &cover_;
    options.window = cover_.window(3);
    film_write(film_, folder_ / name, options);
    return folder_ / name;
  }
  std::string refusal(const fs::path& file) {
    return message_of<InputError>([&] { film_part_read(file); });
  }
  // The file with one channel left out or one of its values changed.
  std::string refusal_with(const std::string& channel, std::size_t pixel, float value, bool leave_out = false) {
    const PartChannels part(film_, cover_);
    std::vector<ImageChannel> channels;
    std::vector<float> changed;
    for (const ImageChannel& one : part.channels) {
      if (one.name != channel) {
        channels.push_back(one);
      } else if (!leave_out) {
        for (std::size_t i = 0; i < 6; ++i) changed.push_back(i == pixel ? value : one.values[i * one.stride]);
        channels.push_back({channel, changed.data()});
      }
    }
    ImageMetadata metadata;
    for (const auto& [key, text] : metadata_) metadata.emplace_back("brume:" + key, text);
    image_write_exr(folder_ / "changed.exr", 3, 2, channels, metadata);
    return refusal(folder_ / "changed.exr");
  }

  Film film_{{3, 2}};
  SampleCover cover_{6};
  ImageMetadata metadata_{{"version", "1"}, {"size", "3x2"}, {"spp", "16"}, {"seed", "7"}, {"scene_hash", "ab"}};
};

TEST_F(FilmPartial, ComesBackBitForBit) {
  const FilmPart part = film_part_read(write_part("a.exr"));
  EXPECT_EQ(part.spp, 16);
  EXPECT_EQ(part.value("scene_hash"), "ab");
  EXPECT_EQ(part.value("nothing"), "");
  EXPECT_EQ(std::memcmp(part.film.pixels().data(), film_.pixels().data(), 6 * sizeof(FilmPixel)), 0);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(part.cover.of(i), cover_.of(i)) << i;
  EXPECT_EQ(part.cover.of(5), (Ranges{{5, 3}, {12, 3}}));
  EXPECT_EQ(part.cover.of(4), (Ranges{{4, 5}}));
}

TEST_F(FilmPartial, WhatIsNoneIsRefusedByName) {
  image_write_exr(folder_ / "plain.exr", 1, 1, {{"R", &film_.pixels()[1].radiance.x}}, {});
  const std::string plain = refusal(folder_ / "plain.exr");
  EXPECT_THAT(plain, HasSubstr("plain.exr: is no partial picture to go on from: it has no attribute 'brume:version'"));
  EXPECT_EQ(refusal_with("", 0, 0), "nothing was thrown");
  EXPECT_THAT(refusal_with("brume.hits", 0, 0, true), HasSubstr("it has no channel 'brume.hits'"));
  EXPECT_THAT(refusal_with("brume.cover.1.count", 0, 0, true), HasSubstr("no channel 'brume.cover.1.count'"));
  EXPECT_THAT(refusal_with("brume.key.low", 4, 65536), HasSubstr("damaged: 'brume.key.low' of pixel 1,1 is 65536"));
  EXPECT_THAT(refusal_with("brume.cover.0.first", 4, NAN), HasSubstr("damaged: 'brume.cover.0.first' of pixel 1,1"));
  EXPECT_THAT(refusal_with("brume.cover.0.count", 4, 1.5f), HasSubstr("not a whole number"));
  EXPECT_THAT(refusal_with("brume.cover.0.first", 4, 14), HasSubstr("holds samples 14-18 twice or beyond the 16"));
  EXPECT_THAT(refusal_with("brume.cover.1.first", 5, 6), HasSubstr("pixel 2,1 holds samples 6-8 twice"));
  EXPECT_THAT(refusal_with("brume.cover.0.count", 4, 4), HasSubstr("pixel 1,1 holds 4"));
  metadata_[1].second = "4x2";
  EXPECT_THAT(refusal_with("", 0, 0), HasSubstr("brume:size is '4x2', the picture 3x2"));
  metadata_[1].second = "3x2", metadata_[2].second = "many";
  EXPECT_THAT(refusal_with("", 0, 0), HasSubstr("brume:spp is 'many'"));
}

// Cut off anywhere.
TEST_F(FilmPartial, DamagedFilesAreRefused) {
  const fs::path file = write_part("a.exr");
  std::ostringstream all;
  all << std::ifstream(file, std::ios::binary).rdbuf();
  const std::string whole = all.str();
  for (int i = 1; i < 16; ++i) {
    const std::size_t size = whole.size() * std::size_t(i) / 16;
    std::ofstream(folder_ / "cut.exr", std::ios::binary) << whole.substr(0, size);
    EXPECT_THAT(refusal(folder_ / "cut.exr"), HasSubstr("cut.exr: ")) << size;
  }
}

TEST_F(FilmPartial, PartsOfOtherPicturesAreRefusedByKeyAndValues) {
  const FilmPart part = film_part_read(write_part("a.exr"));
  film_parts_match("b.exr", metadata_, part);
  for (auto& [key, value] : metadata_) {
    const std::string own = std::exchange(value, "other");
    EXPECT_THAT(message_of<InputError>([&] { film_parts_match("b.exr", metadata_, part); }),
                HasSubstr("a.exr: is no part of the picture of b.exr: brume:" + key + " is " + own + " and not other"));
    value = own;
  }
}

TEST(FilmPartialSize, IsThatOfAFileThatCanBeRead) {
  EXPECT_EQ(part_size_problem({3840, 2160}, 3, 2), "");
  EXPECT_THAT(part_size_problem({3840, 2160}, 9), HasSubstr("1024 MB are read"));
}

}  // namespace
}  // namespace brume::test
