// SPDX-License-Identifier: GPL-3.0-or-later
#include "gl/gl_blocks.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "gl/coarse_block.h"
#include "gl/gl_state.h"

namespace argil::viewer {
namespace {

// A page takes 6 MB of vertices and 5 of triangles, which blocks of clay fill alike: 20 million
// triangles are some 60 pages. The first two are smaller, so that a thousand small pieces need no
// more than a few large ones.
constexpr std::uint32_t kPageVertices = 1U << 18;
constexpr std::uint32_t kPageTriangles = 3U << 17;

/// Up to so many triangles that were not chosen are drawn between two ranges rather than end one:
/// both cost a software renderer about the same.
constexpr std::uint32_t kMostBetween = 256;

constexpr std::int64_t kVertexBytes = sizeof(DisplayVertex);
constexpr std::int64_t kTriangleBytes = sizeof(Triangle);
static_assert(kVertexBytes == 24 && kTriangleBytes == 12);

std::uint32_t room_for(std::size_t things) {
  constexpr std::uint32_t kStep = GlBlocks::kRoomStep;
  assert(things <= std::numeric_limits<std::uint32_t>::max() - kStep);
  return (static_cast<std::uint32_t>(things) + kStep - 1) / kStep * kStep;
}

/// Reserves a buffer's memory. Errors memory.
Result<void> reserve(unsigned target, const GlBuffer& buffer, std::int64_t bytes) {
  assert(bytes > 0);
  // Errors of before are not those of this call.
  while (glGetError() != GL_NO_ERROR) {
  }
  glBindBuffer(target, buffer.name());
  glBufferData(target, bytes, nullptr, GL_DYNAMIC_DRAW);
  if (glGetError() == GL_NO_ERROR) return {};
  return Error{ErrorKind::memory,
               "the graphics card has no room for " + std::to_string(bytes) +
                   " bytes more of the clay's surface; show it coarser or close other programs"};
}

/// Describes positions, normals and indices to the vertex array that is bound.
void bind_vertices(const GlBuffer& vertices, const GlBuffer& triangles) {
  glBindBuffer(GL_ARRAY_BUFFER, vertices.name());
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, kVertexBytes, buffer_offset(0));
  glEnableVertexAttribArray(1);
  glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, kVertexBytes, buffer_offset(12));
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, triangles.name());
}

Vec3 vec_of(const std::array<float, 3>& p) noexcept {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

/// Whether a box lies wholly on the outer side of one plane.
bool is_outside(const std::array<float, 3>& center, const std::array<float, 3>& half,
                std::span<const BoundPlane> bounds) {
  for (const BoundPlane& plane : bounds) {
    double reach = plane.offset;
    for (std::size_t a = 0; a < 3; ++a) {
      reach += plane.normal[a] * static_cast<double>(center[a]) +
               std::abs(plane.normal[a]) * static_cast<double>(half[a]);
    }
    if (reach < 0.0) return true;
  }
  return false;
}

bool is_box_outside(const Box3& box, std::span<const BoundPlane> bounds) {
  if (box.empty()) return true;
  const Vec3 center = box.center();
  const Vec3 half = 0.5 * box.size();
  std::array<float, 3> middle{};
  std::array<float, 3> reach{};
  for (std::size_t a = 0; a < 3; ++a) {
    middle[a] = static_cast<float>(center[a]);
    // Rounded outward: no block within may reach out of it.
    reach[a] = static_cast<float>(half[a] + 1e-6 * (std::abs(center[a]) + half[a]));
  }
  return is_outside(middle, reach, bounds);
}

/// Whether a lens sees all triangles of a block from behind. Source: the cone test of meshoptimizer
/// (meshopt_computeClusterBounds), about the box's middle. A cone that is almost seen from the side
/// is kept: facing is worked out in float.
bool is_turned_away(const NormalCone& cone, const std::array<float, 3>& center,
                    const std::array<float, 3>& half, const Lens& lens) {
  constexpr double kMargin = 1e-3;
  if (cone.sine > 1.0F) return false;
  const Vec3 axis = vec_of(cone.axis);
  if (lens.is_parallel) return dot(-lens.back, axis) >= static_cast<double>(cone.sine) + kMargin;
  const Vec3 away = vec_of(center) - lens.eye_mm;
  return dot(away, axis) >=
         (static_cast<double>(cone.sine) + kMargin) * length(away) + length(vec_of(half));
}

}  // namespace

