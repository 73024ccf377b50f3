// SPDX-License-Identifier: GPL-3.0-or-later
// PLY, ASCII and binary of both byte orders. Elements and properties other than the vertex
// positions, the faces' vertex lists and strips of triangles are read over, to the end of the file:
// a file cut anywhere is noticed.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

#include "format/text_scan.h"
#include "mesh_format/face_collector.h"
#include "mesh_format/mesh_read.h"

namespace argil::io {
namespace {

enum class Format { ascii, little, big };
enum class Scalar { i8, u8, i16, u16, i32, u32, f32, f64 };

struct Property {
  std::string name;
  Scalar type = Scalar::f32;
  std::optional<Scalar> count_type;  ///< set for a list
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;
};

struct PlyHeader {
  Format format = Format::ascii;
  std::string stray;  ///< the first line that says nothing known, for messages
  std::vector<Element> elements;
  std::size_t body_byte = 0;
};

std::size_t bytes_of(Scalar type) noexcept {
  constexpr std::array<std::size_t, 8> kBytes{1, 1, 2, 2, 4, 4, 4, 8};
  return kBytes[static_cast<std::size_t>(type)];
}

bool is_integer(Scalar type) noexcept { return type != Scalar::f32 && type != Scalar::f64; }

std::optional<Scalar> scalar_named(std::string_view name) {
  // The names of G. Turk's format (1994), and those with sizes that later programs write.
  constexpr std::array<std::array<std::string_view, 2>, 8> kNames{{{"char", "int8"},
                                                                   {"uchar", "uint8"},
                                                                   {"short", "int16"},
                                                                   {"ushort", "uint16"},
                                                                   {"int", "int32"},
                                                                   {"uint", "uint32"},
                                                                   {"float", "float32"},
                                                                   {"double", "float64"}}};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (name == kNames[i][0] || name == kNames[i][1]) return static_cast<Scalar>(i);
  }
  return std::nullopt;
}

/// The word that a line consists of, blanks aside; empty where there are more.
std::string_view only_word(std::string_view line) noexcept {
  const std::string_view word = take_token(line);
  return take_token(line).empty() ? word : std::string_view();
}

/// With its end, which tells that of the others: a body may hold any byte.
std::string_view first_line(std::string_view text) noexcept {
  constexpr std::size_t kLongestEnd = 2;
  return text.substr(0, std::min(text.find_first_of("\r\n"), text.size()) + kLongestEnd);
}

class HeaderParser {
 public:
  HeaderParser(std::string_view text, const std::string& name)
      : lines_(text, line_end_of(first_line(text))), name_(name) {}

  Result<PlyHeader> parse();

 private:
  Result<void> statement(std::string_view line);
  Result<void> format(std::string_view rest);
  Result<void> element(std::string_view rest);
  Result<void> property(std::string_view rest);
  Result<Scalar> scalar(std::string_view& rest);
  Error fail(const std::string& message) const {
    return line_error(name_, lines_.number(), message);
  }

