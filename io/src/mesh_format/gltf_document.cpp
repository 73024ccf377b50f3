// SPDX-License-Identifier: GPL-3.0-or-later
// Khronos, glTF 2.0 specification: chapters 3.6 (buffers, accessors) and 4 (GLB).
#include "mesh_format/gltf_document.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include "file/load_bytes.h"
#include "format/text_scan.h"

namespace argil::io {
namespace {

constexpr std::uint32_t kGlbMagic = 0x46546c67;  // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4e4f534a;
constexpr std::uint32_t kBinaryChunk = 0x004e4942;
constexpr int kSignedByte = 5120;
constexpr int kSignedShort = 5122;

std::size_t bytes_of_component(int type) noexcept {
  switch (type) {
    case kSignedByte:
    case GltfValues::kUnsignedByte:
      return 1;
    case kSignedShort:
    case GltfValues::kUnsignedShort:
      return 2;
    case GltfValues::kUnsignedInt:
    case GltfValues::kFloat:
      return 4;
    default:
      return 0;
  }
}

bool mentions(const std::string& text, std::string_view part) noexcept {
  return text.find(part) != std::string::npos;
}

/// Extensions that pack meshes: KHR_draco_mesh_compression, EXT_meshopt_compression and their like.
bool is_compression(const std::string& extension) noexcept {
  return mentions(extension, "_compression");
}

/// Extensions that change how a scene looks or moves, but not where its triangles are, and the one
/// that allows positions of integers.
bool leaves_shape(const std::string& extension) noexcept {
  constexpr std::array<std::string_view, 9> kHarmless{
      "material",  "texture",   "light",
      "technique", "animation", "xmp",
      "metadata",  "audio",     "KHR_mesh_quantization"};
  return std::any_of(kHarmless.begin(), kHarmless.end(),
                     [&](std::string_view part) { return mentions(extension, part); });
}

std::string compressed(const std::string& extension) {
  return "its meshes are compressed by " + extension +
         ", which is not read here; export without compression";
}

std::string other_version(const std::string& version) {
  return "glTF version " + version + "; must be 2.0: export again with a newer program";
}

std::optional<unsigned> base64_digit(char c) noexcept {
  if (c >= 'A' && c <= 'Z') return static_cast<unsigned>(c - 'A');
  if (c >= 'a' && c <= 'z') return static_cast<unsigned>(c - 'a' + 26);
  if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0' + 52);
  if (c == '+' || c == '-') return 62;
  if (c == '/' || c == '_') return 63;
  return std::nullopt;
}

/// RFC 4648, with either alphabet and with or without the padding; nothing where it is damaged.
std::optional<UnwrittenBytes> base64(std::string_view text) {
  while (text.ends_with('=')) text.remove_suffix(1);
  UnwrittenBytes bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  unsigned bits = 0;
  int count = 0;
  for (const char c : text) {
    const std::optional<unsigned> digit = base64_digit(c);
    if (!digit) return std::nullopt;
    bits = (bits << 6U | *digit) & 0xffffU;
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<std::byte>(bits >> static_cast<unsigned>(count) & 0xffU));
  }
  return bytes;
}

/// A file's name as a URI spells it: %20 for a blank.
std::string percent_decoded(std::string_view uri) {
  const auto hex = [](char c) -> int {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
  };
  std::string text;
  for (std::size_t n = 0; n < uri.size(); ++n) {
    const int high = uri[n] == '%' && n + 2 < uri.size() ? hex(uri[n + 1]) : -1;
    const int low = high >= 0 ? hex(uri[n + 2]) : -1;
    if (low < 0) {
      text += uri[n];
      continue;
    }
    text += static_cast<char>(16 * high + low);
    n += 2;
  }
  return text;
}

/// Whether a name stays in its folder or one below: others might be devices, or anybody's files.
bool is_beside(const std::string& file) {
  const std::filesystem::path path(file);
  return !file.empty() && file.find('\0') == std::string::npos && !mentions(file, ":") &&
         path.is_relative() && std::find(path.begin(), path.end(), "..") == path.end();
}

}  // namespace