NormalCone cone_of(std::span<const DisplayVertex> vertices,
                   std::initializer_list<std::span<const Triangle>> triangles) {
  std::vector<Vec3> normals;
  Vec3 sum;
  for (const std::span<const Triangle> some : triangles) {
    for (const Triangle& triangle : some) {
      const Vec3 a = vec_of(vertices[triangle[0]].position_mm);
      const Vec3 b = vec_of(vertices[triangle[1]].position_mm);
      const Vec3 c = vec_of(vertices[triangle[2]].position_mm);
      const Vec3 across = cross(b - a, c - a);
      const double size = length(across);
      if (!(size > 0.0)) continue;  // without an area it is not seen from any side
      normals.push_back(across / size);
      sum += normals.back();
    }
  }
  NormalCone cone;
  const Vec3 axis = normalized(sum);
  double least = 1.0;
  for (const Vec3& normal : normals) least = std::min(least, dot(axis, normal));
  constexpr double kLeastCosine = 0.1;  // a wider cone is hardly ever turned away
  if (normals.empty() || !(least > kLeastCosine)) return cone;
  cone.axis = {static_cast<float>(axis.x), static_cast<float>(axis.y), static_cast<float>(axis.z)};
  cone.sine = static_cast<float>(std::sqrt(std::max(0.0, 1.0 - least * least)));
  return cone;
}

std::size_t GlBlocks::IdHash::operator()(const BlockId& id) const noexcept {
  auto hash = static_cast<std::uint64_t>(id.level);
  for (const std::int32_t c : id.origin) {
    hash = (hash ^ static_cast<std::uint32_t>(c)) * 0x9E3779B97F4A7C15ULL;
    hash ^= hash >> 29;
  }
  return hash;
}

Result<void> GlBlocks::put(const BlockMesh& block) {
  assert(block.id.level >= 0);
  assert(block.mask.empty() || block.mask.size() == block.vertices.size());
  if (block.triangles.empty()) {
    drop(block.id);
    return {};
  }
  const std::vector<Triangle> coarse =
      has_coarse_ ? coarse_triangles(block) : std::vector<Triangle>();
  const auto location = location_for(block, coarse);
  if (!location) return location.error();
  Page& page = *location.value().page;
  Slot& slot = page.slots[location.value().slot];
  slot.has_mask = !block.mask.empty();
  if (slot.has_mask && !page.mask.is_there()) {
    if (auto added = add_mask(page); !added) {
      drop(block.id);
      return added;
    }
  }
  // A slot may be one of before, whose triangles are replaced.
  triangles_ -= slot.ranges[kFine].count;
  slot.ranges[kFine].count = static_cast<std::uint32_t>(block.triangles.size());
  slot.ranges[kCoarse].count = static_cast<std::uint32_t>(coarse.size());
  triangles_ += slot.ranges[kFine].count;
  const Vec3 center = block.bounds_mm.center();
  const Vec3 half = 0.5 * block.bounds_mm.size();
  reach_mm_.include(block.bounds_mm.min);
  reach_mm_.include(block.bounds_mm.max);
  for (std::size_t a = 0; a < 3; ++a) {
    slot.center_mm[a] = static_cast<float>(center[a]);
    slot.half_mm[a] = static_cast<float>(half[a]);
  }
  slot.cone = cone_of(block.vertices, {block.triangles, coarse});
  upload(page, slot, block, coarse);
  return {};
}

