// SPDX-License-Identifier: GPL-3.0-or-later
// What an image to sculpt by costs until it can be drawn, by format: reading it, its smaller
// levels, and how long whoever asks it to stop waits, in the middle of either. Something like a
// photograph, smooth with a little noise, of a square of so many pixels. A markdown table; CPU of
// one thread. Usage: bench_images [SIDE]; usual 8192, the most that the window takes
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>

#include "argil/core/pace.h"
#include "argil/core/progress.h"
#include "argil/io/image_file.h"
#include "argil/io/png.h"

#include "bench/clock.h"
#include "bench/memory.h"
#include "picture/reference_image.h"
#include "support/bytes/jpeg_maker.h"

namespace argil::bench {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMostPixels = std::int64_t{1} << 28;

/// The same in each run: a slow wave in each channel, and four bits of a hash.
unsigned photograph(unsigned x, unsigned y, int channel) {
  const auto phase = static_cast<double>(channel);
  const double wave = std::sin(0.003 * x + phase) + std::sin(0.0021 * y + 2.0 * phase);
  const std::uint32_t noise = ((x * 2654435761U) ^ (y * 2246822519U)) * 3266489917U;
  return static_cast<unsigned>(120.0 + 55.0 * wave) + (noise >> 28U);
}

/// Stops the work at its ninths: how long it takes at most to end then.
template <class Work>
double longest_end_ms(const Work& work) {
  double longest_ms = 0.0;
  for (int n = 1; n < 9; ++n) {
    double told_ms = 0.0;
    work([&](std::string_view, double done) {
      if (done < n / 9.0) return true;
      told_ms = thread_cpu_ms();
      return false;
    });
    longest_ms = std::max(longest_ms, thread_cpu_ms() - told_ms);
  }
  return longest_ms;
}

/// The longest while between two questions: for so long nobody is heard.
template <class Work>
double longest_deaf_ms(const Work& work) {
  double last_ms = thread_cpu_ms();
  double longest_ms = 0.0;
  work([&](std::string_view, double) {
    longest_ms = std::max(longest_ms, thread_cpu_ms() - last_ms);
    last_ms = thread_cpu_ms();
    return true;
  });
  return std::max(longest_ms, thread_cpu_ms() - last_ms);
}

void measure(const char* name, const fs::path& file) {
  const double before_mb = begin_peak();
  const double start_ms = thread_cpu_ms();
  auto read = io::read_image(file, kMostPixels);
  const double read_ms = thread_cpu_ms() - start_ms;
  if (!read) {
    std::fprintf(stderr, "bench_images: %s\n", read.error().message.c_str());
    std::exit(1);
  }
  const double peak_mb = status_mb("VmHWM") - before_mb;
  const auto again = [&](const Progress& progress) {
    static_cast<void>(io::read_image(file, kMostPixels, progress).ok());
  };
  const double deaf_ms = longest_deaf_ms(again);
  const double end_ms = longest_end_ms(again);
  io::ClearImage& image = read.value();
  const double pixels = static_cast<double>(image.width) * image.height;
  const Progress goes_on;
  const double smaller_start_ms = thread_cpu_ms();
  const auto levels =
      viewer::with_smaller(image.width, image.height, std::move(image.rgba), Pace(goes_on, "read"));
  const double smaller_ms = thread_cpu_ms() - smaller_start_ms;
  std::printf("| %s | %.0f | %.2f | %.1f | %.1f | %.0f | %.1f | %.1f |\n", name,
              1e-6 * static_cast<double>(fs::file_size(file)), 1e-3 * read_ms,
              1e6 * read_ms / pixels, 1e6 * smaller_ms / pixels, peak_mb, deaf_ms, end_ms);
  std::fflush(stdout);
}

void run(unsigned side) {
  const fs::path file = fs::temp_directory_path() / "argil_bench_image";
  std::printf("%u x %u pixels\n\n", side, side);
  std::printf(
      "| | file MB | read s | ns a pixel | smaller, ns a pixel | peak MB | not heard ms |"
      " from stop to end ms |\n|---|---|---|---|---|---|---|---|\n");
  {
    Image image{static_cast<int>(side), static_cast<int>(side), {}};
    image.rgb.reserve(std::size_t{3} * side * side);
    for (unsigned y = 0; y < side; ++y) {
      for (unsigned x = 0; x < side; ++x) {
        for (int c = 0; c < 3; ++c) {
          image.rgb.push_back(static_cast<std::uint8_t>(photograph(x, y, c)));
        }
      }
    }
    if (const auto written = io::write_png(file, image); !written) {
      std::fprintf(stderr, "bench_images: %s\n", written.error().message.c_str());
      std::exit(1);
    }
  }
  measure("PNG", file);
  for (const bool is_progressive : {false, true}) {
    test::JpegMaker maker{side, side};
    maker.quality = 90;
    maker.is_progressive = is_progressive;
    std::ofstream(file, std::ios::binary) << maker.jpeg(photograph);
    measure(is_progressive ? "JPEG, progressive" : "JPEG", file);
  }
  fs::remove(file);
}

}  // namespace
}  // namespace argil::bench

int main(int argc, char** argv) {
  const int side = argc > 1 ? std::atoi(argv[1]) : 8192;
  if (side < 16 || side > argil::io::kMostImageSide) {
    std::fprintf(stderr, "bench_images: SIDE must be from 16 to %d\n", argil::io::kMostImageSide);
    return 1;
  }
  argil::bench::run(static_cast<unsigned>(side));
  return 0;
}