std::size_t whole_number(const Json& value) {
  constexpr double kExact = 9e15;  // whole numbers up to here are doubles
  if (value.is_number_float()) {
    const double number = value.get<double>();
    if (number >= 0.0 && number < kExact && number == std::trunc(number)) {
      return static_cast<std::size_t>(number);
    }
  }
  if (value.is_number_unsigned()) return value.get<std::size_t>();
  constexpr int kWrongType = 302;  // nlohmann's number for it
  throw Json::type_error::create(
      kWrongType, "must be a whole number of 0 or more, but is " + shown(value), &value);
}

std::size_t whole_number(const Json& object, const char* name, std::size_t otherwise) {
  const auto found = object.find(name);
  return found == object.end() ? otherwise : whole_number(*found);
}

const Json::array_t& list_in(const Json& object, const char* name) {
  static const Json::array_t kNoItems;
  const auto found = object.find(name);
  return found == object.end() ? kNoItems : found->get_ref<const Json::array_t&>();
}

const std::byte* GltfValues::at(std::size_t n, std::size_t part) const noexcept {
  assert(n < count_);
  const std::size_t offset = part * bytes_of_component(type_);
  if (!replaced_.empty()) {
    const auto found = std::lower_bound(replaced_.begin(), replaced_.end(), n);
    if (found != replaced_.end() && *found == n) {
      return replacing_ + static_cast<std::size_t>(found - replaced_.begin()) * size_ + offset;
    }
  }
  return first_ == nullptr ? nullptr : first_ + n * stride_ + offset;
}

double GltfValues::number(std::size_t n, std::size_t part) const noexcept {
  const std::byte* const bytes = at(n, part);
  if (bytes == nullptr) return 0.0;
  const auto scaled = [&](double value, double most) {
    return is_normalized_ ? std::max(value / most, -1.0) : value;
  };
  switch (type_) {
    case kSignedByte:
      return scaled(load<std::int8_t>(bytes), 127.0);
    case kUnsignedByte:
      return scaled(load<std::uint8_t>(bytes), 255.0);
    case kSignedShort:
      return scaled(load<std::int16_t>(bytes), 32767.0);
    case kUnsignedShort:
      return scaled(load<std::uint16_t>(bytes), 65535.0);
    case kUnsignedInt:
      return load<std::uint32_t>(bytes);
    default:
      return double{load<float>(bytes)};
  }
}

std::uint32_t GltfValues::index(std::size_t n, std::size_t part) const noexcept {
  const std::byte* const bytes = at(n, part);
  if (bytes == nullptr) return 0;
  if (type_ == kUnsignedByte) return load<std::uint8_t>(bytes);
  return type_ == kUnsignedShort ? load<std::uint16_t>(bytes) : load<std::uint32_t>(bytes);
}

Vec3 GltfValues::vec3(std::size_t n) const noexcept {
  if (type_ != kFloat || first_ == nullptr || !replaced_.empty()) {
    return {number(n, 0), number(n, 1), number(n, 2)};
  }
  const auto p = load<std::array<float, 3>>(first_ + n * stride_);
  return {double{p[0]}, double{p[1]}, double{p[2]}};
}

Result<void> GltfDocument::open_glb(std::span<const std::byte> bytes) {
  if (bytes.size() < 20 || load<std::uint32_t>(bytes.data()) != kGlbMagic) {
    return bad("byte 0: not a binary glTF file; export as GLB");
  }
  const auto version = load<std::uint32_t>(bytes.data() + 4);
  if (version != 2) {
    return bad("byte 4: " + other_version(std::to_string(version)));
  }
  const std::size_t whole = load<std::uint32_t>(bytes.data() + 8);
  if (whole != bytes.size()) {
    return bad("byte 8: the header says " + std::to_string(whole) + " bytes, but the file has " +
               std::to_string(bytes.size()) + "; it is truncated");
  }
  std::size_t at = 12;
  while (at + 8 <= bytes.size()) {
    const std::size_t size = load<std::uint32_t>(bytes.data() + at);
    const auto kind = load<std::uint32_t>(bytes.data() + at + 4);
    if (size > bytes.size() - at - 8) {
      return bad("byte " + std::to_string(at) + ": a chunk of " + std::to_string(size) +
                 " bytes goes beyond the end; the file is truncated");
    }
    const auto body = bytes.subspan(at + 8, size);
    // Chunks of other kinds are to be skipped, by the specification.
    if (kind == kJsonChunk && json_.is_null()) {
      auto read = read_json_object(as_text(body), name_ + ": byte " + std::to_string(at + 8));
      if (!read) return read.error();
      json_ = std::move(read).value();
    }
    if (kind == kBinaryChunk && binary_.empty()) binary_ = body;
    at += 8 + size;
  }
  if (json_.is_null()) return bad("byte 12: no chunk holds its JSON; export it again");
  return understood();
}

