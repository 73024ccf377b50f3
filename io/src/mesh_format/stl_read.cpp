// SPDX-License-Identifier: GPL-3.0-or-later
// STL, binary and ASCII. Which of the two is told by the size, since many programs begin the header
// of a binary file with the word "solid".
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

#include "argil/mesh/point_welder.h"

#include "file/load_bytes.h"
#include "format/text_scan.h"
#include "mesh_format/face_collector.h"
#include "mesh_format/mesh_read.h"

namespace argil::io {
namespace {

// The layout is in M. Burns, "Automated Fabrication", 1993, section 6.5.
constexpr std::size_t kHeaderBytes = 84;  // 80 of text and the count
constexpr std::size_t kFacetBytes = 50;   // normal, three vertices, two bytes of attribute
static_assert(std::endian::native == std::endian::little, "STL and binary PLY are read in place");

bool same_ignoring_case(std::string_view token, std::string_view lower) noexcept {
  if (token.size() != lower.size()) return false;
  for (std::size_t i = 0; i < token.size(); ++i) {
    const char c = token[i];
    if ((c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c) != lower[i]) return false;
  }
  return true;
}

bool size_fits_count(std::span<const std::byte> bytes) noexcept {
  if (bytes.size() < kHeaderBytes) return false;
  const auto count = load<std::uint32_t>(bytes, 80);
  return bytes.size() == kHeaderBytes + kFacetBytes * std::size_t{count};
}

/// "solid", then text whose next line begins with "facet" or "endsolid".
bool looks_like_ascii(std::string_view text) noexcept {
  LineScan lines(text);
  std::string_view line;
  bool solid = false;
  while (lines.next(line)) {
    if (line.find('\0') != std::string_view::npos) return false;
    const std::string_view token = take_token(line);
    if (token.empty()) continue;
    if (solid) return same_ignoring_case(token, "facet") || same_ignoring_case(token, "endsolid");
    if (!same_ignoring_case(token, "solid")) return false;
    solid = true;
  }
  return solid;
}

/// Welds corners, most of which a triangle not far before has too: those it remembers in a table
/// that stays in the cache.
class CornerWelder {
 public:
  using Point = std::array<float, 3>;
  explicit CornerWelder(std::vector<Vec3>& positions) : welder_(positions), known_(kKnown) {}

  std::uint32_t add(const Point& point) {
    Known& known = known_[place_of(point)];
    // Of new places none is met: NaN equals nothing.
    if (known.point != point) {
      known.point = point;
      known.index = welder_.add({double{point[0]}, double{point[1]}, double{point[2]}});
    }
    return known.index;
  }

 private:
  static constexpr std::size_t kKnown = 2048;
  struct Known {
    Point point{std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F};
    std::uint32_t index = 0;
  };
  static std::size_t place_of(const Point& point) noexcept {
    const auto bits = std::bit_cast<std::array<std::uint32_t, 3>>(point);
    const std::uint64_t mixed = bits[0] * 0x9E3779B97F4A7C15ULL ^ bits[1] * 0xC2B2AE3D27D4EB4FULL ^
                                bits[2] * 0x165667B19E3779F9ULL;
    return static_cast<std::size_t>(mixed >> 40) % kKnown;
  }

  mesh::PointWelder welder_;
  std::vector<Known> known_;
};

/// Some triangles of a binary file: their corners welded among themselves.
class WeldedFacets {
 public:
  /// Those from `begin` to `end`; their corners are numbered in `triangles` as in positions().
  void read(std::span<const std::byte> bytes, std::size_t begin, std::size_t end,
            std::vector<Triangle>& triangles);
  const std::vector<Vec3>& positions() const noexcept { return positions_; }
  /// What is wrong with a corner, the first of all; none where nothing is.
  std::optional<Error> problem(std::span<const std::byte> bytes, const std::string& name) const;

 private:
  static std::size_t byte_of(std::size_t triangle, std::size_t corner) noexcept {
    return kHeaderBytes + kFacetBytes * triangle + 12 + 12 * corner;
  }
  std::vector<Vec3> positions_;
  std::optional<std::size_t> wrong_corner_;  ///< 3 t + k
};

void WeldedFacets::read(std::span<const std::byte> bytes, std::size_t begin, std::size_t end,
                        std::vector<Triangle>& triangles) {
  positions_.clear();
  wrong_corner_.reset();
  CornerWelder welder(positions_);
  for (std::size_t t = begin; t < end; ++t) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const auto point = load<std::array<float, 3>>(bytes, byte_of(t, corner));
      if (!is_in_reach({double{point[0]}, double{point[1]}, double{point[2]}})) {
        wrong_corner_ = 3 * t + corner;
        return;
      }
      triangles[t][corner] = welder.add(point);
    }
  }
}

std::optional<Error> WeldedFacets::problem(std::span<const std::byte> bytes,
                                           const std::string& name) const {
  if (!wrong_corner_) return std::nullopt;
  const std::size_t triangle = *wrong_corner_ / 3;
  const std::size_t at = byte_of(triangle, *wrong_corner_ % 3);
  const auto [x, y, z] = load<std::array<float, 3>>(bytes, at);
  return byte_error(name, at,
                    position_problem({double{x}, double{y}, double{z}},
                                     " of triangle " + std::to_string(triangle + 1)));
}

