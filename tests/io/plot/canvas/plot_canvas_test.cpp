#include "io/plot/canvas/plot_canvas.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>

namespace quadloop::io {
namespace {

constexpr double sheet_width = 900, sheet_height = 1300.4;

constexpr Box image_box{{96, 288}, {480, 1056}};  // in whole pixels at both scales

/// An image with a pixel for each one of the file.
Image image_at(double scale) {
  Image image{static_cast<int>(std::lround(scale * image_box.width())),
              static_cast<int>(std::lround(scale * image_box.height())),
              {}};
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(image.width * image.height); ++i)
    image.pixels.push_back(i % 7 == 0 ? 0 : 0xff000000U | (i / 50 * 2654435761U) >> 8U);
  return image;
}

std::string drawn(const Strips& strips, double scale) {
  Canvas canvas(strips);
  for (int i = 0; i < strips.count(); ++i) {
    canvas.clip({{20, 20}, {sheet_width - 20, sheet_height - 20}});
    canvas.add_polygon(std::array{Point{5, 10}, Point{700, 400.3}, Point{450, 1290}});
    canvas.fill_crisp({0.2, 0.6, 0.9});
    for (int k = 0; k < 40; ++k) canvas.add_line({10.0 + 20 * k, 5}, {880.5 - 21.3 * k, 1295});
    canvas.stroke({0.1, 0.1, 0.1}, 0.6, 1.3);
    canvas.paint(image_box, image_at(scale));
    canvas.unclip();
    canvas.text({450, 650}, "in the middle", TextAlign::centre);
    canvas.text_upwards({40, 600}, "along the side");
    if (i + 1 < strips.count()) canvas.next_strip();
  }
  return canvas.finish();
}

TEST(Canvas, ShowsTheSamePictureInStripsAndAsAWhole) {
  for (const double scale : {1.0, 300 / 144.0}) {
    const Strips strips(PlotFormat::png, sheet_width, sheet_height, scale);
    ASSERT_GT(strips.count(), 2);
    EXPECT_TRUE(drawn(strips, scale) ==
                drawn(Strips::one(PlotFormat::png, sheet_width, sheet_height, scale), scale));
  }
}

TEST(Canvas, StripsCoverTheSheetWithoutGaps) {
  const Strips strips(PlotFormat::png, sheet_width, sheet_height, 300 / 144.0);
  EXPECT_EQ(strips.part(0).low, (Point{0, 0}));
  for (int i = 1; i < strips.count(); ++i) {
    EXPECT_EQ(strips.part(i).low, (Point{0, strips.part(i - 1).high.y}));
    EXPECT_LT(strips.part(i).low.y, strips.part(i).high.y);
    EXPECT_EQ(strips.part(i).high.x, sheet_width);
  }
  EXPECT_NEAR(strips.part(strips.count() - 1).high.y, sheet_height, 0.5);
}

TEST(Canvas, ASheetWithoutPixelsIsOneStrip) {
  for (const PlotFormat format : {PlotFormat::svg, PlotFormat::pdf}) {
    const Strips strips(format, 5000, 5000, 1);
    EXPECT_EQ(strips.count(), 1);
    EXPECT_EQ(strips.part(0).high, (Point{5000, 5000}));
  }
}

TEST(Canvas, TextThatIsNoUtf8IsShownAsFarAsItIsAscii) {
  Canvas canvas(Strips::one(PlotFormat::png, 100, 100));
  EXPECT_EQ(canvas.text_width("a\xff"
                              "b"),
            canvas.text_width("a?b"));
  EXPECT_GT(canvas.text_width("wide"), canvas.text_width("w"));
  EXPECT_EQ(canvas.text_width(""), 0);
  EXPECT_NO_THROW(canvas.text({50, 50},
                              "a\xff"
                              "b",
                              TextAlign::centre));
  EXPECT_FALSE(canvas.finish().empty());
}

}  // namespace
}  // namespace quadloop::io