Result<void> GltfDocument::open_text(std::string_view text) {
  auto read = read_json_object(text, name_);
  if (!read) return read.error();
  json_ = std::move(read).value();
  return understood();
}

/// Whether a reader of glTF 2.0 without extensions can read it.
Result<void> GltfDocument::understood() const {
  const Json asset = json_.value("asset", Json::object());
  const Json version = asset.value("version", Json("2.0"));
  const Json least = asset.value("minVersion", Json("2.0"));
  // Of version 1 the lists are objects, and the version may be missing.
  const auto meshes = json_.find("meshes");
  if (meshes != json_.end() && meshes->is_object()) return bad(other_version("1.0"));
  if (!version.is_string() || !version.get_ref<const std::string&>().starts_with("2.")) {
    return bad(other_version(shown(version)));
  }
  if (least != "2.0") return bad(other_version(shown(least)));
  for (const Json& item : list_in(json_, "extensionsRequired")) {
    const auto& extension = item.get_ref<const std::string&>();
    if (is_compression(extension)) return bad(compressed(extension));
    if (leaves_shape(extension)) continue;
    return bad("it requires the extension " + in_quotes(extension) +
               ", which is not read here; export without it");
  }
  return {};
}

/// Of bytes that are in no file: what packs meshes leaves them out.
Error GltfDocument::no_data(const std::string& where) const {
  for (const Json& extension : list_in(json_, "extensionsUsed")) {
    const auto& used = extension.get_ref<const std::string&>();
    if (is_compression(used)) return bad(compressed(used));
  }
  return bad(where + " has no data; export without compression");
}

Result<std::span<const std::byte>> GltfDocument::buffer(std::size_t index) {
  if (const auto known = loaded_.find(index); known != loaded_.end()) {
    return std::span<const std::byte>(known->second);
  }
  const bool has_list = json_.contains("buffers");
  // A GLB's own chunk needs no entry in the list.
  if (index == 0 && !has_list && !binary_.empty()) return binary_;
  const Json& entry = json_.at("buffers").at(index);
  const auto uri = entry.find("uri");
  if (uri != entry.end()) return load_buffer(index, uri->get_ref<const std::string&>());
  if (index == 0 && !binary_.empty()) return binary_;
  return no_data("buffer " + std::to_string(index));
}

Result<std::span<const std::byte>> GltfDocument::load_buffer(std::size_t index,
                                                             const std::string& uri) {
  const std::string where = "buffer " + std::to_string(index);
  constexpr std::string_view kData = "data:";
  constexpr std::string_view kBase64 = ";base64,";
  if (uri.starts_with(kData)) {
    const std::size_t mark = uri.find(kBase64);
    auto bytes = mark == std::string::npos
                     ? std::nullopt
                     : base64(std::string_view(uri).substr(mark + kBase64.size()));
    if (!bytes) return bad(where + " is not encoded in base64; export it again");
    return std::span<const std::byte>(loaded_[index] = std::move(*bytes));
  }
  const std::string file = percent_decoded(uri);
  if (!beside_ || !is_beside(file)) {
    return bad(where + " is in another file, " + in_quotes(file) +
               ", that is not in its folder; export as one GLB");
  }
  auto bytes = beside_(file);
  if (!bytes && bytes.error().kind == ErrorKind::disk) {
    return bad(where + " is in another file: " + bytes.error().message);
  }
  if (!bytes) return bytes.error();
  return std::span<const std::byte>(loaded_[index] = std::move(bytes).value());
}

