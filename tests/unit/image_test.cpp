// Pictures: files whole or not at all, tone curve, text.
// SPDX-License-Identifier: Apache-2.0
#include "image/image.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>

#include "error.h"
#include "temporary_folder.h"
#include "unit/this_system.h"

namespace lamp::app {
namespace {

namespace fs = std::filesystem;

/// An empty folder of this test, gone with it.
class ImageFile : public testing::Test {
 protected:
  [[nodiscard]] fs::path path(const std::string& name) const { return folder_.path() / name; }
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()));
  }

 private:
  TemporaryFolder folder_;
};

std::string content(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The line of the Error that `call` throws; empty if it throws none.
template <class Call>
std::string error_line(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

LdrImage random_picture(std::uint32_t width, std::uint32_t height) {
  std::mt19937 random(7);
  LdrImage image{width, height, std::vector<glm::u8vec4>(std::size_t{width} * height)};
  for (glm::u8vec4& pixel : image.pixels) pixel = {random() & 255, random() & 255, random() & 255, random() & 255};
  return image;
}

LdrImage blank(std::uint32_t width, std::uint32_t height, glm::u8vec4 color) {
  return {width, height, std::vector<glm::u8vec4>(std::size_t{width} * height, color)};
}

HdrImage grey(const std::vector<float>& values) {
  HdrImage image{static_cast<std::uint32_t>(values.size()), 1, {}};
  for (const float value : values) image.pixels.emplace_back(value, value, value, 1.0F);
  return image;
}

TEST_F(ImageFile, PngRoundTrip) {
  for (const glm::uvec2 size : {glm::uvec2(1, 1), glm::uvec2(7, 3), glm::uvec2(256, 129)}) {
    const LdrImage image = random_picture(size.x, size.y);
    write_png(path("a.png"), image);
    const LdrImage back = read_png(path("a.png"));
    EXPECT_EQ(back.width, size.x);
    EXPECT_EQ(back.height, size.y);
    EXPECT_EQ(back.pixels, image.pixels);
  }
  EXPECT_EQ(files(), 1U);
}

TEST_F(ImageFile, ExrStoresFloatsBitForBit) {
  constexpr std::uint32_t WIDTH = 5;
  constexpr std::uint32_t HEIGHT = 3;
  HdrImage image{WIDTH, HEIGHT, {}};
  for (std::uint32_t i = 0; i < WIDTH * HEIGHT; ++i) {
    const auto x = static_cast<float>(i);
    image.pixels.emplace_back(1.0F / (x + 3.0F), -x, x * 1.0e30F, 99.0F);
  }
  image.pixels[4].r = std::numeric_limits<float>::infinity();
  write_exr(path("a.exr"), image);
  EXPECT_EQ(files(), 1U);

  Imf::InputFile input(path("a.exr").string().c_str());
  const Imath::Box2i window = input.header().dataWindow();
  ASSERT_EQ(window.max.x + 1, static_cast<int>(WIDTH));
  ASSERT_EQ(window.max.y + 1, static_cast<int>(HEIGHT));
  EXPECT_EQ(input.header().channels().findChannel("A"), nullptr);
  int component = 0;
  for (const char* channel : {"R", "G", "B"}) {
    const Imf::Channel* found = input.header().channels().findChannel(channel);
    ASSERT_NE(found, nullptr) << channel;
    EXPECT_EQ(found->type, Imf::FLOAT) << channel;
    std::vector<float> values(std::size_t{WIDTH} * HEIGHT);
    Imf::FrameBuffer pixels;
    pixels.insert(channel,
                  Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), sizeof(float), sizeof(float) * WIDTH));
    input.setFrameBuffer(pixels);
    input.readPixels(0, static_cast<int>(HEIGHT) - 1);
    for (std::size_t i = 0; i < values.size(); ++i) {
      EXPECT_EQ(values[i], image.pixels[i][component]) << channel << " of pixel " << i;
    }
    ++component;
  }
}

TEST_F(ImageFile, TextIsReplacedWholeAndThroughALink) {
  if (!test::has_links()) GTEST_SKIP() << test::NO_LINKS;
  write_text(path("a.json"), "first, and longer");
  write_text(path("a.json"), "second");
  EXPECT_EQ(content(path("a.json")), "second");
  fs::create_symlink(path("a.json"), path("link"));
  write_text(path("link"), "third");
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(content(path("a.json")), "third");
  EXPECT_EQ(files(), 2U);
}

