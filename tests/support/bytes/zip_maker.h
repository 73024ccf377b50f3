// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <zlib.h>

namespace argil::test {

/// One entry as it shall stand in an archive, truly or not.
struct PackedEntry {
  std::string name;
  std::string packed;
  std::uint32_t bytes = 0;
  std::uint32_t crc = 0;
  unsigned method = 8;
};

inline std::uint32_t crc_of(const std::string& text) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(text.data()), text.size()));
}

inline PackedEntry stored(const std::string& name, const std::string& text) {
  return {name, text, static_cast<std::uint32_t>(text.size()), crc_of(text), 0};
}

inline std::string little_endian(std::uint64_t value, std::size_t bytes) {
  std::string text;
  for (std::size_t k = 0; k < bytes; ++k) text += static_cast<char>(value >> (8 * k) & 255U);
  return text;
}

/// With `all_at_first`, every entry of the directory begins where the first does.
inline std::string zip_of(const std::vector<PackedEntry>& entries, bool all_at_first = false) {
  std::string archive;
  std::string directory;
  for (const PackedEntry& entry : entries) {
    const std::string same = little_endian(0, 2) + little_endian(entry.method, 2) +
                             little_endian(0, 4) + little_endian(entry.crc, 4) +
                             little_endian(entry.packed.size(), 4) + little_endian(entry.bytes, 4) +
                             little_endian(entry.name.size(), 2) + little_endian(0, 2);
    directory += "PK\x01\x02" + little_endian(20, 2) + little_endian(20, 2) + same +
                 std::string(10, '\0') + little_endian(all_at_first ? 0 : archive.size(), 4) +
                 entry.name;
    archive += "PK\x03\x04" + little_endian(20, 2) + same + entry.name + entry.packed;
  }
  return archive + directory + "PK\x05\x06" + std::string(4, '\0') +
         little_endian(entries.size(), 2) + little_endian(entries.size(), 2) +
         little_endian(directory.size(), 4) + little_endian(archive.size(), 4) +
         std::string(2, '\0');
}

/// Of a 3MF whose model is 3D/a.model.
inline PackedEntry relations() {
  return stored("_rels/.rels",
                R"(<Relationships><Relationship Type="a/3dmodel" Target="/3D/a.model"/>)"
                "</Relationships>");
}

}  // namespace argil::test