/// Welded some at a time on all threads, and those together in the order of the file: numbers go by
/// the first triangle that has a position, however many threads there are.
Result<TriangleMesh> parse_binary(std::span<const std::byte> bytes, const std::string& name) {
  constexpr std::size_t kTriangles = 16384;
  constexpr std::size_t kAtOnce = 16;
  const auto count = load<std::uint32_t>(bytes, 80);
  if (count == 0) return no_triangles(name);
  TriangleMesh mesh;
  mesh.triangles.resize(count);
  // STL has no shared vertices: corners at equal positions become one.
  mesh::PointWelder welder(mesh.positions);
  std::array<WeldedFacets, kAtOnce> facets;
  std::array<std::vector<std::uint32_t>, kAtOnce> numbers;
  for (std::size_t first = 0; first < count; first += kAtOnce * kTriangles) {
    const std::size_t parts = std::min(kAtOnce, (count - first + kTriangles - 1) / kTriangles);
    const auto begin_of = [&](std::size_t part) {
      return std::min<std::size_t>(first + part * kTriangles, count);
    };
    tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t part) {
      facets[part].read(bytes, begin_of(part), begin_of(part + 1), mesh.triangles);
    });
    for (std::size_t part = 0; part < parts; ++part) {
      if (auto wrong = facets[part].problem(bytes, name)) return std::move(*wrong);
      numbers[part].clear();
      for (const Vec3& point : facets[part].positions()) numbers[part].push_back(welder.add(point));
    }
    tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t part) {
      for (std::size_t t = begin_of(part); t < begin_of(part + 1); ++t) {
        for (std::uint32_t& corner : mesh.triangles[t]) corner = numbers[part][corner];
      }
    });
  }
  return mesh;
}

Error count_lies(std::span<const std::byte> bytes, const std::string& name) {
  if (bytes.size() < kHeaderBytes) {
    return {ErrorKind::bad_input,
            name + " has only " + std::to_string(bytes.size()) +
                " bytes, too few for an STL; it may be cut off, export it again"};
  }
  const std::size_t count = load<std::uint32_t>(bytes, 80);
  return byte_error(name, 80,
                    "the header promises " + std::to_string(count) + " triangles, which take " +
                        std::to_string(kHeaderBytes + kFacetBytes * count) +
                        " bytes, but the file has " + std::to_string(bytes.size()) +
                        "; it is cut off or not an STL, export it again");
}

/// solid NAME / facet normal x y z / outer loop / vertex x y z (3) / endloop / endfacet / endsolid.
class AsciiStl {
 public:
  AsciiStl(std::string_view text, const std::string& name)
      : lines_(text), name_(name), welder_(mesh_.positions) {}

  Result<TriangleMesh> parse();

 private:
  bool next_line();
  Result<void> expect(std::string_view first, std::string_view second = {});
  Result<void> facet();
  Result<std::uint32_t> vertex();
  Error fail(const std::string& message) const {
    return line_error(name_, lines_.number(), message);
  }
  Error wanted(std::string_view what) const {
    if (ended_)
      return fail("the file ends where '" + std::string(what) +
                  "' should follow; it is cut off, export it again");
    return fail("found " + in_quotes(line_) + " where '" + std::string(what) + "' should be");
  }

  LineScan lines_;
  const std::string& name_;
  TriangleMesh mesh_;
  mesh::PointWelder welder_;
  std::string_view line_;
  bool ended_ = false;
};

/// The next line that is not blank.
bool AsciiStl::next_line() {
  while (lines_.next(line_)) {
    std::string_view probe = line_;
    if (!take_token(probe).empty()) return true;
  }
  line_ = {};
  ended_ = true;
  return false;
}

Result<void> AsciiStl::expect(std::string_view first, std::string_view second) {
  next_line();
  std::string_view rest = line_;
  const bool fits = same_ignoring_case(take_token(rest), first) &&
                    (second.empty() || same_ignoring_case(take_token(rest), second));
  if (!fits) return wanted(first);
  return {};
}

Result<std::uint32_t> AsciiStl::vertex() {
  if (Result<void> found = expect("vertex"); !found) return found.error();
  std::string_view rest = line_;
  take_token(rest);
  Vec3 point;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string_view token = take_token(rest);
    if (token.empty()) return fail("a vertex needs three numbers; the file may be cut off");
    if (!read_number(token, point[axis])) return fail(in_quotes(token) + " is not a number");
  }
  if (const std::string problem = position_problem(point); !problem.empty()) return fail(problem);
  return welder_.add(point);
}

/// The facet whose first line was just read; its normal is not used, since the winding says more.
Result<void> AsciiStl::facet() {
  if (Result<void> found = expect("outer", "loop"); !found) return found;
  Triangle triangle{};
  for (std::uint32_t& corner : triangle) {
    const Result<std::uint32_t> index = vertex();
    if (!index) return index.error();
    corner = index.value();
  }
  mesh_.triangles.push_back(triangle);
  if (Result<void> found = expect("endloop"); !found) return found;
  return expect("endfacet");
}

Result<TriangleMesh> AsciiStl::parse() {
  // A file may hold several solids one after the other; all of them are read.
  bool inside = false;
  while (next_line()) {
    std::string_view rest = line_;
    const std::string_view keyword = take_token(rest);
    if (inside && same_ignoring_case(keyword, "facet")) {
      if (Result<void> read = facet(); !read) return read.error();
    } else if (same_ignoring_case(keyword, inside ? "endsolid" : "solid")) {
      inside = !inside;
    } else {
      return wanted(inside ? "facet' or 'endsolid" : "solid");
    }
  }
  if (inside) return wanted("endsolid");
  if (mesh_.triangles.empty()) return no_triangles(name_);
  return std::move(mesh_);
}

}  // namespace

Result<TriangleMesh> parse_stl(std::span<const std::byte> bytes, const std::string& name) {
  if (size_fits_count(bytes)) return parse_binary(bytes, name);
  std::string decoded;
  const std::string_view text = as_ascii(bytes, decoded);
  if (looks_like_ascii(text)) return AsciiStl(text, name).parse();
  return count_lies(bytes, name);
}

}  // namespace argil::io
