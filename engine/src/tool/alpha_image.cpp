// SPDX-License-Identifier: GPL-3.0-or-later
// Layers are averaged by area, so that one with an odd number of pixels still has its edges where
// the image has them, and repeats without a seam.
#include "argil/engine/alpha_image.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <new>
#include <string>
#include <utility>

#include "field/bad_input.h"

namespace argil {
namespace {

constexpr double kWhite = 65535.0;
constexpr int kFirstBlock = 8;  // pixels a side

/// How much of each pixel an averaged one covers, along one axis.
struct Share {
  int first = 0;
  std::array<double, 4> weight{};  ///< adds up to 1
};

/// `finer` pixels seen as `count`, which are as wide as one to two of them.
std::vector<Share> shares_of(int finer, int count) {
  assert(count >= 1 && count <= finer && finer <= 2 * count);
  std::vector<Share> shares(static_cast<std::size_t>(count));
  const double wide = static_cast<double>(finer) / count;
  for (int n = 0; n < count; ++n) {
    Share& share = shares[static_cast<std::size_t>(n)];
    const double low = n * wide;
    const double high = n + 1 == count ? finer : (n + 1) * wide;
    share.first = static_cast<int>(low);
    for (int k = 0; k < 4; ++k) {
      const double pixel = share.first + k;
      const double covered = std::min(high, pixel + 1.0) - std::max(low, pixel);
      share.weight[static_cast<std::size_t>(k)] = std::max(0.0, covered) / (high - low);
    }
  }
  return shares;
}

int held_within(int index, int count, AlphaImage::Beyond beyond) noexcept {
  if (beyond == AlphaImage::Beyond::edge) return std::clamp(index, 0, count - 1);
  const int rest = index % count;
  return rest < 0 ? rest + count : rest;
}

/// The four pixels around a place along one axis, and their parts in its value.
struct Spline {
  std::array<int, 4> index;
  std::array<double, 4> weight;
};

Spline spline_at(double place, int count, AlphaImage::Beyond beyond) noexcept {
  const double pixels = place * count - 0.5;
  const double floor = std::floor(pixels);
  const double t = pixels - floor;
  const double s = 1.0 - t;
  Spline spline{};
  spline.weight = {s * s * s / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
                   (3.0 * s * s * s - 6.0 * s * s + 4.0) / 6.0, t * t * t / 6.0};
  for (int k = 0; k < 4; ++k) {
    spline.index[static_cast<std::size_t>(k)] =
        held_within(static_cast<int>(floor) - 1 + k, count, beyond);
  }
  return spline;
}

Result<void> validate_size(int width, int height, std::size_t pixels) {
  for (const auto& [name, side] : {std::pair{"width", width}, std::pair{"height", height}}) {
    if (side >= AlphaImage::kLeastSide && side <= AlphaImage::kMostSide) continue;
    return bad_input(std::string("the image's ") + name + " is " + std::to_string(side) +
                     " pixels; must be from " + std::to_string(AlphaImage::kLeastSide) + " to " +
                     std::to_string(AlphaImage::kMostSide));
  }
  if (pixels == static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) return {};
  return bad_input("an image of " + std::to_string(width) + " by " + std::to_string(height) +
                   " pixels came with " + std::to_string(pixels) + " of them; give one for each");
}

}  // namespace

Result<std::shared_ptr<const AlphaImage>> AlphaImage::make(int width, int height,
                                                           std::vector<std::uint16_t> pixels) {
  if (auto ok = validate_size(width, height, pixels.size()); !ok) return ok.error();
  try {
    std::shared_ptr<AlphaImage> made(new AlphaImage);
    made->layers_.push_back({width, height, std::move(pixels)});
    while (made->layers_.back().width > 1 && made->layers_.back().height > 1) {
      made->layers_.push_back(averaged(made->layers_.back()));
    }
    made->make_blocks();
    return std::shared_ptr<const AlphaImage>(std::move(made));
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::memory, "not enough memory for the image; use a smaller one"};
  }
}

AlphaImage::Layer AlphaImage::averaged(const Layer& finer) {
  Layer layer{(finer.width + 1) / 2, (finer.height + 1) / 2, {}};
  layer.pixels.reserve(static_cast<std::size_t>(layer.width) *
                       static_cast<std::size_t>(layer.height));
  const std::vector<Share> columns = shares_of(finer.width, layer.width);
  const std::vector<Share> rows = shares_of(finer.height, layer.height);
  for (const Share& row : rows) {
    for (const Share& column : columns) {
      double sum = 0.0;
      for (std::size_t j = 0; j < 4; ++j) {
        if (row.weight[j] == 0.0) continue;
        const std::size_t first =
            (static_cast<std::size_t>(row.first) + j) * static_cast<std::size_t>(finer.width) +
            static_cast<std::size_t>(column.first);
        double along = 0.0;
        for (std::size_t k = 0; k < 4; ++k) {
          if (column.weight[k] != 0.0) along += column.weight[k] * finer.pixels[first + k];
        }
        sum += row.weight[j] * along;
      }
      layer.pixels.push_back(static_cast<std::uint16_t>(std::clamp(sum + 0.5, 0.0, kWhite)));
    }
  }
  return layer;
}