TEST_F(ImageFile, ErrorsNameTheFileAndLeaveNothing) {
  const LdrImage image = random_picture(4, 4);
  const HdrImage hdr = grey({0.5F, 1.0F});
  const fs::path missing = path("missing/a.png");
  EXPECT_EQ(error_line([&] { write_png(missing, image); }).find(missing.string() + ": "), 0U);
  EXPECT_FALSE(fs::exists(path("missing")));

  write_text(path("file"), "not a folder");
  const fs::path below = path("file/a.exr");
  EXPECT_EQ(error_line([&] { write_exr(below, hdr); }).find(below.string() + ": "), 0U);
  EXPECT_EQ(content(path("file")), "not a folder");
  EXPECT_EQ(files(), 1U);

  fs::create_directory(path("folder"));
  EXPECT_NE(error_line([&] { write_text(path("folder"), "x"); }).find("is a folder"), std::string::npos);
  EXPECT_TRUE(fs::is_empty(path("folder")));
  EXPECT_EQ(files(), 2U);
}

TEST_F(ImageFile, AFullDiskIsAnErrorAndKeepsTheOldFile) {
  if (fs::exists("/dev/full")) {
    EXPECT_NE(error_line([] { write_text("/dev/full", "x"); }).find("/dev/full: "), std::string::npos);
  }
  write_text(path("a.txt"), "old");
  if (!test::FileSizeLimit::is_there()) GTEST_SKIP() << "no limit for sizes of files here";
  std::string line;
  {
    const test::FileSizeLimit full(4096);
    line = error_line([&] { write_text(path("a.txt"), std::string(100000, 'x')); });
  }
  EXPECT_EQ(line.find(path("a.txt").string() + ": "), 0U) << line;
  EXPECT_EQ(content(path("a.txt")), "old");
  EXPECT_EQ(files(), 1U);
}

TEST_F(ImageFile, PicturesThatCannotBeAreErrors) {
  EXPECT_NE(error_line([&] { write_png(path("a.png"), LdrImage{}); }).find("0 x 0"), std::string::npos);
  EXPECT_NE(error_line([&] { write_exr(path("a.exr"), HdrImage{}); }).find("0 x 0"), std::string::npos);
  EXPECT_EQ(files(), 0U);
  EXPECT_NE(error_line([&] { (void)read_png(path("a.png")); }).find("a.png"), std::string::npos);
  write_png(path("b.png"), random_picture(16, 16));
  const std::string whole = content(path("b.png"));
  for (const std::size_t bytes : {std::size_t{0}, std::size_t{8}, std::size_t{40}, whole.size() / 2}) {
    write_text(path("cut.png"), whole.substr(0, bytes));
    EXPECT_NE(error_line([&] { (void)read_png(path("cut.png")); }).find("cut.png"), std::string::npos) << bytes;
  }
}

TEST(ToneMap, CurveIsMonotoneFromBlackToWhite) {
  std::vector<float> values{0.0F};
  for (float value = 1.0e-4F; value < 100.0F; value *= 1.01F) values.push_back(value);
  const LdrImage mapped = tone_map(grey(values), 1.0F);
  EXPECT_EQ(mapped.pixels.front(), glm::u8vec4(0, 0, 0, 255));
  EXPECT_EQ(mapped.pixels.back(), glm::u8vec4(255, 255, 255, 255));
  for (std::size_t i = 1; i < mapped.pixels.size(); ++i) {
    ASSERT_GE(mapped.pixels[i].r, mapped.pixels[i - 1].r) << values[i];
    ASSERT_LE(mapped.pixels[i].r - mapped.pixels[i - 1].r, 3) << values[i];
  }
}

TEST(ToneMap, MiddleGreyStaysAndExposureMultiplies) {
  EXPECT_NEAR(tone_map(grey({0.18F}), 1.0F).pixels[0].r, 118, 1);  // sRGB of 0.18
  const LdrImage once = tone_map(grey({0.5F}), 1.0F);
  EXPECT_EQ(tone_map(grey({0.125F}), 4.0F).pixels, once.pixels);
}

