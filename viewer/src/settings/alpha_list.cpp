// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/alpha_list.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <system_error>

#include "argil/core/free_name.h"
#include "argil/engine/alpha_image.h"
#include "argil/io/alpha_file.h"
#include "argil/io/safe_file.h"

#include "base/text.h"

namespace argil::viewer {
namespace {

namespace fs = std::filesystem;

using Thumb = std::array<std::uint8_t, kThumbSide * kThumbSide>;

/// The middle of an image, one part in `zoom` along its sides; each place averaged over about as
/// many pixels as it stands for.
Thumb middle_of(const AlphaImage& image, double zoom) {
  Thumb thumb{};
  const double longer = std::max(image.width(), image.height());
  const double wide = image.width() / longer;
  const double high = image.height() / longer;
  const int layer = image.layer_of(longer / zoom / static_cast<double>(kThumbSide));
  for (std::size_t n = 0; n < thumb.size(); ++n) {
    const auto place = [](std::size_t at) {
      return (static_cast<double>(at) + 0.5) / static_cast<double>(kThumbSide) - 0.5;
    };
    const double x = place(n % kThumbSide) / zoom / wide + 0.5;
    const double y = place(n / kThumbSide) / zoom / high + 0.5;
    if (x < 0.0 || x > 1.0 || y < 0.0 || y > 1.0) continue;
    const double grey = image.at(layer, x, y, AlphaImage::Beyond::edge);
    thumb[n] = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(grey, 0.0, 1.0)));
  }
  return thumb;
}

/// A pattern so fine that it would be one grey is shown larger, in part.
Thumb thumb_of(const AlphaImage& image) {
  constexpr int kLeastContrast = 100;
  constexpr int kMostZoom = 8;
  const double all = 255.0 * (image.range().most - image.range().least);
  Thumb thumb{};
  for (int zoom = 1; zoom <= kMostZoom; zoom *= 2) {
    thumb = middle_of(image, zoom);
    const auto [least, most] = std::minmax_element(thumb.begin(), thumb.end());
    if (*most - *least >= std::min<double>(kLeastContrast, 0.5 * all)) break;
  }
  return thumb;
}

void fill_alphas(const fs::path& folder, std::vector<Error>& problems) {
  std::error_code error;
  fs::create_directories(folder, error);  // what is wrong shows when a file is written
  for (const auto& [name, bytes] : built_in_alphas()) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (auto written = io::replace_text(folder / name, text); !written) {
      problems.push_back(written.error());
    }
  }
}

}  // namespace

AlphaList read_alphas(const fs::path& home, const Progress& progress) {
  AlphaList list;
  const fs::path folder = home / "alphas";
  std::error_code error;
  if (!fs::exists(folder, error)) fill_alphas(folder, list.problems);
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (!has_image_ending(entry.path())) continue;
    auto image = io::read_alpha(entry.path(), progress);
    if (!image && image.error().kind == ErrorKind::interrupted) break;
    if (!image) {
      list.problems.push_back(image.error());
      continue;
    }
    list.alphas.push_back({entry.path(), entry.path().stem().string(), thumb_of(*image.value())});
  }
  std::sort(list.alphas.begin(), list.alphas.end(),
            [](const AlphaChoice& a, const AlphaChoice& b) { return a.name < b.name; });
  return list;
}

Result<fs::path> add_alpha(const fs::path& home, const fs::path& file, const Progress& progress) {
  const auto image = io::read_alpha(file, progress);
  if (!image) return image.error();
  const fs::path folder = home / "alphas";
  if (std::error_code error; !fs::exists(folder, error)) {
    std::vector<Error> problems;
    fill_alphas(folder, problems);
    if (!problems.empty()) return problems.front();
  }
  const auto is_same = [&](const fs::path& there) {
    const auto other = io::read_alpha(there, progress);
    return other && io::alpha_hash(*other.value()) == io::alpha_hash(*image.value());
  };
  constexpr std::size_t kMostBytes = 200;
  const std::string stem = file.stem().string().substr(0, kMostBytes);
  const auto path_of = [&](const std::string& name) { return folder / (name + ".png"); };
  const std::string name = free_name(stem, kMostBytes, [&](const std::string& tried) {
    std::error_code error;
    return fs::exists(path_of(tried), error) && !is_same(path_of(tried));
  });
  std::error_code error;
  if (fs::exists(path_of(name), error)) return path_of(name);
  if (auto written = io::write_alpha(path_of(name), *image.value()); !written) {
    return written.error();
  }
  return path_of(name);
}

}  // namespace argil::viewer
