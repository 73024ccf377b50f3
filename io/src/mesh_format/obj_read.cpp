// SPDX-License-Identifier: GPL-3.0-or-later
// Wavefront OBJ. Only `v` and `f` matter here; `vt` and `vn` are checked for being whole, so that a
// file cut in the middle of them is noticed; every other statement is skipped. Text is in ASCII,
// UTF-8 or, with its mark, UTF-16.
#include <utility>
#include <vector>

#include "format/text_scan.h"
#include "mesh_format/face_collector.h"
#include "mesh_format/mesh_read.h"

namespace argil::io {
namespace {

class ObjParser {
 public:
  explicit ObjParser(const std::string& name) : name_(name) {}

  Result<TriangleMesh> parse(std::string_view text);

 private:
  Result<void> statement(std::string_view line);
  Result<void> vertex(std::string_view rest);
  Result<void> face(std::string_view rest);
  Result<void> need_numbers(std::string_view keyword, std::string_view rest, int count);
  Result<std::int64_t> corner(std::string_view token);
  Error fail(const std::string& message) const { return line_error(name_, line_, message); }

  const std::string& name_;
  std::int64_t line_ = 0;
  TriangleMesh mesh_;
  FaceCollector faces_;
  std::vector<std::int64_t> corners_;
};

Result<void> ObjParser::vertex(std::string_view rest) {
  Vec3 point;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string_view token = take_token(rest);
    if (token.empty()) {
      return fail("a vertex needs three numbers and has " + std::to_string(axis) +
                  "; the file may be cut off, export it again");
    }
    if (!read_number(token, point[axis])) {
      return fail(in_quotes(token) + " is not a number; export the file again");
    }
  }
  if (const std::string problem = position_problem(point); !problem.empty()) return fail(problem);
  mesh_.positions.push_back(point);
  return {};
}

/// `v`, `v/vt`, `v//vn` or `v/vt/vn`; counted from 1, or from the latest backwards when negative.
Result<std::int64_t> ObjParser::corner(std::string_view token) {
  const std::string_view index = token.substr(0, token.find('/'));
  std::int64_t number = 0;
  if (!read_integer(index, number) || number == 0) {
    return fail(in_quotes(token) + " does not name a vertex; numbers start at 1");
  }
  const auto count = static_cast<std::int64_t>(mesh_.positions.size());
  const std::int64_t position = number > 0 ? number - 1 : count + number;
  // There is no upper bound yet, since a face may name vertices that come later: parse() checks it.
  if (position < 0) {
    return fail("a face names vertex " + std::to_string(number) + " where only " +
                std::to_string(count) + " came before; export the file again");
  }
  for (std::size_t slash = token.find('/'); slash != std::string_view::npos;) {
    const std::size_t next = token.find('/', slash + 1);
    const std::string_view extra = token.substr(slash + 1, next - slash - 1);
    if (!extra.empty() && !read_integer(extra, number)) {
      return fail(in_quotes(token) + " is not of the form vertex/texture/normal");
    }
    slash = next;
  }
  return position;
}

Result<void> ObjParser::face(std::string_view rest) {
  corners_.clear();
  for (std::string_view token = take_token(rest); !token.empty(); token = take_token(rest)) {
    const Result<std::int64_t> position = corner(token);
    if (!position) return position.error();
    corners_.push_back(position.value());
  }
  if (corners_.size() < 3) {
    return fail("a face needs three corners and has " + std::to_string(corners_.size()) +
                "; the file may be cut off, export it again");
  }
  const std::string problem = faces_.add(corners_, static_cast<std::uint64_t>(line_));
  return problem.empty() ? Result<void>() : fail(problem);
}

Result<void> ObjParser::need_numbers(std::string_view keyword, std::string_view rest, int count) {
  for (int i = 0; i < count; ++i) {
    double number = 0.0;
    if (!read_number(take_token(rest), number)) {
      return fail(in_quotes(keyword) + " needs " + std::to_string(count) +
                  " number(s); the file may be cut off, export it again");
    }
  }
  return {};
}

Result<void> ObjParser::statement(std::string_view line) {
  const std::string_view keyword = take_token(line);
  if (keyword == "v") return vertex(line);
  // `fo` is the older name of a face.
  if (keyword == "f" || keyword == "fo") return face(line);
  if (keyword == "vt") return need_numbers(keyword, line, 1);
  if (keyword == "vn") return need_numbers(keyword, line, 3);
  if (keyword.find('\0') != std::string_view::npos) {
    return fail("this is not text; check that the file really is an OBJ");
  }
  return {};
}

Result<TriangleMesh> ObjParser::parse(std::string_view text) {
  LineScan lines(text);
  std::string_view line;
  while (lines.next(line, true)) {
    line_ = lines.number();
    // A comment may follow a statement.
    line = line.substr(0, line.find('#'));
    if (Result<void> read = statement(line); !read) return read.error();
  }
  if (faces_.highest() < 0) return no_triangles(name_);
  if (faces_.highest() >= static_cast<std::int64_t>(mesh_.positions.size())) {
    line_ = static_cast<std::int64_t>(faces_.highest_position());
    return fail("a face names vertex " + std::to_string(faces_.highest() + 1) + " of only " +
                std::to_string(mesh_.positions.size()) + "; export the file again");
  }
  mesh_.triangles = faces_.take(mesh_.positions);
  return std::move(mesh_);
}

}  // namespace

Result<TriangleMesh> parse_obj(std::span<const std::byte> bytes, const std::string& name) {
  std::string decoded;
  return ObjParser(name).parse(as_ascii(bytes, decoded));
}

}  // namespace argil::io
