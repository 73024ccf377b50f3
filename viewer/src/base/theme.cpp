// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/theme.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace argil::viewer {
namespace {

/// So that the clay is the lightest thing on the screen; the accents are clay's own colour.
constexpr ThemeColors kDark{.window = {0.13F, 0.13F, 0.14F, 0.94F},
                            .popup = {0.13F, 0.13F, 0.14F, 0.98F},
                            .title = {0.20F, 0.20F, 0.22F},
                            .title_idle = {0.04F, 0.04F, 0.04F},
                            .frame = {0.22F, 0.22F, 0.24F},
                            .frame_hovered = {0.28F, 0.28F, 0.30F},
                            .frame_active = {0.34F, 0.34F, 0.36F},
                            .button = {0.26F, 0.26F, 0.28F},
                            .button_hovered = {0.36F, 0.36F, 0.38F},
                            .button_active = {0.66F, 0.37F, 0.22F},
                            .header = {0.60F, 0.34F, 0.20F, 0.8F},
                            .header_hovered = {0.64F, 0.37F, 0.22F, 0.9F},
                            .header_active = {0.66F, 0.37F, 0.22F},
                            .grab = {0.62F, 0.35F, 0.21F},
                            .grab_active = {0.66F, 0.37F, 0.22F},
                            .text = {1.0F, 1.0F, 1.0F},
                            .weak_text = {0.66F, 0.66F, 0.67F},
                            .heading = {0.93F, 0.60F, 0.40F},
                            .done = {0.80F, 0.90F, 0.80F},
                            .warning = {1.0F, 0.80F, 0.40F},
                            .error = {1.0F, 0.50F, 0.45F},
                            .told = {0.70F, 0.90F, 1.0F},
                            .mark = {0.75F, 0.45F, 0.28F},
                            .mark_active = {0.93F, 0.60F, 0.40F},
                            .line = {0.43F, 0.43F, 0.50F, 0.50F},
                            .air = {0.094F, 0.094F, 0.106F},
                            .clay = {0.588F, 0.345F, 0.227F},
                            .masked = {0.204F, 0.157F, 0.157F},
                            .edge = {0.925F, 0.659F, 0.486F},
                            .before = {0.784F, 0.784F, 0.804F, 0.588F},
                            .hand = {0.588F, 0.804F, 0.961F},
                            .mask_line = {0.95F, 0.95F, 0.98F, 0.95F},
                            .trim_line = {1.0F, 0.62F, 0.38F, 0.95F},
                            .guide = {1.0F, 0.78F, 0.45F, 0.95F},
                            .ground_low = {0.160F, 0.164F, 0.175F},
                            .ground_high = {0.349F, 0.356F, 0.369F}};

/// The ground is no white, beside which the clay would look dark.
constexpr ThemeColors kLight{.window = {0.93F, 0.93F, 0.94F, 0.95F},
                             .popup = {0.97F, 0.97F, 0.98F, 0.98F},
                             .title = {0.84F, 0.84F, 0.86F},
                             .title_idle = {0.89F, 0.89F, 0.91F},
                             .frame = {0.85F, 0.85F, 0.87F},
                             .frame_hovered = {0.80F, 0.80F, 0.82F},
                             .frame_active = {0.76F, 0.76F, 0.78F},
                             .button = {0.83F, 0.83F, 0.85F},
                             .button_hovered = {0.77F, 0.77F, 0.79F},
                             .button_active = {0.92F, 0.66F, 0.50F},
                             .header = {0.93F, 0.72F, 0.58F, 0.9F},
                             .header_hovered = {0.92F, 0.68F, 0.53F, 0.9F},
                             .header_active = {0.92F, 0.66F, 0.50F},
                             .grab = {0.88F, 0.60F, 0.44F},
                             .grab_active = {0.84F, 0.54F, 0.37F},
                             .text = {0.09F, 0.09F, 0.10F},
                             .weak_text = {0.33F, 0.33F, 0.35F},
                             .heading = {0.56F, 0.25F, 0.09F},
                             .done = {0.08F, 0.36F, 0.14F},
                             .warning = {0.48F, 0.29F, 0.0F},
                             .error = {0.68F, 0.09F, 0.07F},
                             .told = {0.05F, 0.32F, 0.52F},
                             .mark = {0.68F, 0.38F, 0.22F},
                             .mark_active = {0.56F, 0.25F, 0.09F},
                             .line = {0.39F, 0.39F, 0.42F, 0.50F},
                             .air = {0.86F, 0.87F, 0.89F},
                             .clay = {0.78F, 0.53F, 0.40F},
                             .masked = {0.45F, 0.40F, 0.39F},
                             .edge = {0.42F, 0.20F, 0.10F},
                             .before = {0.27F, 0.27F, 0.30F, 0.65F},
                             .hand = {0.06F, 0.35F, 0.60F},
                             .mask_line = {0.10F, 0.10F, 0.13F, 0.95F},
                             .trim_line = {0.50F, 0.15F, 0.02F, 0.95F},
                             .guide = {0.42F, 0.19F, 0.01F, 0.95F},
                             .ground_low = {0.62F, 0.63F, 0.65F},
                             .ground_high = {0.80F, 0.81F, 0.83F}};

double linear_light(float encoded) noexcept {
  const double c = static_cast<double>(encoded);
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

}  // namespace

const ThemeColors& colors_of(Theme theme) noexcept {
  return theme == Theme::light ? kLight : kDark;
}

double luminance_of(const Paint& opaque) noexcept {
  assert(opaque.a == 1.0F);
  return 0.2126 * linear_light(opaque.r) + 0.7152 * linear_light(opaque.g) +
         0.0722 * linear_light(opaque.b);
}

Paint seen_over(const Paint& color, const Paint& below) noexcept {
  assert(below.a == 1.0F);
  const auto mixed = [&](float above, float under) {
    return color.a * above + (1.0F - color.a) * under;
  };
  return {mixed(color.r, below.r), mixed(color.g, below.g), mixed(color.b, below.b)};
}

double contrast_of(const Paint& one, const Paint& other) noexcept {
  const double a = luminance_of(one);
  const double b = luminance_of(other);
  return (std::max(a, b) + 0.05) / (std::min(a, b) + 0.05);
}

}  // namespace argil::viewer
