// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "argil/core/triangle_mesh.h"
#include "argil/core/vec3.h"

namespace argil::haptics {

// The stream that shows clay to a simulator: messages one after the other over TCP, in addition to
// the datagrams of bridge_message.h. Numbers are little-endian, floating-point numbers binary32 in
// blocks and binary64 elsewhere, and there is no padding. Frame and units are the clay's: mm, z up.
// examples/blender/argil_clay.py is the other side's copy of this layout.
//
// All begin with 24 bytes: magic u32, version u16, kind u16, size u32 (of the whole message), zero
// u32, sequence u64 (of the update of the clay that it belongs to).

inline constexpr std::uint32_t kMeshMagic = 0x43475241;  ///< "ARGC"
inline constexpr std::uint16_t kMeshVersion = 2;

enum class MeshKind : std::uint16_t { ask = 1, place = 2, block = 3, mark = 4, end = 5, note = 6 };

inline constexpr std::size_t kMeshHeaderBytes = 24;
inline constexpr std::size_t kMeshAskBytes = 24;
inline constexpr std::size_t kMeshPlaceBytes = 88;
inline constexpr std::size_t kMeshBlockBytes = 48;  ///< of a block with nothing in it
inline constexpr std::size_t kMeshVertexBytes = 24;
inline constexpr std::size_t kMeshTriangleBytes = 12;
inline constexpr std::size_t kMeshMarkBytes = 48;
inline constexpr std::size_t kMeshEndBytes = 24;
inline constexpr std::size_t kMeshNoteBytes = 48;  ///< of a note without words

inline constexpr std::size_t kMostMeshText = 1024;  ///< of a note, bytes

/// The most that a block may hold; the cells of one leaf have far less.
inline constexpr std::uint32_t kMostMeshVertices = 1U << 16;
inline constexpr std::uint32_t kMostMeshTriangles = 1U << 17;
inline constexpr std::size_t kMeshMostBytes = kMeshBlockBytes +
                                              kMeshVertexBytes * kMostMeshVertices +
                                              kMeshTriangleBytes * kMostMeshTriangles;
inline constexpr std::int32_t kMostMeshLevel = 31;

/// The name of a block for as long as it exists: a level of the clay and the origin of a leaf
/// there, its lowest node. Level L has nodes 2^L times as far apart as level 0.
struct MeshBlockId {
  std::int32_t level = 0;  ///< 0 to kMostMeshLevel
  std::array<std::int32_t, 3> origin{};
  friend auto operator<=>(const MeshBlockId&, const MeshBlockId&) = default;
};

/// Reader to bridge, first and only: asks for the clay.
struct MeshAsk {
  /// A random number, so that no answer can be an old one.
  std::uint64_t sequence = 0;
  friend bool operator==(const MeshAsk&, const MeshAsk&) = default;
};

/// Bridge to reader, first: how the device is placed in the clay. A handle at (x, y, z) of the
/// device is the tool at offset_mm + scale (x, -z, y) of the clay: the device's y is up, and the
/// clay's z.
struct MeshPlace {
  std::uint64_t sequence = 0;
  /// mm of the clay for a mm of the hand; > 0.
  double scale = 1.0;
  Vec3 offset_mm;
  /// Between nodes of level 0; > 0.
  double voxel_mm = 0.25;
  /// Half the tool's extent along the clay's axes; each > 0.
  Vec3 tool_mm{1.0, 1.0, 1.0};
  friend bool operator==(const MeshPlace&, const MeshPlace&) = default;
};

/// Bridge to reader: the surface in one block, which replaces what that block held. Without
/// triangles the block is gone.
struct MeshBlock {
  std::uint64_t sequence = 0;
  MeshBlockId id;
  /// Where blocks meet they agree on theirs, bit by bit.
  std::vector<std::array<float, 3>> positions_mm;
  /// One for each position; unit length, outward.
  std::vector<std::array<float, 3>> normals;
  /// Counter-clockwise seen from outside.
  std::vector<Triangle> triangles;
  friend bool operator==(const MeshBlock&, const MeshBlock&) = default;
};

/// Bridge to reader: what the reader holds now is the closed surface of the clay after this update,
/// of so many blocks, vertices and triangles.
struct MeshMark {
  std::uint64_t sequence = 0;
  std::uint64_t blocks = 0;
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  friend bool operator==(const MeshMark&, const MeshMark&) = default;
};

/// Bridge to reader, last: the program ends.
struct MeshEnd {
  std::uint64_t sequence = 0;
  friend bool operator==(const MeshEnd&, const MeshEnd&) = default;
};

/// Bridge to reader: what became of the strokes so far, whenever that changes.
struct MeshNote {
  std::uint64_t sequence = 0;
  /// Strokes that are on the disk.
  std::uint64_t kept = 0;
  /// Strokes that were taken back because they could not be written.
  std::uint64_t refused = 0;
  /// UTF-8: why strokes are refused now, and the remedy; "": they are not refused.
  std::string text;
  friend bool operator==(const MeshNote&, const MeshNote&) = default;
};

using MeshMessage = std::variant<MeshAsk, MeshPlace, MeshBlock, MeshMark, MeshEnd, MeshNote>;

/// A message as it is sent. Blocks and notes must keep within their limits, and a block must have a
/// normal for each position.
///
/// Threads  any; allocates.
std::vector<std::byte> encode(const MeshMessage& message);

/// How long the message is whose first bytes these are; nothing when they are not the first
/// kMeshHeaderBytes of one.
///
/// Threads  any; no allocation.
std::optional<std::size_t> mesh_message_bytes(std::span<const std::byte> head) noexcept;

/// A whole message of exactly that length. Nothing when it is malformed: another magic or version,
/// an unknown kind, a wrong size, a number that is not finite or beyond 1e6, a triangle of vertices
/// that do not exist. The text of a note is taken as it is.
///
/// Threads  any; allocates.
std::optional<MeshMessage> decode_mesh(std::span<const std::byte> bytes);

}  // namespace argil::haptics