TEST(ToneMap, ChannelsAreIndependentAndOddNumbersAreSeen) {
  constexpr float INF = std::numeric_limits<float>::infinity();
  constexpr float NOT_A_NUMBER = std::numeric_limits<float>::quiet_NaN();
  const HdrImage image{
      3, 1, {{0.18F, 0.0F, INF, 0.0F}, {-1.0F, 0.18F, 1.0e30F, 0.0F}, {NOT_A_NUMBER, 0.0F, 0.0F, 1.0F}}};
  const LdrImage mapped = tone_map(image, 1.0F);
  EXPECT_EQ(mapped.pixels[0], glm::u8vec4(mapped.pixels[1].g, 0, 255, 255));
  EXPECT_EQ(mapped.pixels[1].r, 0);
  EXPECT_EQ(mapped.pixels[1].b, 255);
  EXPECT_EQ(mapped.pixels[2], glm::u8vec4(255, 0, 255, 255));
}

TEST(AutomaticExposure, IsOfSurfacesAlone) {
  constexpr float SKY = 0.0F;
  const HdrImage before_a_sky{4, 1, {{0.36F, 0.36F, 0.36F, 1.0F}, {1e-3F, 1e-3F, 1e-3F, SKY}, {9, 9, 9, SKY}, {}}};
  EXPECT_NEAR(automatic_exposure(before_a_sky), 0.5F, 1e-6F);
  const HdrImage nothing_but_sky{2, 1, {{0.5F, 0.5F, 0.5F, SKY}, {0.1F, 0.1F, 0.1F, SKY}}};
  EXPECT_EQ(automatic_exposure(nothing_but_sky), 1.0F);
  // A pixel that is covered by half counts as half a pixel.
  const HdrImage edge{2, 1, {{1.0F, 1.0F, 1.0F, 1.0F}, {8.0F, 8.0F, 8.0F, 0.5F}}};
  EXPECT_NEAR(automatic_exposure(edge), 0.18F / 2.0F, 1e-6F);
}

TEST(AutomaticExposure, KnownAnswers) {
  EXPECT_EQ(automatic_exposure(HdrImage{}), 1.0F);
  EXPECT_EQ(automatic_exposure(grey({0.0F, 0.0F})), 1.0F);
  EXPECT_NEAR(automatic_exposure(grey({0.18F, 0.18F})), 1.0F, 1e-6F);
  EXPECT_NEAR(automatic_exposure(grey({0.36F, 0.0F})), 0.5F, 1e-6F);
  EXPECT_NEAR(automatic_exposure(grey({0.1F, 10.0F})), 0.18F, 1e-6F);  // the geometric mean is 1
  EXPECT_NEAR(automatic_exposure(grey({0.18F, std::numeric_limits<float>::infinity()})), 1.0F, 1e-6F);
  const HdrImage green{1, 1, {{0.0F, 1.0F, 0.0F, 1.0F}}};
  EXPECT_NEAR(automatic_exposure(green), 0.18F / 0.7152F, 1e-5F);
}

/// Bounds of the pixels that differ from black, as (left, top, right, bottom), right and bottom past the end.
glm::uvec4 drawn_extent(const LdrImage& image) {
  glm::uvec4 box(image.width, image.height, 0, 0);
  for (std::uint32_t y = 0; y < image.height; ++y) {
    for (std::uint32_t x = 0; x < image.width; ++x) {
      if (image.pixels[std::size_t{y} * image.width + x].r == 0) continue;
      box = {std::min(box.x, x), std::min(box.y, y), std::max(box.z, x + 1), std::max(box.w, y + 1)};
    }
  }
  return box;
}

TEST(Text, SizeIsTheDrawnExtent) {
  for (const std::uint32_t scale : {1U, 2U, 5U}) {
    for (const std::string_view text : {"Hg", "H lights jg", "H\nlonger line\nMgM", "M\n\ngM"}) {
      LdrImage image = blank(600, 400, {0, 0, 0, 255});
      draw_text(image, 11, 7, text, {255, 255, 255}, scale);
      const glm::uvec2 size = text_size(text, scale);
      EXPECT_EQ(drawn_extent(image), glm::uvec4(11, 7, 11 + size.x, 7 + size.y)) << text << " at " << scale;
    }
  }
  EXPECT_EQ(text_size("", 3), glm::uvec2(0, 0));
}

