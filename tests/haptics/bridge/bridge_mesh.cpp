// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/bridge/bridge_mesh.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/fuzz.h"

namespace argil::haptics {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::byte>;

/// The corpus was written by the layout of examples/blender/argil_clay.py.
const fs::path kMeshCorpus = "tests/corpus/bridge_mesh";

Bytes bytes_of_text(const std::string& text) {
  Bytes bytes(text.size());
  std::transform(text.begin(), text.end(), bytes.begin(),
                 [](char c) { return static_cast<std::byte>(c); });
  return bytes;
}

/// In a block of just that size, so that a sanitizer sees one byte over.
std::optional<MeshMessage> decode_mesh_exactly(const Bytes& bytes) {
  const auto block = std::make_unique<std::byte[]>(bytes.size());
  std::copy(bytes.begin(), bytes.end(), block.get());
  return decode_mesh({block.get(), bytes.size()});
}

std::vector<MeshMessage> one_mesh_message_of_each() {
  MeshBlock block;
  block.sequence = 7;
  block.id = {2, {-8, 16, -24}};
  block.positions_mm = {{1.0F, 2.0F, 3.0F}, {1.5F, 2.0F, 3.0F}, {1.0F, 2.5F, 3.25F}};
  block.normals = {{0.0F, 0.0F, 1.0F}, {0.0F, 0.6F, 0.8F}, {1.0F, 0.0F, 0.0F}};
  block.triangles = {{0, 1, 2}};
  MeshBlock gone;
  gone.sequence = 8;
  gone.id = {0, {8, 0, -8}};
  return {MeshAsk{},
          MeshPlace{0, 2.5, {1.0, -2.0, 30.5}, 0.25, {4.0, 4.0, 2.0}},
          block,
          gone,
          MeshMark{8, 1, 3, 1},
          MeshEnd{8},
          MeshNote{8, 3, 1, "the disk is full"}};
}
constexpr const char* kMeshNames[] = {"ask", "place", "block", "gone", "mark", "end", "note"};
constexpr std::size_t kMeshSizes[] = {kMeshAskBytes,
                                      kMeshPlaceBytes,
                                      kMeshBlockBytes + 3 * kMeshVertexBytes + kMeshTriangleBytes,
                                      kMeshBlockBytes,
                                      kMeshMarkBytes,
                                      kMeshEndBytes,
                                      kMeshNoteBytes + 16};

TEST(BridgeMesh, HasTheSameBytesInPythonAndHere) {
  const auto messages = one_mesh_message_of_each();
  for (std::size_t n = 0; n < messages.size(); ++n) {
    const Bytes theirs =
        bytes_of_text(test::content_of(kMeshCorpus / (std::string(kMeshNames[n]) + ".bin")));
    const Bytes ours = encode(messages[n]);
    ASSERT_EQ(ours.size(), kMeshSizes[n]) << kMeshNames[n];
    EXPECT_EQ(ours, theirs) << kMeshNames[n];
    EXPECT_EQ(mesh_message_bytes(theirs), ours.size()) << kMeshNames[n];
    const auto read = decode_mesh_exactly(theirs);
    ASSERT_TRUE(read.has_value()) << kMeshNames[n];
    EXPECT_EQ(*read, messages[n]) << kMeshNames[n];
  }
}

TEST(BridgeMesh, RefusesEveryTruncationAndEveryLongerMessage) {
  for (const MeshMessage& message : one_mesh_message_of_each()) {
    const Bytes whole = encode(message);
    for (std::size_t size = 0; size < whole.size(); ++size) {
      EXPECT_FALSE(decode_mesh_exactly({whole.begin(), whole.begin() + static_cast<long>(size)}));
    }
    Bytes longer = whole;
    longer.push_back(std::byte{0});
    EXPECT_FALSE(decode_mesh_exactly(longer));
  }
}

TEST(BridgeMesh, RefusesWhatTheCorpusCallsMalformed) {
  int seen = 0;
  for (const auto& entry : fs::directory_iterator(kMeshCorpus)) {
    if (!entry.path().filename().string().starts_with("malformed_")) continue;
    EXPECT_FALSE(decode_mesh_exactly(bytes_of_text(test::content_of(entry.path()))))
        << entry.path();
    ++seen;
  }
  EXPECT_GE(seen, 10);
}

bool is_sound(float number) { return std::abs(number) <= 1e6F; }

/// What is taken is sound, and says the same when it is sent on.
void expect_sound_mesh(const Bytes& bytes) {
  const auto read = decode_mesh_exactly(bytes);
  if (!read) return;
  if (const auto* block = std::get_if<MeshBlock>(&*read)) {
    ASSERT_EQ(block->normals.size(), block->positions_mm.size());
    for (const auto& position : block->positions_mm) {
      ASSERT_TRUE(std::ranges::all_of(position, is_sound));
    }
    for (const Triangle& triangle : block->triangles) {
      ASSERT_LT(*std::ranges::max_element(triangle), block->positions_mm.size());
    }
  }
  EXPECT_EQ(encode(*read), bytes);
}

TEST(BridgeMeshProperty, TakesNothingUnsoundFromMutatedMessages) {
  test::Fuzzer fuzzer("bridge_mesh");
  const auto inputs = test::fuzz_for(
      fuzzer, 1.0, [](const std::string& input) { expect_sound_mesh(bytes_of_text(input)); });
  RecordProperty("inputs", static_cast<int>(inputs));
  EXPECT_GT(inputs, 1000U);
}

}  // namespace
}  // namespace argil::haptics
