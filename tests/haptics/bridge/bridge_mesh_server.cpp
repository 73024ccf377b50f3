// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/bridge/bridge_mesh_server.h"

#include <array>
#include <bit>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "haptics/bridge/mesh_reader.h"
#include "support/effort.h"

namespace argil::haptics {
namespace {

using scenes::MeshReader;

const MeshPlace kPlace{0, 2.0, {1.0, 2.0, 3.0}, 0.25, {4.0, 4.0, 4.0}};

std::unique_ptr<BridgeMeshServer> opened() {
  auto server = BridgeMeshServer::open({kLoopbackHost, 0}, scenes::test_key(), kPlace);
  EXPECT_TRUE(server.ok());
  return server ? std::move(server).value() : nullptr;
}

/// A block whose content tells which version of it this is.
MeshBlock block_of(std::int32_t number, float version, std::size_t vertices = 3) {
  MeshBlock block;
  block.id = {0, {8 * number, 0, 0}};
  block.positions_mm.assign(vertices, {version, static_cast<float>(number), 0.0F});
  block.normals.assign(vertices, {0.0F, 0.0F, 1.0F});
  block.triangles = {{0, 1, 2}};
  return block;
}

std::vector<MeshBlock> blocks_of(int count, float version, std::size_t vertices = 3) {
  std::vector<MeshBlock> blocks;
  blocks.reserve(static_cast<std::size_t>(count));
  for (int n = 0; n < count; ++n) blocks.push_back(block_of(n, version, vertices));
  return blocks;
}

float version_of(const MeshReader& reader, int number) {
  const auto found = reader.blocks.find({0, {8 * number, 0, 0}});
  return found == reader.blocks.end() ? -1.0F : found->second.positions_mm.front()[0];
}

/// Reads until the reader has that update.
void read_to(MeshReader& reader, std::uint64_t sequence) {
  while (reader.mark.sequence < sequence) ASSERT_TRUE(reader.update());
  EXPECT_EQ(reader.mark.blocks, reader.blocks.size());
}

/// Waits, half a minute at most, until the server's thread has come to that.
template <class Condition>
bool soon(const Condition& is_so) {
  for (int n = 0; n < 3000; ++n) {
    if (is_so()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

constexpr std::size_t kProofBytes = sizeof(BridgeKey::Nonce) + BridgeKey::kTagBytes;

TEST(BridgeMeshServer, GivesAllAndThenOnlyWhatChanged) {
  const auto server = opened();
  server->publish(blocks_of(100, 1.0F), {});
  MeshReader reader(server->port());
  reader.ask();
  read_to(reader, 1);
  EXPECT_EQ(reader.place, kPlace);
  constexpr std::size_t kBlock = kMeshBlockBytes + 3 * kMeshVertexBytes + kMeshTriangleBytes;
  EXPECT_EQ(reader.bytes, kProofBytes + kMeshPlaceBytes + 100 * kBlock + kMeshMarkBytes);
  EXPECT_EQ(reader.mark, (MeshMark{1, 100, 300, 100}));

  const std::size_t whole = reader.bytes;
  const std::array gone{block_of(99, 0.0F).id};
  server->publish({block_of(5, 2.0F), block_of(100, 2.0F)}, gone);
  read_to(reader, 2);
  // Two blocks that changed, one that went: nothing of the other 98.
  EXPECT_EQ(reader.bytes - whole, 2 * kBlock + kMeshBlockBytes + kMeshMarkBytes);
  EXPECT_EQ(version_of(reader, 5), 2.0F);
  EXPECT_EQ(version_of(reader, 99), -1.0F);
  EXPECT_EQ(version_of(reader, 100), 2.0F);
  // It counts after it has sent, when the reader may have read already.
  EXPECT_TRUE(soon([&] { return server->counts().bytes == reader.bytes; }));
}

TEST(BridgeMeshServer, GivesAllAgainToWhoComesBack) {
  const auto server = opened();
  server->publish(blocks_of(10, 1.0F), {});
  for (std::uint64_t n = 1; n <= 3; ++n) {
    MeshReader reader(server->port());
    reader.ask();
    read_to(reader, n);
    EXPECT_EQ(reader.blocks.size(), 10U);
    server->publish({block_of(3, static_cast<float>(n))}, {});
  }
  EXPECT_EQ(server->counts().readers, 3U);
  EXPECT_EQ(server->counts().malformed, 0U);
}

TEST(BridgeMeshServer, HoldsNoMoreForAReaderThatReadsNothing) {
  const auto server = opened();
  constexpr int kBlocks = 200;
  constexpr std::size_t kVertices = 400;
  server->publish(blocks_of(kBlocks, 1.0F, kVertices), {});
  const std::size_t whole = server->held_bytes();
  MeshReader reader(server->port());
  reader.ask();
  ASSERT_TRUE(soon([&] { return server->counts().blocks > 0; }));
  // All of it again and again, and nobody reads.
  const auto updates = test::effort<std::uint64_t>(15, 60);
  for (std::uint64_t n = 2; n <= updates; ++n) {
    server->publish(blocks_of(kBlocks, static_cast<float>(n), kVertices), {});
    ASSERT_LE(server->held_bytes(), 2 * whole + 1000);
  }
  read_to(reader, updates);
  for (int n = 0; n < kBlocks; ++n) EXPECT_EQ(version_of(reader, n), updates);
  // What it was sent first, perhaps what was published while it asked, and the newest.
  EXPECT_LE(reader.bytes, 4 * whole);
}

TEST(BridgeMeshServer, DropsAndCountsWhoSaysSomethingElse) {
  const auto server = opened();
  server->publish(blocks_of(1, 1.0F), {});
  std::vector<std::byte> wrong = encode(MeshAsk{});
  wrong[0] = std::byte{'X'};
  MeshReader other(server->port());
  other.say(other.asking(scenes::test_key(), wrong));
  EXPECT_FALSE(other.next().has_value());
  MeshReader talker(server->port());
  talker.ask();
  ASSERT_TRUE(talker.update());
  talker.say(encode(MeshAsk{}));
  EXPECT_FALSE(talker.update());
  EXPECT_TRUE(soon([&] { return server->counts().malformed == 2; }));
  MeshReader good(server->port());
  good.ask();
  EXPECT_TRUE(good.update()) << "the others did not keep it from its work";
}

TEST(BridgeMeshServer, AsksInPiecesAreAsks) {
  const auto server = opened();
  server->publish(blocks_of(1, 1.0F), {});
  MeshReader reader(server->port());
  for (const std::byte& one : reader.asking()) reader.say({&one, 1});
  EXPECT_TRUE(reader.update());
}

TEST(BridgeMeshServer, ShowsNothingToWhoHasNotTheKey) {
  const auto server = opened();
  server->publish(blocks_of(1, 1.0F), {});
  MeshReader keyless(server->port());
  std::vector<std::byte> words = keyless.asking();
  words.resize(kMeshAskBytes);
  words.resize(BridgeMeshServer::kAskBytes);
  keyless.say(words);
  EXPECT_FALSE(keyless.update());
  MeshReader guesser(server->port());
  guesser.say(guesser.asking(*BridgeKey::from_text("00000000000000000000000000000000")));
  EXPECT_FALSE(guesser.update());
  MeshReader owner(server->port());
  const std::vector<std::byte> heard = owner.asking();
  owner.say(heard);
  EXPECT_TRUE(owner.update());
  MeshReader eavesdropper(server->port());
  eavesdropper.say(heard);
  EXPECT_FALSE(eavesdropper.update()) << "what another connection said is of no use";
  // It says its number first, so that this reader may give up before what it said was looked at.
  EXPECT_TRUE(soon([&] { return server->counts().forged == 3U; }));
  EXPECT_EQ(server->counts().readers, 1U);
}

/// What it proves itself by is of the number that the reader made: what it said to another is not.
TEST(BridgeMeshServer, ProvesItselfForEachReadersOwnNumber) {
  const auto server = opened();
  server->publish(blocks_of(1, 1.0F), {});
  for (const std::uint64_t number : {std::uint64_t{0}, std::uint64_t{1}, ~std::uint64_t{0}}) {
    MeshReader reader(server->port());
    reader.say(reader.asking(scenes::test_key(), encode(MeshAsk{number})));
    EXPECT_TRUE(reader.update()) << number;
  }
  MeshReader other(server->port());
  std::vector<std::byte> said = other.asking(scenes::test_key(), encode(MeshAsk{7}));
  other.expect(MeshAsk{8});
  other.say(said);
  EXPECT_FALSE(other.update()) << "it is not from a server that heard 8";
  EXPECT_EQ(server->counts().readers, 4U);
}

TEST(BridgeMeshServer, WhoSaysNothingKeepsNobodyOut) {
  const auto server = opened();
  server->publish(blocks_of(1, 1.0F), {});
  std::vector<std::unique_ptr<MeshReader>> silent(2 * BridgeMeshServer::kMostSilent);
  for (auto& reader : silent) reader = std::make_unique<MeshReader>(server->port());
  MeshReader reader(server->port());
  reader.ask();
  EXPECT_TRUE(reader.update());
  EXPECT_GT(server->counts().malformed, 0U);
}

TEST(BridgeMeshServer, TellsOfTheStrokes) {
  const auto server = opened();
  server->publish(blocks_of(1, 1.0F), {});
  MeshReader reader(server->port());
  reader.ask();
  ASSERT_TRUE(reader.update());
  server->publish(MeshNote{0, 3, 1, "the disk is full"});
  server->publish(blocks_of(1, 2.0F), {});
  while (reader.mark.sequence < 2) ASSERT_TRUE(reader.update());
  EXPECT_EQ(reader.note.kept, 3U);
  EXPECT_EQ(reader.note.refused, 1U);
  EXPECT_EQ(reader.note.text, "the disk is full");
  MeshReader later(server->port());
  later.ask();
  ASSERT_TRUE(later.update());
  EXPECT_EQ(later.note.text, "the disk is full") << "as it is now, whenever one comes";
  server->publish(MeshNote{0, 0, 0, std::string(10'000, 'x')});
  server->publish(blocks_of(1, 3.0F), {});
  while (later.mark.sequence < 3) ASSERT_TRUE(later.update());
  EXPECT_EQ(later.note.text.size(), kMostMeshText);
}

TEST(BridgeMeshServer, RefusesAReaderTooMany) {
  const auto server = opened();
  server->publish(blocks_of(1, 1.0F), {});
  std::vector<std::unique_ptr<MeshReader>> readers;
  for (int n = 0; n < BridgeMeshServer::kMostReaders; ++n) {
    readers.push_back(std::make_unique<MeshReader>(server->port()));
    readers.back()->ask();
    ASSERT_TRUE(readers.back()->update());
  }
  MeshReader late(server->port());
  late.ask();
  EXPECT_FALSE(late.update());
  EXPECT_EQ(server->counts().refused, 1U);
  readers.pop_back();
  EXPECT_TRUE(soon([&] {
    MeshReader next(server->port());
    next.ask();
    return next.update();
  }));
}

TEST(BridgeMeshServer, FinishGivesAllAndSaysThatItEnds) {
  const auto server = opened();
  MeshReader reader(server->port());
  reader.ask();
  ASSERT_TRUE(reader.next().has_value()) << "its place";
  server->publish(blocks_of(50, 1.0F, 500), {});
  std::thread reads([&] {
    while (reader.update()) {
    }
  });
  server->finish(10.0);
  reads.join();
  EXPECT_TRUE(reader.has_ended);
  EXPECT_EQ(reader.blocks.size(), 50U);
}

TEST(BridgeMeshServer, FinishWaitsForNobodyWhoReadsNothing) {
  const auto server = opened();
  server->publish(blocks_of(200, 1.0F, 2000), {});
  MeshReader reader(server->port());
  reader.ask();
  ASSERT_TRUE(soon([&] { return server->counts().readers == 1; }));
  server->finish(0.1);
  server->publish(blocks_of(1, 2.0F), {});
  SUCCEED() << "it came back";
}

/// A reader that takes a little again and again would be waited for as long as it likes.
TEST(BridgeMeshServer, FinishEndsWhenItIsTold) {
  const auto server = opened();
  server->publish(blocks_of(200, 1.0F, 2000), {});
  MeshReader reader(server->port());
  reader.ask();
  ASSERT_TRUE(soon([&] { return server->counts().readers == 1; }));
  int asked = 0;
  server->finish(1e9, [&] {
    EXPECT_TRUE(reader.next().has_value()) << "there is progress each time";
    return ++asked < 5;
  });
  EXPECT_EQ(asked, 5);
  bool has_ended = false;
  while (const auto message = reader.next()) {
    has_ended = has_ended || std::holds_alternative<MeshEnd>(*message);
  }
  EXPECT_FALSE(has_ended) << "the rest was not waited for";
}

/// The addresses that this machine's kernel listens at with that port, as it prints them.
std::string mesh_addresses_of(std::uint16_t port) {
  std::array<char, 8> wanted{};
  std::snprintf(wanted.data(), wanted.size(), ":%04X", port);
  std::string found;
  for (const char* table : {"/proc/net/tcp", "/proc/net/tcp6"}) {
    std::ifstream stream(table);
    for (std::string line; std::getline(stream, line);) {
      const std::size_t at = line.find(wanted.data());
      if (at != std::string::npos && at < 45) found += line.substr(at - 8, 8) + " ";
    }
  }
  return found;
}

TEST(BridgeMeshServer, ListensOnLoopbackOnly) {
  const auto server = opened();
  const std::string loopback =
      std::endian::native == std::endian::little ? "0100007F " : "7F000001 ";
  EXPECT_EQ(mesh_addresses_of(server->port()), loopback);
}

TEST(BridgeMeshServer, SaysWhoHasThePort) {
  const auto server = opened();
  const auto other =
      BridgeMeshServer::open({kLoopbackHost, server->port()}, scenes::test_key(), kPlace);
  ASSERT_FALSE(other.ok());
  EXPECT_EQ(other.error().kind, ErrorKind::device);
  EXPECT_NE(other.error().message.find("--port"), std::string::npos) << other.error().message;
}

/// Every state that a reader is shown is one that was published: all of its blocks are of the same
/// update, however fast others come.
TEST(BridgeMeshServerStress, ShowsOnlyStatesThatWere) {
  const auto server = opened();
  constexpr int kBlocks = 40;
  constexpr int kUpdates = 200;
  server->publish(blocks_of(kBlocks, 1.0F, 100), {});
  const auto reads = [&] {
    MeshReader reader(server->port());
    reader.ask();
    while (reader.mark.sequence < kUpdates) {
      ASSERT_TRUE(reader.update());
      for (int n = 0; n < kBlocks; ++n) {
        ASSERT_EQ(version_of(reader, n), static_cast<float>(reader.mark.sequence));
      }
    }
  };
  std::thread one(reads);
  std::thread two(reads);
  for (int n = 2; n <= kUpdates; ++n) {
    server->publish(blocks_of(kBlocks, static_cast<float>(n), 100), {});
  }
  one.join();
  two.join();
}

}  // namespace
}  // namespace argil::haptics