void AlphaImage::make_blocks() {
  const Layer& image = layers_.front();
  Blocks blocks{kFirstBlock,
                (image.width + kFirstBlock - 1) / kFirstBlock,
                (image.height + kFirstBlock - 1) / kFirstBlock,
                {},
                {}};
  const std::size_t count =
      static_cast<std::size_t>(blocks.columns) * static_cast<std::size_t>(blocks.rows);
  blocks.least.assign(count, 65535);
  blocks.most.assign(count, 0);
  for (std::size_t n = 0; n < image.pixels.size(); ++n) {
    const auto y = static_cast<int>(n / static_cast<std::size_t>(image.width));
    const auto x = static_cast<int>(n % static_cast<std::size_t>(image.width));
    const auto at = static_cast<std::size_t>(y / kFirstBlock * blocks.columns + x / kFirstBlock);
    blocks.least[at] = std::min(blocks.least[at], image.pixels[n]);
    blocks.most[at] = std::max(blocks.most[at], image.pixels[n]);
  }
  blocks_.push_back(std::move(blocks));
  while (blocks_.back().columns > 1 || blocks_.back().rows > 1) {
    blocks_.push_back(merged(blocks_.back()));
  }
  all_ = {blocks_.back().least.front() / kWhite, blocks_.back().most.front() / kWhite};
}

AlphaImage::Blocks AlphaImage::merged(const Blocks& finer) {
  Blocks blocks{2 * finer.side, (finer.columns + 1) / 2, (finer.rows + 1) / 2, {}, {}};
  for (int j = 0; j < blocks.rows; ++j) {
    for (int i = 0; i < blocks.columns; ++i) {
      std::uint16_t least = 65535;
      std::uint16_t most = 0;
      for (int y = 2 * j; y < std::min(2 * j + 2, finer.rows); ++y) {
        for (int x = 2 * i; x < std::min(2 * i + 2, finer.columns); ++x) {
          const auto at = static_cast<std::size_t>(y * finer.columns + x);
          least = std::min(least, finer.least[at]);
          most = std::max(most, finer.most[at]);
        }
      }
      blocks.least.push_back(least);
      blocks.most.push_back(most);
    }
  }
  return blocks;
}

int AlphaImage::layer_of(double least_pixels) const noexcept {
  const int last = static_cast<int>(layers_.size()) - 1;
  int layer = 0;
  for (double wide = 1.0; wide < least_pixels && layer < last; wide *= 2.0) ++layer;
  return layer;
}

double AlphaImage::at(int layer, double x, double y, Beyond beyond) const noexcept {
  assert(layer >= 0 && layer < static_cast<int>(layers_.size()));
  assert(std::abs(x) <= 1e6 && std::abs(y) <= 1e6);
  const Layer& from = layers_[static_cast<std::size_t>(layer)];
  const Spline across = spline_at(x, from.width, beyond);
  const Spline down = spline_at(y, from.height, beyond);
  double sum = 0.0;
  for (std::size_t j = 0; j < 4; ++j) {
    const std::uint16_t* row = from.pixels.data() + static_cast<std::size_t>(down.index[j]) *
                                                        static_cast<std::size_t>(from.width);
    double along = 0.0;
    for (std::size_t k = 0; k < 4; ++k) along += across.weight[k] * row[across.index[k]];
    sum += down.weight[j] * along;
  }
  return sum / kWhite;
}

AlphaImage::Range AlphaImage::range(int layer, double x, double y, double x_end,
                                    double y_end) const noexcept {
  assert(x <= x_end && y <= y_end);
  // What a spline reads beside its place.
  const double margin = 2.5 * static_cast<double>(1 << layer);
  const auto ends = [&](double low, double high, int count) {
    const double most = count - 1;
    return std::pair{static_cast<int>(std::clamp(low * count - margin, 0.0, most)),
                     static_cast<int>(std::clamp(high * count + margin, 0.0, most))};
  };
  const auto [left, right] = ends(x, x_end, width());
  const auto [top, bottom] = ends(y, y_end, height());
  std::size_t use = 0;
  constexpr int kMostBlocks = 4;  // each way
  while (use + 1 < blocks_.size() &&
         std::max(right - left, bottom - top) > kMostBlocks * blocks_[use].side) {
    ++use;
  }
  const Blocks& blocks = blocks_[use];
  std::uint16_t least = 65535;
  std::uint16_t most = 0;
  for (int j = top / blocks.side; j <= bottom / blocks.side; ++j) {
    for (int i = left / blocks.side; i <= right / blocks.side; ++i) {
      const auto at = static_cast<std::size_t>(j * blocks.columns + i);
      least = std::min(least, blocks.least[at]);
      most = std::max(most, blocks.most[at]);
    }
  }
  return {least / kWhite, most / kWhite};
}

}  // namespace argil