std::optional<Box3> GlBlocks::bounds_of(const BlockId& id) const {
  const auto known = locations_.find(id);
  if (known == locations_.end()) return std::nullopt;
  const Slot& slot = known->second.page->slots[known->second.slot];
  const Vec3 center = vec_of(slot.center_mm);
  const Vec3 half = vec_of(slot.half_mm);
  return Box3{center - half, center + half};
}

/// The block's slot, with room for it.
Result<GlBlocks::Location> GlBlocks::location_for(const BlockMesh& block,
                                                  std::span<const Triangle> coarse) {
  Slot slot;
  slot.id = block.id;
  slot.vertex_room = room_for(block.vertices.size());
  slot.ranges[kFine].room = room_for(block.triangles.size());
  slot.ranges[kCoarse].room = room_for(coarse.size());
  if (const auto known = locations_.find(block.id); known != locations_.end()) {
    const Slot& former = known->second.page->slots[known->second.slot];
    if (former.vertex_room == slot.vertex_room &&
        former.ranges[kFine].room == slot.ranges[kFine].room &&
        former.ranges[kCoarse].room == slot.ranges[kCoarse].room) {
      return known->second;
    }
    drop(block.id);
  }
  const auto found = page_with_room(slot);
  if (!found) return found.error();
  Page& page = *found.value();
  slot.first_vertex = *page.vertex_gaps.take(slot.vertex_room);
  for (const Detail detail : {kFine, kCoarse}) {
    Range& range = slot.ranges[detail];
    if (range.room > 0) range.first = *page.faces[detail].gaps.take(range.room);
    page.faces[detail].order.clear();
  }
  const Location location{&page, page.slots.size()};
  page.slots.push_back(slot);
  locations_.emplace(block.id, location);
  return location;
}

/// The first page with room for all of a block, or a new one, which is larger for a block that no
/// page holds.
Result<GlBlocks::Page*> GlBlocks::page_with_room(const Slot& slot) {
  const auto fits = [&](const Page& page) {
    return page.vertex_gaps.longest() >= slot.vertex_room &&
           page.faces[kFine].gaps.longest() >= slot.ranges[kFine].room &&
           page.faces[kCoarse].gaps.longest() >= slot.ranges[kCoarse].room;
  };
  for (const auto& page : pages_) {
    if (fits(*page)) return page.get();
  }
  const unsigned smaller = pages_.empty() ? 4 : pages_.size() == 1 ? 2 : 0;
  auto page = std::make_unique<Page>(std::max(slot.vertex_room, kPageVertices >> smaller),
                                     std::max(slot.ranges[kFine].room, kPageTriangles >> smaller));
  page->vertices = GlBuffer(count_);
  const std::int64_t vertex_bytes = page->vertex_gaps.size() * kVertexBytes;
  if (auto done = reserve(GL_ARRAY_BUFFER, page->vertices, vertex_bytes); !done)
    return done.error();
  memory_bytes_ += vertex_bytes;
  for (const Detail detail : {kFine, kCoarse}) {
    if (detail == kCoarse && !has_coarse_) continue;
    if (auto done = add_faces(*page, page->faces[detail]); !done) {
      memory_bytes_ -= bytes_of(*page);
      return done.error();
    }
  }
  pages_.push_back(std::move(page));
  return pages_.back().get();
}

/// Reserves an index buffer. The binding of indices is part of a vertex array's state.
Result<void> GlBlocks::add_faces(Page& page, Faces& faces) {
  faces.triangles = GlBuffer(count_);
  faces.layout = GlVertexArray(count_);
  const std::int64_t bytes = faces.gaps.size() * kTriangleBytes;
  glBindVertexArray(faces.layout.name());
  if (auto done = reserve(GL_ELEMENT_ARRAY_BUFFER, faces.triangles, bytes); !done) return done;
  memory_bytes_ += bytes;
  bind_vertices(page.vertices, faces.triangles);
  return {};
}

