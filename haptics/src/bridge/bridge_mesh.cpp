// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/bridge/bridge_mesh.h"

#include <algorithm>
#include <cassert>

#include "bridge/wire_fields.h"

namespace argil::haptics {
namespace {

constexpr double kMostMeshNumber = 1e6;

MeshKind kind_of(const MeshAsk&) noexcept { return MeshKind::ask; }
MeshKind kind_of(const MeshPlace&) noexcept { return MeshKind::place; }
MeshKind kind_of(const MeshBlock&) noexcept { return MeshKind::block; }
MeshKind kind_of(const MeshMark&) noexcept { return MeshKind::mark; }
MeshKind kind_of(const MeshEnd&) noexcept { return MeshKind::end; }
MeshKind kind_of(const MeshNote&) noexcept { return MeshKind::note; }

/// The length of a kind; of blocks and notes the least.
std::size_t least_bytes(MeshKind kind) noexcept {
  switch (kind) {
    case MeshKind::ask:
      return kMeshAskBytes;
    case MeshKind::place:
      return kMeshPlaceBytes;
    case MeshKind::block:
      return kMeshBlockBytes;
    case MeshKind::mark:
      return kMeshMarkBytes;
    case MeshKind::note:
      return kMeshNoteBytes;
    case MeshKind::end:
      break;
  }
  return kMeshEndBytes;
}

std::size_t block_bytes(std::size_t vertices, std::size_t triangles) noexcept {
  return kMeshBlockBytes + kMeshVertexBytes * vertices + kMeshTriangleBytes * triangles;
}

// The layout, once for both directions.
template <class Stream, class Triples>
void triples(Stream& stream, Triples& all) {
  for (auto& one : all) {
    for (auto& number : one) stream.field(number);
  }
}

struct Head {
  std::uint32_t magic = kMeshMagic;
  std::uint16_t version = kMeshVersion;
  std::uint16_t kind = 0;
  std::uint32_t size = 0;
  std::uint32_t zero = 0;
  std::uint64_t sequence = 0;
};
template <class Stream, class Of>
void fields(Stream& stream, Of& head) {
  stream.field(head.magic);
  stream.field(head.version);
  stream.field(head.kind);
  stream.field(head.size);
  stream.field(head.zero);
  stream.field(head.sequence);
}

template <class Stream>
void mesh_body(Stream&, MeshAsk&) {}
template <class Stream>
void mesh_body(Stream& stream, MeshPlace& place) {
  stream.field(place.scale);
  field(stream, place.offset_mm);
  stream.field(place.voxel_mm);
  field(stream, place.tool_mm);
}
/// The counts tell the length of the rest: whoever reads has made room for it.
template <class Stream>
void block_head(Stream& stream, MeshBlockId& id, std::uint32_t& vertices,
                std::uint32_t& triangles) {
  stream.field(id.level);
  for (std::int32_t& node : id.origin) stream.field(node);
  stream.field(vertices);
  stream.field(triangles);
}
template <class Stream>
void mesh_body(Stream& stream, MeshBlock& block) {
  auto vertices = static_cast<std::uint32_t>(block.positions_mm.size());
  auto count = static_cast<std::uint32_t>(block.triangles.size());
  block_head(stream, block.id, vertices, count);
  triples(stream, block.positions_mm);
  triples(stream, block.normals);
  triples(stream, block.triangles);
}
template <class Stream>
void mesh_body(Stream& stream, MeshMark& mark) {
  stream.field(mark.blocks);
  stream.field(mark.vertices);
  stream.field(mark.triangles);
}
template <class Stream>
void mesh_body(Stream&, MeshEnd&) {}
/// The length of the text is that of the rest.
template <class Stream>
void note_head(Stream& stream, MeshNote& note, std::uint64_t& length) {
  stream.field(note.kept);
  stream.field(note.refused);
  stream.field(length);
}
template <class Stream>
void mesh_body(Stream& stream, MeshNote& note) {
  std::uint64_t length = note.text.size();
  note_head(stream, note, length);
  stream.text(note.text);
}

bool is_sound_mesh(const MeshPlace& place) noexcept {
  const Vec3& tool = place.tool_mm;
  return std::min({place.scale, place.voxel_mm, tool.x, tool.y, tool.z}) > 0.0;
}
bool is_sound_mesh(const MeshBlock& block) noexcept {
  const auto count = block.positions_mm.size();
  return block.id.level >= 0 && block.id.level <= kMostMeshLevel &&
         std::ranges::all_of(block.triangles, [&](const Triangle& triangle) {
           return std::ranges::all_of(triangle, [&](std::uint32_t n) { return n < count; });
         });
}
template <class Other>
bool is_sound_mesh(const Other&) noexcept {
  return true;
}

/// Makes room for what a block says that it holds; false when its length does not fit that.
bool make_room(std::span<const std::byte> bytes, MeshBlock& block) {
  FieldReader reader(bytes.subspan(kMeshHeaderBytes), kMostMeshNumber);
  std::uint32_t vertices = 0;
  std::uint32_t triangles = 0;
  block_head(reader, block.id, vertices, triangles);
  if (vertices > kMostMeshVertices || triangles > kMostMeshTriangles) return false;
  if (bytes.size() != block_bytes(vertices, triangles)) return false;
  block.positions_mm.resize(vertices);
  block.normals.resize(vertices);
  block.triangles.resize(triangles);
  return true;
}
bool make_room(std::span<const std::byte> bytes, MeshNote& note) {
  FieldReader reader(bytes.subspan(kMeshHeaderBytes), kMostMeshNumber);
  std::uint64_t length = 0;
  note_head(reader, note, length);
  if (length > kMostMeshText || bytes.size() != kMeshNoteBytes + length) return false;
  note.text.resize(length);
  return true;
}
template <class Other>
bool make_room(std::span<const std::byte>, Other&) {
  return true;
}

template <class Message>
std::optional<MeshMessage> read_mesh(std::span<const std::byte> bytes) {
  Message message;
  if (!make_room(bytes, message)) return std::nullopt;
  FieldReader reader(bytes, kMostMeshNumber);
  Head head;
  fields(reader, head);
  message.sequence = head.sequence;
  mesh_body(reader, message);
  if (!reader.is_good() || !is_sound_mesh(message)) return std::nullopt;
  return message;
}

}  // namespace

std::vector<std::byte> encode(const MeshMessage& message) {
  return std::visit(
      [](auto copy) {
        Head head;
        head.kind = static_cast<std::uint16_t>(kind_of(copy));
        head.sequence = copy.sequence;
        std::size_t bytes = least_bytes(kind_of(copy));
        if constexpr (std::is_same_v<decltype(copy), MeshBlock>) {
          assert(copy.normals.size() == copy.positions_mm.size());
          assert(copy.positions_mm.size() <= kMostMeshVertices);
          assert(copy.triangles.size() <= kMostMeshTriangles);
          bytes = block_bytes(copy.positions_mm.size(), copy.triangles.size());
        }
        if constexpr (std::is_same_v<decltype(copy), MeshNote>) {
          assert(copy.text.size() <= kMostMeshText);
          bytes += copy.text.size();
        }
        head.size = static_cast<std::uint32_t>(bytes);
        std::vector<std::byte> out(bytes);
        FieldWriter writer(out);
        fields(writer, head);
        assert(writer.size() == kMeshHeaderBytes);
        mesh_body(writer, copy);
        assert(writer.size() == bytes);
        return out;
      },
      message);
}

std::optional<std::size_t> mesh_message_bytes(std::span<const std::byte> bytes) noexcept {
  if (bytes.size() < kMeshHeaderBytes) return std::nullopt;
  FieldReader reader(bytes, kMostMeshNumber);
  Head head;
  fields(reader, head);
  if (head.magic != kMeshMagic || head.version != kMeshVersion || head.zero != 0) {
    return std::nullopt;
  }
  if (head.kind < static_cast<std::uint16_t>(MeshKind::ask) ||
      head.kind > static_cast<std::uint16_t>(MeshKind::note)) {
    return std::nullopt;
  }
  const auto kind = static_cast<MeshKind>(head.kind);
  const std::size_t least = least_bytes(kind);
  const std::size_t most = kind == MeshKind::block  ? kMeshMostBytes
                           : kind == MeshKind::note ? kMeshNoteBytes + kMostMeshText
                                                    : least;
  if (head.size < least || head.size > most) return std::nullopt;
  return head.size;
}

std::optional<MeshMessage> decode_mesh(std::span<const std::byte> bytes) {
  const auto size = mesh_message_bytes(bytes);
  if (!size || *size != bytes.size()) return std::nullopt;
  FieldReader reader(bytes, kMostMeshNumber);
  Head head;
  fields(reader, head);
  switch (static_cast<MeshKind>(head.kind)) {
    case MeshKind::ask:
      return read_mesh<MeshAsk>(bytes);
    case MeshKind::place:
      return read_mesh<MeshPlace>(bytes);
    case MeshKind::block:
      return read_mesh<MeshBlock>(bytes);
    case MeshKind::mark:
      return read_mesh<MeshMark>(bytes);
    case MeshKind::note:
      return read_mesh<MeshNote>(bytes);
    case MeshKind::end:
      break;
  }
  return read_mesh<MeshEnd>(bytes);
}

}  // namespace argil::haptics