  LineScan lines_;
  const std::string& name_;
  PlyHeader header_;
  bool has_format_ = false;
};

Result<void> HeaderParser::format(std::string_view rest) {
  const std::string_view token = take_token(rest);
  if (token == "ascii") {
    header_.format = Format::ascii;
  } else if (token == "binary_little_endian") {
    header_.format = Format::little;
  } else if (token == "binary_big_endian") {
    header_.format = Format::big;
  } else {
    return fail("unknown format " + in_quotes(token) +
                "; use ascii, binary_little_endian or binary_big_endian");
  }
  has_format_ = true;
  return {};
}

Result<void> HeaderParser::element(std::string_view rest) {
  Element element;
  element.name = take_token(rest);
  const std::string_view count = take_token(rest);
  if (!read_integer(count, element.count) || element.count < 0) {
    return fail("element " + in_quotes(element.name) + " has the count " + in_quotes(count) +
                "; it must be a whole number, 0 or more");
  }
  header_.elements.push_back(std::move(element));
  return {};
}

Result<Scalar> HeaderParser::scalar(std::string_view& rest) {
  const std::string_view token = take_token(rest);
  const std::optional<Scalar> type = scalar_named(token);
  if (!type) return fail("unknown property type " + in_quotes(token));
  return *type;
}

/// "property TYPE NAME" or "property list COUNT_TYPE TYPE NAME".
Result<void> HeaderParser::property(std::string_view rest) {
  if (header_.elements.empty()) return fail("a property comes before the first element");
  Property property;
  std::string_view probe = rest;
  if (take_token(probe) == "list") {
    rest = probe;
    const Result<Scalar> count = scalar(rest);
    if (!count) return count.error();
    if (!is_integer(count.value())) return fail("a list is counted by a number that is not whole");
    property.count_type = count.value();
  }
  const Result<Scalar> type = scalar(rest);
  if (!type) return type.error();
  property.type = type.value();
  property.name = take_token(rest);
  if (property.name.empty()) return fail("a property has no name");
  header_.elements.back().properties.push_back(std::move(property));
  return {};
}

Result<void> HeaderParser::statement(std::string_view line) {
  const std::string_view keyword = take_token(line);
  if (keyword == "format") return format(line);
  if (keyword == "element") return element(line);
  if (keyword == "property") return property(line);
  if (keyword == "comment" || keyword == "obj_info" || keyword.empty()) return {};
  // Some programs forget the word "comment". Damage to a line that matters shows in the body.
  if (header_.stray.empty()) {
    header_.stray = "line " + std::to_string(lines_.number()) + ", " + in_quotes(keyword) + "...";
  }
  return {};
}

Result<PlyHeader> HeaderParser::parse() {
  std::string_view line;
  if (!lines_.next(line) || only_word(line) != "ply") return fail("the first line must be 'ply'");
  while (lines_.next(line)) {
    if (only_word(line) == "end_header") {
      if (!has_format_) return fail("the header names no format");
      // A binary body begins right behind the line end, which may be one byte or two.
      header_.body_byte = lines_.end_of_line();
      return std::move(header_);
    }
    if (Result<void> read = statement(line); !read) return read.error();
  }
  return fail("the header does not end; the file is cut off, export it again");
}

/// The values after the header, one after the other, whatever the format.
class Body {
 public:
  Body(std::span<const std::byte> bytes, std::size_t start, Format format)
      : bytes_(bytes), at_(start), format_(format) {}

  /// The next value; false at the end of the data or when it is not a number of this type.
  bool read(Scalar type, double& value);

  bool ascii() const noexcept { return format_ == Format::ascii; }
  std::size_t byte() const noexcept { return at_; }
  /// Bytes a value takes at least, for judging what a header promises.
  std::size_t least_bytes(Scalar type) const noexcept { return ascii() ? 1 : bytes_of(type); }
  std::size_t remaining() const noexcept { return bytes_.size() - at_; }
  bool only_blanks_left();

 private:
  bool read_text(Scalar type, double& value);
  std::span<const std::byte> bytes_;
  std::size_t at_;
  Format format_;
};

template <class T>
double from_bytes(const std::array<std::byte, 8>& raw) noexcept {
  T value;
  std::memcpy(&value, raw.data(), sizeof value);
  return static_cast<double>(value);
}

double decode(Scalar type, const std::array<std::byte, 8>& raw) noexcept {
  switch (type) {
    case Scalar::i8:
      return from_bytes<std::int8_t>(raw);
    case Scalar::u8:
      return from_bytes<std::uint8_t>(raw);
    case Scalar::i16:
      return from_bytes<std::int16_t>(raw);
    case Scalar::u16:
      return from_bytes<std::uint16_t>(raw);
    case Scalar::i32:
      return from_bytes<std::int32_t>(raw);
    case Scalar::u32:
      return from_bytes<std::uint32_t>(raw);
    case Scalar::f32:
      return from_bytes<float>(raw);
    case Scalar::f64:
      break;
  }
  return from_bytes<double>(raw);
}

/// An integer type says that the number must be whole, not how it is spelt: 3.0 is taken too.
bool Body::read_text(Scalar type, double& value) {
  std::string_view rest = as_text(bytes_.subspan(at_));
  const std::string_view token = take_token(rest);
  at_ = bytes_.size() - rest.size();
  if (!read_number(token, value)) return false;
  if (!is_integer(type)) return true;
  constexpr double kExact = 9e15;  // whole numbers up to here are doubles
  return std::abs(value) < kExact && value == std::trunc(value);
}

bool Body::read(Scalar type, double& value) {
  if (ascii()) return read_text(type, value);
  const std::size_t size = bytes_of(type);
  if (remaining() < size) return false;
  std::array<std::byte, 8> raw{};
  std::memcpy(raw.data(), bytes_.data() + at_, size);
  // The machine is little-endian (stl_read.cpp asserts it).
  if (format_ == Format::big) std::reverse(raw.data(), raw.data() + size);
  value = decode(type, raw);
  at_ += size;
  return true;
}

bool Body::only_blanks_left() {
  std::string_view rest = as_text(bytes_.subspan(at_));
  return ascii() ? take_token(rest).empty() : rest.empty();
}

class PlyParser {
 public:
  PlyParser(std::span<const std::byte> bytes, const PlyHeader& header, const std::string& name)
      : body_(bytes, header.body_byte, header.format), header_(header), name_(name) {}

