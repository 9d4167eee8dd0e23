// Owners of file descriptors.
#include "flow/command/descriptor.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>

#include "mesher/base/error.hpp"

namespace quadloop {
namespace {

bool is_open(int number) { return ::fcntl(number, F_GETFD) >= 0; }

TEST(Descriptor, IsOutOfTheWayAndNotInherited) {
  const Descriptor file = open_descriptor("/dev/null", O_RDWR);
  EXPECT_GE(file.number(), 10);
  EXPECT_NE(::fcntl(file.number(), F_GETFD) & FD_CLOEXEC, 0);
  const int raw = ::open("/dev/null", O_RDONLY);
  const Descriptor taken(raw);
  EXPECT_GE(taken.number(), 10);
  EXPECT_TRUE(raw >= 10 || !is_open(raw)) << "the lower number is given back";
}

TEST(Descriptor, ClosesWhatItOwnsOnce) {
  int number = -1, replaced = -1;
  {
    Descriptor first = open_descriptor("/dev/null", O_RDONLY);
    number = first.number();
    Descriptor second(std::move(first));
    EXPECT_EQ(second.number(), number);
    Descriptor third = open_descriptor("/dev/null", O_RDONLY);
    replaced = third.number();
    third = std::move(second);
    EXPECT_EQ(third.number(), number);
    EXPECT_TRUE(is_open(number));
    third.close();
    EXPECT_FALSE(is_open(number));
    third.close();
  }
  EXPECT_FALSE(is_open(number));
  EXPECT_FALSE(is_open(replaced)) << "what stood there before, too";
  EXPECT_NO_THROW(Descriptor().close());
}

TEST(Descriptor, WhatCannotBeOpenedIsNamed) {
  try {
    open_descriptor("/nowhere/at/all", O_RDONLY);
    FAIL();
  } catch (const OutputError& fault) {
    EXPECT_TRUE(std::string(fault.what()).starts_with("/nowhere/at/all: ")) << fault.what();
  }
}

TEST(Pipe, CarriesBytesUntilItsWritersAreGone) {
  Pipe pipe = make_pipe();
  ASSERT_EQ(::write(pipe.writing.number(), "abc", 3), 3);
  std::array<char, 8> bytes{};
  EXPECT_EQ(::read(pipe.reading.number(), bytes.data(), bytes.size()), 3);
  pipe.writing.close();
  EXPECT_EQ(::read(pipe.reading.number(), bytes.data(), bytes.size()), 0);
}

}  // namespace
}  // namespace quadloop
