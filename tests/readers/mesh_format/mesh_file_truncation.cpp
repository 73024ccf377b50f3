// SPDX-License-Identifier: GPL-3.0-or-later
// Every format, cut at every length: nothing may crash, read past the end, or pass for whole.
#include <algorithm>
#include <cstring>
#include <functional>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "argil/io/mesh_file.h"

#include "mesh_format/mesh_read.h"
#include "support/mesh_samples.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace argil::io {
namespace {

using test::MeshSample;

/// Parses `text` from a heap block of exactly its size, so that AddressSanitizer sees one byte
/// over.
Result<TriangleMesh> parse_exactly(const MeshSample& sample, std::string_view text) {
  const std::unique_ptr<std::byte[]> block(new std::byte[text.size()]);
  std::copy_n(reinterpret_cast<const std::byte*>(text.data()), text.size(), block.get());
  return sample.parse({block.get(), text.size()}, sample.name);
}

class MeshTruncation : public testing::TestWithParam<MeshSample> {};

TEST_P(MeshTruncation, IsRefusedOrGivesAnHonestPart) {
  const MeshSample& sample = GetParam();
  const Result<TriangleMesh> whole = parse_exactly(sample, sample.bytes);
  ASSERT_TRUE(whole) << whole.error().message;
  for (std::size_t length = 0; length < sample.bytes.size(); ++length) {
    const Result<TriangleMesh> part = parse_exactly(sample, sample.bytes.substr(0, length));
    if (!part) {
      EXPECT_EQ(part.error().kind, ErrorKind::bad_input) << length;
      EXPECT_EQ(part.error().message.rfind(sample.name, 0), 0U) << part.error().message;
      continue;
    }
    EXPECT_TRUE(sample.may_pass_cut(length)) << length << " of " << sample.bytes.size();
    for (const Triangle& t : part.value().triangles) {
      ASSERT_LT(std::max({t[0], t[1], t[2]}), part.value().positions.size());
    }
  }
}

TEST_P(MeshTruncation, EveryFlippedByteIsReadWithoutHarm) {
  const MeshSample& sample = GetParam();
  std::string bytes = sample.bytes;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    for (const char flip : {'\x01', '\x80', '\xff'}) {
      bytes[at] = static_cast<char>(bytes[at] ^ flip);
      const Result<TriangleMesh> read = parse_exactly(sample, bytes);
      if (read) {
        for (const Triangle& t : read.value().triangles) {
          ASSERT_LT(std::max({t[0], t[1], t[2]}), read.value().positions.size());
        }
      }
      bytes[at] = static_cast<char>(bytes[at] ^ flip);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Format, MeshTruncation, testing::ValuesIn(test::mesh_samples()),
                         [](const auto& sample) { return sample.param.id; });

}  // namespace
}  // namespace argil::io
