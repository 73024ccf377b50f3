// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "argil/core/result.h"
#include "argil/core/vec3.h"

#include "file/unwritten_bytes.h"
#include "format/json_read.h"
#include "mesh_format/mesh_read.h"

namespace argil::io {

/// A whole number of 0 or more, also spelt 3.0, as JSON allows; else throws what Json::at would.
std::size_t whole_number(const Json& value);
std::size_t whole_number(const Json& object, const char* name, std::size_t otherwise);

/// The list of this name, which an object may have. Throws as Json::at where it is no list.
const Json::array_t& list_in(const Json& object, const char* name);

/// What one accessor names: `count` values of `parts` numbers each, `stride` bytes apart, some of
/// which a sparse list may replace. Views the buffers of its document.
class GltfValues {
 public:
  // Component types have OpenGL's numbers.
  static constexpr int kUnsignedByte = 5121;
  static constexpr int kUnsignedShort = 5123;
  static constexpr int kUnsignedInt = 5125;
  static constexpr int kFloat = 5126;

  std::size_t count() const noexcept { return count_; }
  int type() const noexcept { return type_; }
  /// Whether every value has bytes of its own; otherwise those that no sparse list gives are 0.
  bool has_bytes() const noexcept { return first_ != nullptr; }

  /// A number of value `n`, below count(); integers that say so are made fractions of their range.
  double number(std::size_t n, std::size_t part) const noexcept;
  /// The same of unsigned integers, as they are.
  std::uint32_t index(std::size_t n, std::size_t part = 0) const noexcept;
  Vec3 vec3(std::size_t n) const noexcept;

 private:
  friend class GltfDocument;
  const std::byte* at(std::size_t n, std::size_t part) const noexcept;

  const std::byte* first_ = nullptr;
  std::size_t count_ = 0;
  std::size_t stride_ = 0;
  std::size_t size_ = 0;  ///< of one value
  int type_ = 0;
  bool is_normalized_ = false;
  std::vector<std::uint32_t> replaced_;  ///< ascending
  const std::byte* replacing_ = nullptr;
};

/// glTF 2.0 as GLB or as text, with the buffers that it holds or names.
class GltfDocument {
 public:
  GltfDocument(const std::string& name, const ReadBeside& beside) : name_(name), beside_(beside) {}

  /// Errors  bad_input naming what cannot be read: another version, compressed meshes and other
  ///         required extensions by name, a file cut off, not JSON.
  Result<void> open_glb(std::span<const std::byte> bytes);
  Result<void> open_text(std::string_view text);

  const Json& json() const noexcept { return json_; }
  Error bad(const std::string& what) const { return {ErrorKind::bad_input, name_ + ": " + what}; }

  /// The values of accessor `index`, of this shape ("VEC3") with so many `parts`. Throws
  /// Json::exception where the JSON is not as it should be.
  Result<GltfValues> values(std::size_t index, const char* shape, std::size_t parts);

 private:
  Result<void> understood() const;
  Error no_data(const std::string& where) const;
  Result<std::span<const std::byte>> buffer(std::size_t index);
  Result<std::span<const std::byte>> load_buffer(std::size_t index, const std::string& uri);
  Result<std::span<const std::byte>> view(std::size_t index, const std::string& where);
  Result<void> add_sparse(const Json& sparse, const std::string& where, GltfValues& values);

  const std::string& name_;
  const ReadBeside& beside_;
  Json json_;
  std::span<const std::byte> binary_;             ///< of the GLB
  std::map<std::size_t, UnwrittenBytes> loaded_;  ///< buffers that are not in the GLB
};

}  // namespace argil::io