  Result<TriangleMesh> parse();

 private:
  enum class Use { skip, x, y, z, corners, strips };
  static Use use_of(const Element& element, const Property& property) noexcept;
  bool could_hold(const Element& element) const noexcept;
  Result<void> element(const Element& element);
  Result<void> record(const Element& element, const std::vector<Use>& uses);
  Result<void> scalar(const Element& element, const Property& property, Use use);
  Result<void> list(const Element& element, const Property& property, Use use);
  Result<void> add_face();
  Result<void> add_strips();
  Result<void> add_to_faces(const char* what, const std::vector<std::int64_t>& corners);
  Error unreadable(const Element& element, const Property& property);
  Error fail(std::size_t byte, const std::string& message) const {
    const std::string& stray = header_.stray;
    return byte_error(name_, byte,
                      stray.empty() ? message : message + " (header " + stray + " is not known)");
  }

  Body body_;
  const PlyHeader& header_;
  const std::string& name_;
  TriangleMesh mesh_;
  FaceCollector faces_;
  std::vector<std::int64_t> corners_;
  Vec3 point_;
  std::int64_t index_ = 0;  ///< of the record within its element
  std::size_t record_byte_ = 0;
};

PlyParser::Use PlyParser::use_of(const Element& element, const Property& property) noexcept {
  const bool list = property.count_type.has_value();
  if (element.name == "vertex" && !list) {
    if (property.name == "x") return Use::x;
    if (property.name == "y") return Use::y;
    if (property.name == "z") return Use::z;
  }
  if (list && is_integer(property.type) &&
      (property.name == "vertex_indices" || property.name == "vertex_index")) {
    if (element.name == "face") return Use::corners;
    if (element.name == "tristrips") return Use::strips;
  }
  return Use::skip;
}

Error PlyParser::unreadable(const Element& element, const Property& property) {
  const std::string where = "of " + element.name + " " + std::to_string(index_ + 1) + " of " +
                            std::to_string(element.count);
  if (body_.only_blanks_left() || !body_.ascii()) {
    return fail(body_.byte(), "the data ends at '" + property.name + "' " + where +
                                  "; the file is cut off or its header lies, export it again");
  }
  return fail(body_.byte(), "'" + property.name + "' " + where +
                                " is not a number of its type; export the file again");
}

Result<void> PlyParser::scalar(const Element& element, const Property& property, Use use) {
  double value = 0.0;
  if (!body_.read(property.type, value)) return unreadable(element, property);
  if (use != Use::skip) point_[static_cast<std::size_t>(use) - 1] = value;
  return {};
}

Result<void> PlyParser::list(const Element& element, const Property& property, Use use) {
  double count = 0.0;
  if (!body_.read(*property.count_type, count)) return unreadable(element, property);
  if (count < 0.0) return fail(record_byte_, "a list has a negative length");
  corners_.clear();
  for (double i = 0.0; i < count; ++i) {
    double value = 0.0;
    if (!body_.read(property.type, value)) return unreadable(element, property);
    if (use != Use::skip) corners_.push_back(static_cast<std::int64_t>(value));
  }
  if (use == Use::strips) return add_strips();
  return use == Use::corners ? add_face() : Result<void>{};
}

Result<void> PlyParser::add_face() {
  if (corners_.size() < 3) {
    return fail(record_byte_, "face " + std::to_string(index_ + 1) + " has " +
                                  std::to_string(corners_.size()) + " corners; it needs three");
  }
  return add_to_faces("face ", corners_);
}

Result<void> PlyParser::add_to_faces(const char* what, const std::vector<std::int64_t>& corners) {
  const std::string problem = faces_.add(corners, record_byte_);
  if (problem.empty()) return {};
  return fail(record_byte_, what + std::to_string(index_ + 1) + ": " + problem);
}

/// Each further vertex makes a triangle with the two before it, every other one turned over; -1
/// begins a new strip, and triangles of no area lead to another place (Stanford's ply files).
Result<void> PlyParser::add_strips() {
  constexpr std::int64_t kUnsignedRestart = 0xffffffff;
  std::vector<std::int64_t> triangle;
  std::size_t begin = 0;
  for (std::size_t n = 0; n < corners_.size(); ++n) {
    if (corners_[n] == -1 || corners_[n] == kUnsignedRestart) {
      begin = n + 1;
      continue;
    }
    if (n < begin + 2) continue;
    const bool turned = (n - begin) % 2 != 0;
    const std::int64_t a = corners_[turned ? n - 1 : n - 2];
    const std::int64_t b = corners_[turned ? n - 2 : n - 1];
    const std::int64_t c = corners_[n];
    if (a == b || b == c || c == a) continue;
    triangle.assign({a, b, c});
    if (Result<void> added = add_to_faces("strips ", triangle); !added) return added;
  }
  return {};
}

Result<void> PlyParser::record(const Element& element, const std::vector<Use>& uses) {
  record_byte_ = body_.byte();
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const Property& property = element.properties[i];
    Result<void> read =
        property.count_type ? list(element, property, uses[i]) : scalar(element, property, uses[i]);
    if (!read) return read;
  }
  if (element.name != "vertex") return {};
  if (!is_in_reach(point_)) {
    return fail(record_byte_, position_problem(point_, " of vertex " + std::to_string(index_ + 1)));
  }
  mesh_.positions.push_back(point_);
  return {};
}