/// What its buffers take.
std::int64_t GlBlocks::bytes_of(const Page& page) {
  std::int64_t bytes = page.vertex_gaps.size() * (kVertexBytes + (page.mask.is_there() ? 1 : 0));
  for (const Faces& faces : page.faces) {
    if (faces.layout.is_there()) bytes += faces.gaps.size() * kTriangleBytes;
  }
  return bytes;
}

/// A page's mask costs a byte a vertex, which a clay without a mask does not pay.
Result<void> GlBlocks::add_mask(Page& page) {
  GlBuffer mask(count_);
  if (auto done = reserve(GL_ARRAY_BUFFER, mask, page.vertex_gaps.size()); !done) return done;
  memory_bytes_ += page.vertex_gaps.size();
  page.mask = std::move(mask);
  for (Faces& faces : page.faces) {
    if (!faces.layout.is_there()) continue;
    faces.masked_layout = GlVertexArray(count_);
    glBindVertexArray(faces.masked_layout.name());
    bind_vertices(page.vertices, faces.triangles);
    glBindBuffer(GL_ARRAY_BUFFER, page.mask.name());
    glEnableVertexAttribArray(2);
    glVertexAttribPointer(2, 1, GL_UNSIGNED_BYTE, GL_TRUE, 1, buffer_offset(0));
  }
  return {};
}

void GlBlocks::upload(Page& page, const Slot& slot, const BlockMesh& block,
                      std::span<const Triangle> coarse) {
  const auto send = [this](unsigned target, std::int64_t at, std::int64_t bytes, const void* from) {
    glBufferSubData(target, at, bytes, from);
    uploaded_bytes_ += bytes;
  };
  const auto vertices = static_cast<std::int64_t>(block.vertices.size());
  assert(vertices <= slot.vertex_room);
  glBindBuffer(GL_ARRAY_BUFFER, page.vertices.name());
  send(GL_ARRAY_BUFFER, slot.first_vertex * kVertexBytes, vertices * kVertexBytes,
       block.vertices.data());
  for (const Detail detail : {kFine, kCoarse}) {
    const Range& range = slot.ranges[detail];
    if (range.room == 0) continue;
    // The rest of the room has no area: it is drawn with the block behind it.
    sent_.assign(range.room, {slot.first_vertex, slot.first_vertex, slot.first_vertex});
    const std::span<const Triangle> from = detail == kFine ? block.triangles : coarse;
    assert(from.size() <= sent_.size());
    for (std::size_t n = 0; n < from.size(); ++n) {
      for (std::size_t c = 0; c < 3; ++c) sent_[n][c] = slot.first_vertex + from[n][c];
    }
    glBindVertexArray(page.faces[detail].layout.name());
    send(GL_ELEMENT_ARRAY_BUFFER, range.first * kTriangleBytes, range.room * kTriangleBytes,
         sent_.data());
  }
  if (!slot.has_mask) return;
  glBindBuffer(GL_ARRAY_BUFFER, page.mask.name());
  send(GL_ARRAY_BUFFER, slot.first_vertex, vertices, block.mask.data());
}

void GlBlocks::drop(const BlockId& id) {
  const auto known = locations_.find(id);
  if (known == locations_.end()) return;
  const auto [page, at] = known->second;
  locations_.erase(known);
  const Slot slot = page->slots[at];
  page->vertex_gaps.give(slot.first_vertex, slot.vertex_room);
  for (const Detail detail : {kFine, kCoarse}) {
    const Range& range = slot.ranges[detail];
    if (range.room > 0) page->faces[detail].gaps.give(range.first, range.room);
    page->faces[detail].order.clear();
  }
  triangles_ -= slot.ranges[kFine].count;
  assert(at < page->slots.size());
  // The last slot fills the gap, so that a page is walked without holes.
  if (at + 1 < page->slots.size()) {
    page->slots[at] = page->slots.back();
    locations_.at(page->slots[at].id).slot = at;
  }
  page->slots.pop_back();
  // An empty page is given back, so that a smaller clay takes less of the card.
  if (!page->slots.empty()) return;
  memory_bytes_ -= bytes_of(*page);
  std::erase_if(pages_, [page = page](const auto& other) { return other.get() == page; });
}