TEST(Text, LettersDifferAndUnknownOnesAreQuestionMarks) {
  const auto drawn = [](const std::string& text) {
    LdrImage image = blank(8, 10, {0, 0, 0, 255});
    draw_text(image, 0, 0, text, {255, 255, 255});
    return image.pixels;
  };
  for (char a = ' '; a < '~'; ++a) {
    for (char b = static_cast<char>(a + 1); b <= '~'; ++b) EXPECT_NE(drawn({a}), drawn({b})) << a << " " << b;
  }
  EXPECT_EQ(drawn("\x01"), drawn("?"));
  EXPECT_EQ(drawn("\xC3"), drawn("?"));
}

TEST(Text, IsClippedToThePicture) {
  LdrImage image = blank(20, 8, {0, 0, 0, 255});
  draw_text(image, -5, -2, "WWWWWWWWWWWW", {255, 0, 0}, 2);
  draw_text(image, 1000000, 5, "W", {255, 0, 0});
  EXPECT_EQ(image.pixels.size(), 160U);
  EXPECT_EQ(drawn_extent(image).z, 20U);
}

TEST(FillRect, Clips) {
  constexpr std::int32_t FAR = std::numeric_limits<std::int32_t>::max();
  LdrImage image = blank(3, 2, {100, 100, 100, 255});
  fill_rect(image, {1, 1}, {FAR, FAR}, {200, 0, 100});
  EXPECT_EQ(image.pixels[3], glm::u8vec4(100, 100, 100, 255));
  EXPECT_EQ(image.pixels[4], glm::u8vec4(200, 0, 100, 255));
  EXPECT_EQ(image.pixels[5], glm::u8vec4(200, 0, 100, 255));
  fill_rect(image, {-FAR, -5}, {FAR, 6}, {1, 2, 3});
  fill_rect(image, {0, 0}, {-2, 2}, {1, 2, 3});
  EXPECT_EQ(image.pixels[0], glm::u8vec4(100, 100, 100, 255));
  fill_rect(image, {-1, 0}, {2, 1}, {1, 2, 3});
  EXPECT_EQ(image.pixels[0], glm::u8vec4(1, 2, 3, 255));
  EXPECT_EQ(image.pixels[1], glm::u8vec4(100, 100, 100, 255));
}

TEST(SideBySide, KeepsEveryPixel) {
  const std::vector<LdrImage> images{blank(3, 2, {10, 0, 0, 255}), blank(2, 4, {0, 20, 0, 255})};
  const LdrImage all = side_by_side(images);
  EXPECT_GT(all.width, 5U);
  EXPECT_EQ(all.height, 4U);
  ASSERT_EQ(all.pixels.size(), std::size_t{all.width} * all.height);
  EXPECT_EQ(std::count(all.pixels.begin(), all.pixels.end(), glm::u8vec4(10, 0, 0, 255)), 6);
  EXPECT_EQ(std::count(all.pixels.begin(), all.pixels.end(), glm::u8vec4(0, 20, 0, 255)), 8);
  EXPECT_EQ(all.pixels.front(), glm::u8vec4(10, 0, 0, 255));
  EXPECT_EQ(all.pixels.back(), glm::u8vec4(0, 20, 0, 255));
}

TEST(Stacked, KeepsEveryPixel) {
  const std::vector<LdrImage> images{blank(3, 2, {10, 0, 0, 255}), blank(2, 4, {0, 20, 0, 255})};
  const LdrImage all = stacked(images);
  EXPECT_EQ(all.width, 3U);
  EXPECT_EQ(all.height, 6U);
  ASSERT_EQ(all.pixels.size(), 18U);
  EXPECT_EQ(std::count(all.pixels.begin(), all.pixels.end(), glm::u8vec4(10, 0, 0, 255)), 6);
  EXPECT_EQ(std::count(all.pixels.begin(), all.pixels.end(), glm::u8vec4(0, 20, 0, 255)), 8);
  EXPECT_EQ(all.pixels.front(), glm::u8vec4(10, 0, 0, 255));
  EXPECT_EQ(all.pixels[6], glm::u8vec4(0, 20, 0, 255));
}

}  // namespace
}  // namespace lamp::app