/// The bytes of a buffer view, without regard to strides.
Result<std::span<const std::byte>> GltfDocument::view(std::size_t index, const std::string& where) {
  const Json& view = json_.at("bufferViews").at(index);
  const auto all = buffer(whole_number(view, "buffer", 0));
  if (!all) return all.error();
  const std::size_t start = whole_number(view, "byteOffset", 0);
  const std::size_t length = whole_number(view.at("byteLength"));
  // Each step compares with what is left, since a sum of numbers from a file may overflow.
  if (start > all.value().size() || length > all.value().size() - start) {
    return bad(where + " goes beyond its data; the file is truncated");
  }
  return all.value().subspan(start, length);
}

Result<void> GltfDocument::add_sparse(const Json& sparse, const std::string& where,
                                      GltfValues& values) {
  const std::size_t count = whole_number(sparse.at("count"));
  const Json& which = sparse.at("indices");
  GltfValues indices;
  indices.type_ = static_cast<int>(whole_number(which.at("componentType")));
  indices.stride_ = bytes_of_component(indices.type_);
  const bool is_index = indices.type_ == GltfValues::kUnsignedByte ||
                        indices.type_ == GltfValues::kUnsignedShort ||
                        indices.type_ == GltfValues::kUnsignedInt;
  const auto numbers = view(whole_number(which.at("bufferView")), where);
  if (!numbers) return numbers.error();
  const auto bytes = view(whole_number(sparse.at("values").at("bufferView")), where);
  if (!bytes) return bytes.error();
  const std::size_t first = whole_number(which, "byteOffset", 0);
  const std::size_t from = whole_number(sparse.at("values"), "byteOffset", 0);
  if (!is_index || first > numbers.value().size() || from > bytes.value().size() ||
      count > (numbers.value().size() - first) / indices.stride_ ||
      count > (bytes.value().size() - from) / values.size_) {
    return bad(where + " has a sparse list that goes beyond its data; the file is truncated");
  }
  indices.first_ = numbers.value().data() + first;
  indices.count_ = count;
  values.replacing_ = bytes.value().data() + from;
  for (std::size_t n = 0; n < count; ++n) {
    const std::uint32_t next = indices.index(n);
    if (next >= values.count_ || (n > 0 && next <= values.replaced_.back())) {
      return bad(where + " has a sparse list that names value " + std::to_string(next) +
                 " out of order or beyond its " + std::to_string(values.count_) +
                 "; export it again");
    }
    values.replaced_.push_back(next);
  }
  return {};
}

Result<GltfValues> GltfDocument::values(std::size_t index, const char* shape, std::size_t parts) {
  const Json& accessor = json_.at("accessors").at(index);
  const std::string where = "accessor " + std::to_string(index);
  GltfValues values;
  values.type_ = static_cast<int>(whole_number(accessor.at("componentType")));
  values.count_ = whole_number(accessor.at("count"));
  values.is_normalized_ = accessor.value("normalized", false);
  values.size_ = parts * bytes_of_component(values.type_);
  if (accessor.at("type") != shape || values.size_ == 0) {
    return bad(where + " is not a list of " + shape + "; export it again");
  }
  const auto sparse = accessor.find("sparse");
  const auto place = accessor.find("bufferView");
  if (place == accessor.end() && sparse == accessor.end()) return no_data(where);
  if (place != accessor.end()) {
    const std::size_t number = whole_number(*place);
    const auto bytes = view(number, where);
    if (!bytes) return bytes.error();
    const std::size_t length = bytes.value().size();
    const std::size_t offset = whole_number(accessor, "byteOffset", 0);
    values.stride_ = whole_number(json_.at("bufferViews").at(number), "byteStride", values.size_);
    const bool is_inside =
        offset <= length && values.stride_ >= values.size_ &&
        (values.count_ == 0 ||
         (values.size_ <= length - offset &&
          values.count_ - 1 <= (length - offset - values.size_) / values.stride_));
    if (!is_inside) return bad(where + " goes beyond its data; the file is truncated");
    values.first_ = bytes.value().data() + offset;
  }
  if (sparse == accessor.end()) return values;
  if (auto added = add_sparse(*sparse, where, values); !added) return added.error();
  return values;
}

}  // namespace argil::io