void GlBlocks::clear() {
  pages_.clear();
  locations_.clear();
  reach_mm_ = {};
  triangles_ = 0;
  memory_bytes_ = 0;
}

std::int64_t GlBlocks::choose(const BlockChoice& choice) {
  chosen_ = choice.is_coarse && has_coarse_ ? kCoarse : kFine;
  // Of many pieces most lie beside the area that a dab touched.
  if (is_box_outside(reach_mm_, choice.bounds)) {
    for (const auto& page : pages_) choose_none(*page);
    return 0;
  }
  std::int64_t triangles = 0;
  for (const auto& page : pages_) triangles += choose_in(*page, choice);
  return triangles;
}

/// The slots as their triangles lie in a buffer; those that have none there lie nowhere.
const std::vector<std::size_t>& GlBlocks::order_of(Page& page, Detail detail) {
  std::vector<std::size_t>& order = page.faces[detail].order;
  if (!order.empty()) return order;
  for (std::size_t n = 0; n < page.slots.size(); ++n) {
    if (page.slots[n].ranges[detail].room > 0) order.push_back(n);
  }
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return page.slots[a].ranges[detail].first < page.slots[b].ranges[detail].first;
  });
  return order;
}

/// The vectors keep their memory from frame to frame.
void GlBlocks::choose_none(Page& page) {
  for (Batch& batch : page.batches) {
    batch.counts.clear();
    batch.offsets.clear();
  }
}

std::int64_t GlBlocks::choose_in(Page& page, const BlockChoice& choice) {
  choose_none(page);
  std::int64_t triangles = 0;
  // The end of the last range that was chosen, of the slots behind it, and its batch.
  std::uint32_t end = 0;
  std::uint32_t reach = 0;
  std::size_t number = std::numeric_limits<std::size_t>::max();
  for (const std::size_t n : order_of(page, chosen_)) {
    const Slot& slot = page.slots[n];
    const Range& range = slot.ranges[chosen_];
    const bool is_hidden =
        is_outside(slot.center_mm, slot.half_mm, choice.bounds) ||
        (choice.outside_of != nullptr &&
         is_turned_away(slot.cone, slot.center_mm, slot.half_mm, *choice.outside_of));
    const bool goes_on = range.first == reach && slot.batch() == number;
    if (is_hidden) {
      // A gap, or what belongs to another call, ends a range.
      if (goes_on) reach += range.room;
      continue;
    }
    triangles += range.count;
    if (goes_on && range.first - end <= kMostBetween) {
      page.batches[number].counts.back() += static_cast<int>(3 * (range.first + range.room - end));
    } else {
      number = slot.batch();
      if (number >= page.batches.size()) page.batches.resize(number + 1);
      page.batches[number].counts.push_back(static_cast<int>(3 * range.room));
      page.batches[number].offsets.push_back(buffer_offset(range.first * kTriangleBytes));
    }
    end = reach = range.first + range.room;
  }
  return triangles;
}

void GlBlocks::draw(const std::function<void(int level)>& begin) const {
  // Level after level over all pages, so that the caller sets a level's uniforms once.
  std::size_t most = 0;
  for (const auto& page : pages_) most = std::max(most, page->batches.size());
  for (std::size_t number = 0; number < most; ++number) {
    bool has_begun = false;
    for (const auto& page : pages_) {
      if (number >= page->batches.size() || page->batches[number].counts.empty()) continue;
      if (!has_begun) begin(static_cast<int>(number / 2));
      has_begun = true;
      const Batch& batch = page->batches[number];
      const Faces& faces = page->faces[chosen_];
      glBindVertexArray(number % 2 == 0 ? faces.layout.name() : faces.masked_layout.name());
      glMultiDrawElements(GL_TRIANGLES, batch.counts.data(), GL_UNSIGNED_INT, batch.offsets.data(),
                          static_cast<GLsizei>(batch.counts.size()));
    }
  }
}

}  // namespace argil::viewer
