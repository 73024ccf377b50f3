// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/support/picture_alike.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include <png.h>

namespace argil::test {
namespace {

constexpr int kBlock = 8;
constexpr double kMostMean = 6.0;
constexpr double kFarBlock = 40.0;
constexpr double kMostFarBlocks = 0.02;

std::size_t index_of(const Image& image, int x, int y) {
  return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
              static_cast<std::size_t>(x));
}

/// Mean of a channel over a block; those at the right and lower edge may be narrower.
double block_mean(const Image& image, int x0, int y0, std::size_t channel) {
  const int x1 = std::min(x0 + kBlock, image.width);
  const int y1 = std::min(y0 + kBlock, image.height);
  int sum = 0;
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) sum += image.rgb[index_of(image, x, y) + channel];
  }
  return static_cast<double>(sum) / ((x1 - x0) * (y1 - y0));
}

double block_difference(const Image& a, const Image& b, int x, int y) {
  double sum = 0.0;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    sum += std::abs(block_mean(a, x, y, channel) - block_mean(b, x, y, channel));
  }
  return sum / 3.0;
}

bool renews() {
  // Nobody changes the environment.
  const char* wish = std::getenv("ARGIL_RENEW_PICTURES");  // NOLINT(concurrency-mt-unsafe)
  return wish != nullptr && std::string_view(wish) == "1";
}

testing::AssertionResult renew(const std::filesystem::path& made,
                               const std::filesystem::path& committed) {
  std::error_code error;
  std::filesystem::create_directories(committed.parent_path(), error);
  std::filesystem::copy_file(made, committed, std::filesystem::copy_options::overwrite_existing,
                             error);
  if (error) {
    return testing::AssertionFailure() << "cannot renew " << committed << ": " << error.message();
  }
  return testing::AssertionFailure()
         << committed << " is renewed: look at it, commit it, run without ARGIL_RENEW_PICTURES";
}

}  // namespace

Image read_picture(const std::filesystem::path& png) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&header, png.c_str()) == 0) return {};
  header.format = PNG_FORMAT_RGB;
  Image image{static_cast<int>(header.width), static_cast<int>(header.height), {}};
  image.rgb.resize(PNG_IMAGE_SIZE(header));
  if (png_image_finish_read(&header, nullptr, image.rgb.data(), 0, nullptr) == 0) return {};
  return image;
}

testing::AssertionResult are_alike(const Image& made, const Image& committed) {
  if (made.rgb.empty()) return testing::AssertionFailure() << "the made picture has no pixels";
  if (made.width != committed.width || made.height != committed.height) {
    return testing::AssertionFailure() << made.width << " x " << made.height << " pixels against "
                                       << committed.width << " x " << committed.height;
  }
  int blocks = 0;
  int far_blocks = 0;
  double sum = 0.0;
  double most = -1.0;
  std::array<int, 2> most_at{};
  for (int y = 0; y < made.height; y += kBlock) {
    for (int x = 0; x < made.width; x += kBlock) {
      const double difference = block_difference(made, committed, x, y);
      ++blocks;
      sum += difference;
      if (difference > kFarBlock) ++far_blocks;
      if (difference > most) {
        most = difference;
        most_at = {x, y};
      }
    }
  }
  const double mean = sum / blocks;
  const double far_share = static_cast<double>(far_blocks) / blocks;
  if (mean <= kMostMean && far_share <= kMostFarBlocks) return testing::AssertionSuccess();
  return testing::AssertionFailure()
         << "blocks differ by " << mean << " of 255 in the mean (may be " << kMostMean << ") and "
         << 100.0 * far_share << " % of them by more than " << kFarBlock << " (may be "
         << 100.0 * kMostFarBlocks << " %), most by " << most << " at " << most_at[0] << ", "
         << most_at[1];
}

testing::AssertionResult is_as_committed(const std::filesystem::path& made,
                                         const std::filesystem::path& committed) {
  const Image picture = read_picture(made);
  if (picture.rgb.empty()) return testing::AssertionFailure() << made << " was not made";
  if (renews()) return renew(made, committed);
  auto alike = are_alike(picture, read_picture(committed));
  if (alike) return alike;
  // The scratch folder goes with the test; what a person must look at stays.
  const auto kept =
      std::filesystem::temp_directory_path() / ("made-" + committed.filename().string());
  std::error_code ignored;
  std::filesystem::copy_file(made, kept, std::filesystem::copy_options::overwrite_existing,
                             ignored);
  return alike << "\n  " << kept << " is not like " << committed
               << "; if it is right: ARGIL_RENEW_PICTURES=1";
}

}  // namespace argil::test