/// Whether the bytes left could hold what the header promises; without this a count of 10^18
/// records of no bytes at all would keep us busy for ever.
bool PlyParser::could_hold(const Element& element) const noexcept {
  std::size_t least = 0;
  for (const Property& property : element.properties) {
    least += body_.least_bytes(property.count_type.value_or(property.type));
  }
  return least == 0 || static_cast<std::uint64_t>(element.count) <= body_.remaining() / least;
}

Result<void> PlyParser::element(const Element& element) {
  if (element.properties.empty()) return {};
  if (!could_hold(element)) {
    return fail(body_.byte(), "the header promises " + std::to_string(element.count) + " of '" +
                                  element.name + "', more than the " +
                                  std::to_string(body_.remaining()) +
                                  " bytes left can hold; the file is cut off or its header lies");
  }
  std::vector<Use> uses;
  for (const Property& property : element.properties) uses.push_back(use_of(element, property));
  for (const Use axis : {Use::x, Use::y, Use::z}) {
    if (element.name == "vertex" && std::find(uses.begin(), uses.end(), axis) == uses.end()) {
      return fail(body_.byte(), "the vertices have no x, y and z; export them as numbers so named");
    }
  }
  for (index_ = 0; index_ < element.count; ++index_) {
    if (Result<void> read = record(element, uses); !read) return read;
  }
  return {};
}

Result<TriangleMesh> PlyParser::parse() {
  for (const Element& one : header_.elements) {
    if (Result<void> read = element(one); !read) return read.error();
  }
  if (!body_.only_blanks_left()) {
    return fail(body_.byte(), "there is more data than the header promises; export the file again");
  }
  if (faces_.highest() < 0) return no_triangles(name_);
  if (faces_.highest() >= static_cast<std::int64_t>(mesh_.positions.size())) {
    return fail(faces_.highest_position(),
                "a face names vertex " + std::to_string(faces_.highest()) + " (from 0) of only " +
                    std::to_string(mesh_.positions.size()) + "; export the file again");
  }
  mesh_.triangles = faces_.take(mesh_.positions);
  return std::move(mesh_);
}

}  // namespace

Result<TriangleMesh> parse_ply(std::span<const std::byte> bytes, const std::string& name) {
  const Result<PlyHeader> header = HeaderParser(as_text(bytes), name).parse();
  if (!header) return header.error();
  return PlyParser(bytes, header.value(), name).parse();
}

}  // namespace argil::io
