// SPDX-License-Identifier: GPL-3.0-or-later
#include "format/exif.h"

#include <cstddef>
#include <memory>
#include <random>
#include <span>
#include <string>

#include <gtest/gtest.h>

#include "support/bytes/jpeg_maker.h"

namespace argil::io {
namespace {

using test::JpegMaker;

/// From a block of just that size, so that a sanitizer sees one byte over.
int orientation_in(const std::string& segment) {
  const std::unique_ptr<std::byte[]> block(new std::byte[segment.size()]);
  for (std::size_t n = 0; n < segment.size(); ++n) block[n] = static_cast<std::byte>(segment[n]);
  return exif_orientation({block.get(), segment.size()});
}

TEST(Exif, TellsTheOrientationInBothOrdersOfBytes) {
  for (int orientation = 1; orientation <= 8; ++orientation) {
    for (const bool is_little : {false, true}) {
      EXPECT_EQ(orientation_in(JpegMaker::exif_of(orientation, is_little)), orientation);
    }
  }
}

TEST(Exif, TakesWhatIsOddForTheUsualWayUp) {
  EXPECT_EQ(orientation_in(JpegMaker::exif_of(0)), 1);
  EXPECT_EQ(orientation_in(JpegMaker::exif_of(9)), 1);
  EXPECT_EQ(orientation_in(""), 1);
  EXPECT_EQ(orientation_in("http://ns.adobe.com/xap/1.0/"), 1);
  std::string mixed = JpegMaker::exif_of(6);
  mixed[6] = 'I';  // one letter of each order
  EXPECT_EQ(orientation_in(mixed), 1);
  std::string far = JpegMaker::exif_of(6);
  far[10] = far[11] = far[12] = far[13] = '\xFF';  // the list lies at the end of 4 GB
  EXPECT_EQ(orientation_in(far), 1);
  std::string many = JpegMaker::exif_of(6);
  many[14] = many[15] = '\xFF';  // so many tags, of which the second is the one
  EXPECT_EQ(orientation_in(many), 6);
}

TEST(Exif, ReadsNothingBeyondItsEnd) {
  const std::string whole = JpegMaker::exif_of(6);
  // The value ends two bytes and the offset of the next list before the end.
  for (std::size_t length = 0; length <= whole.size(); ++length) {
    EXPECT_EQ(orientation_in(whole.substr(0, length)), length + 6 < whole.size() ? 1 : 6) << length;
  }
  std::mt19937 random(5);
  for (int n = 0; n < 20000; ++n) {
    std::string changed = whole;
    for (unsigned k = 0; k <= random() % 3; ++k) {
      changed[6 + random() % (changed.size() - 6)] = static_cast<char>(random());
    }
    const int orientation = orientation_in(changed);
    EXPECT_TRUE(orientation >= 1 && orientation <= 8);
  }
}

}  // namespace
}  // namespace argil::io
