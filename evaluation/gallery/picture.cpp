// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of a plate and the sheet that shows them with their figures. Text of an SVG is as sharp
// as the screen, and can be searched.
#include "gallery/picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <utility>

#include "argil/io/png.h"

namespace argil::evaluation {
namespace {

constexpr int kWidth = 216;  ///< of a picture, in pixels
constexpr int kHeight = 200;
constexpr int kGap = 8;
constexpr int kHead = 62;  ///< above the pictures
constexpr int kLine = 16;  ///< of text

void add_angle_weighted_normals(TriangleMesh& mesh) {
  mesh.normals.assign(mesh.positions.size(), {});
  for (const Triangle& t : mesh.triangles) {
    const Vec3 twice = cross(mesh.positions[t[1]] - mesh.positions[t[0]],
                             mesh.positions[t[2]] - mesh.positions[t[0]]);
    if (!(length(twice) > 0.0)) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& at = mesh.positions[t[i]];
      const Vec3 one = mesh.positions[t[(i + 1) % 3]] - at;
      const Vec3 other = mesh.positions[t[(i + 2) % 3]] - at;
      mesh.normals[t[i]] += std::atan2(length(twice), dot(one, other)) * normalized(twice);
    }
  }
  for (Vec3& normal : mesh.normals) {
    normal = length(normal) > 0.0 ? normalized(normal) : Vec3{0, 0, 1};
  }
}

std::string base64(const std::vector<std::byte>& bytes) {
  constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(bytes.size() / 3 * 4 + 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      three =
          three << 8U | (i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k <= bytes.size() ? kDigits[three >> (18U - 6U * k) & 63U] : '=';
    }
  }
  return text;
}

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&') {
      safe += "&amp;";
    } else if (c == '<') {
      safe += "&lt;";
    } else {
      safe += c;
    }
  }
  return safe;
}

class SvgSheet {
 public:
  SvgSheet(int columns, int lines)
      : width_(columns * (kWidth + kGap) + kGap), height_(kHead + kHeight + (lines + 1) * kLine) {
    text_ << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << width_ << "\" height=\""
          << height_ << "\" viewBox=\"0 0 " << width_ << " " << height_
          << "\" font-family=\"DejaVu Sans,Verdana,sans-serif\" font-size=\"11\" fill=\"#222\">\n"
          << "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
  }
  static int left_of(std::size_t column) {
    return kGap + static_cast<int>(column) * (kWidth + kGap);
  }

  void write(int x, int y, const std::string& words, const char* style = "") {
    text_ << "<text x=\"" << x << "\" y=\"" << y << "\"" << style << ">" << escaped(words)
          << "</text>\n";
  }
  void box(int x, int y) {
    text_ << "<rect x=\"" << x << "\" y=\"" << y << "\" width=\"" << kWidth << "\" height=\""
          << kHeight << "\" fill=\"#eee\"/>\n";
  }
  void picture(int x, int y, const std::vector<std::byte>& png) {
    text_ << "<image x=\"" << x << "\" y=\"" << y << "\" width=\"" << kWidth << "\" height=\""
          << kHeight << "\" href=\"data:image/png;base64," << base64(png) << "\"/>\n";
  }
  std::string finished() { return text_.str() + "</svg>\n"; }

 private:
  int width_;
  int height_;
  std::ostringstream text_;
};

constexpr const char* kBold = " font-weight=\"bold\"";
constexpr const char* kRight = " text-anchor=\"end\"";
constexpr const char* kMiddle = " text-anchor=\"middle\" fill=\"#777\"";

/// Why there is no picture, in the middle of its place.
void write_reason(SvgSheet& sheet, int x, const std::string& reason) {
  sheet.box(x, kHead);
  std::istringstream lines(reason);
  int y = kHead + kHeight / 2 - kLine;
  for (std::string line; std::getline(lines, line, '|'); y += kLine) {
    sheet.write(x + kWidth / 2, y, line, kMiddle);
  }
}

void write_figures(SvgSheet& sheet, int x, const std::vector<Figure>& figures) {
  int y = kHead + kHeight + kLine;
  for (const Figure& figure : figures) {
    sheet.write(x, y, figure.name);
    sheet.write(x + kWidth, y, figure_text(figure), kRight);
    y += kLine;
  }
}

}  // namespace

Result<Image> plate_image(const Plate& plate, TriangleMesh mesh, const Progress& progress) {
  if (mesh.normals.empty()) add_angle_weighted_normals(mesh);
  RenderOptions options;
  options.width = kWidth;
  options.height = kHeight;
  options.toward = plate.toward;
  options.up = work_place().north;
  const Vec3 middle = place_on_ball(0.0, 0.0, plate.frame_up_mm);
  const double half = 0.5 * plate.frame_mm;
  options.frame_mm = Box3{middle - Vec3{half, half, half}, middle + Vec3{half, half, half}};
  auto image = render(mesh, options, progress);
  if (!image) return image;
  // The last bit is the renderer's dither, which no eye misses; files are a third smaller without.
  for (std::uint8_t& value : image.value().rgb) value &= 0xFEU;
  return image;
}

Result<std::string> plate_svg(const Plate& plate, const std::vector<Column>& columns,
                              const Progress& progress) {
  std::size_t lines = 0;
  for (const Column& column : columns) lines = std::max(lines, column.figures.size());
  SvgSheet sheet(static_cast<int>(columns.size()), static_cast<int>(lines));
  sheet.write(kGap, kLine, plate_text(plate), kBold);
  for (std::size_t n = 0; n < columns.size(); ++n) {
    const Column& column = columns[n];
    const int x = SvgSheet::left_of(n);
    sheet.write(x, kHead - kLine - 6, column.maker, kBold);
    sheet.write(x, kHead - 6, column.with);
    if (!column.image) {
      write_reason(sheet, x, column.reason);
      continue;
    }
    const auto png = io::pack_png(info_of(plate.action).name, *column.image, progress);
    if (!png) return png.error();
    sheet.picture(x, kHead, png.value());
    write_figures(sheet, x, column.figures);
  }
  return sheet.finished();
}

}  // namespace argil::evaluation
