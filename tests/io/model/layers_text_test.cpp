#include "io/model/layers_text.hpp"

#include <gtest/gtest.h>

namespace quadloop::io {
namespace {

TEST(LayersText, ComesBackToTheBit) {
  EXPECT_EQ(text_of_layers({30, 0.0118}), "30 0.0118");
  for (const WallLayers& layers : {WallLayers{1, 1 / 3.0}, WallLayers{2147483647, 5e-324}, WallLayers{7, 0}})
    EXPECT_EQ(layers_of_text(text_of_layers(layers)), layers);
}

TEST(LayersText, TheThicknessMayBeMissing) {
  EXPECT_EQ(layers_of_text(" 12 "), (WallLayers{12, 0}));
  EXPECT_EQ(layers_of_text("12\t1e-2"), (WallLayers{12, 0.01}));
}

TEST(LayersText, IsNoneWhereItSaysWhatCannotBe) {
  for (const char* text :
       {"", "x", "0", "-3", "3.5", "99999999999", "3 x", "3 -1", "3 nan", "3 inf", "3 1 1"})
    EXPECT_EQ(layers_of_text(text), WallLayers{}) << text;
}

}  // namespace
}  // namespace quadloop::io
