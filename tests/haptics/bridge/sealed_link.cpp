// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/bridge/sealed_link.h"

#include <algorithm>
#include <deque>
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "argil/haptics/bridge/bridge_session.h"

#include "support/scratch.h"

namespace argil::haptics {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::byte>;
constexpr BridgeAddress kAt{kLoopbackHost, 7};
constexpr BridgeAddress kElsewhere{kLoopbackHost, 8};

BridgeKey key_of(char digit) { return *BridgeKey::from_text(std::string(32, digit)); }

/// A wire whose other end is the test.
class Carrier final : public BridgeLink {
 public:
  std::size_t receive(std::span<std::byte> into, BridgeAddress& from) noexcept override {
    if (in.empty()) return 0;
    const auto [bytes, address] = in.front();
    in.pop_front();
    from = address;
    std::copy_n(bytes.begin(), std::min(bytes.size(), into.size()), into.begin());
    return bytes.size();
  }
  void send(std::span<const std::byte> datagram, const BridgeAddress&) noexcept override {
    out.emplace_back(datagram.begin(), datagram.end());
  }
  bool wait(double) noexcept override { return !in.empty(); }

  std::deque<std::pair<Bytes, BridgeAddress>> in;
  std::vector<Bytes> out;
};

/// As somebody sends it who has that key.
Bytes sealed(const BridgeMessage& message, const BridgeKey& key = key_of('1'),
             BridgeSender sender = BridgeSender::simulator, std::uint16_t port = kAt.port) {
  Carrier carrier;
  SealedLink(carrier, key, sender, port).send(encode(message).span(), {});
  return carrier.out.front();
}

BridgeHello hello_of(std::uint64_t sequence) { return {{sequence, 0, 0}, 60.0}; }

/// A bridge's end, and what it takes of what is put on the wire.
struct Bridge {
  Carrier carrier;
  SealedLink link{carrier, key_of('1'), BridgeSender::bridge, 99};

  std::size_t take(Bytes bytes, const BridgeAddress& from = kAt) {
    carrier.in.emplace_back(std::move(bytes), from);
    std::array<std::byte, kBridgeMostBytes> into;
    BridgeAddress sender;
    return link.receive(into, sender);
  }
};

TEST(BridgeKey, IsThirtyTwoDigits) {
  const std::string text = "000102030405060708090a0b0c0d0e0f";
  EXPECT_EQ(BridgeKey::from_text(text)->text(), text);
  EXPECT_NE(BridgeKey::random().text(), BridgeKey::random().text());
  for (const char* other :
       {"", "00", "000102030405060708090a0b0c0d0e0", "xx0102030405060708090a0b0c0d0e0f",
        "000102030405060708090a0b0c0d0e0f0"}) {
    EXPECT_FALSE(BridgeKey::from_text(other).has_value()) << other;
  }
}

/// As hashlib.blake2b(b"argil", digest_size=16, key=bytes(range(16)), person=...) of Python makes
/// them.
TEST(BridgeKey, MakesTheTagsThatPythonMakes) {
  const BridgeKey key = *BridgeKey::from_text("000102030405060708090a0b0c0d0e0f");
  const std::string words = "argil";
  const auto tag_of = [&](BridgeSender sender) {
    std::string text;
    for (const std::byte byte : key.tag(sender, std::as_bytes(std::span(words)))) {
      constexpr const char* kDigits = "0123456789abcdef";
      text += kDigits[std::to_integer<int>(byte >> 4)];
      text += kDigits[std::to_integer<int>(byte & std::byte{15})];
    }
    return text;
  };
  EXPECT_EQ(tag_of(BridgeSender::bridge), "9bfbfacf39d1622a151044483678b5b5");
  EXPECT_EQ(tag_of(BridgeSender::simulator), "a555b37c4c73fc6e95ab6c137bb4f39f");
}

TEST(SealedLink, TakesWhatHasTheTag) {
  Bridge bridge;
  const Bytes datagram = sealed(hello_of(1));
  EXPECT_EQ(datagram.size(), kBridgeHelloBytes + BridgeKey::kTagBytes);
  EXPECT_EQ(bridge.take(datagram), kBridgeHelloBytes);
  EXPECT_EQ(
      bridge.take(sealed(BridgeProxy{{2, 0, 0}, 0, 0, {}, {}, {}, {}, {0.0, 1.0, 0.0}, {}, 0.0})),
      kBridgeProxyBytes);
  EXPECT_EQ(bridge.link.counts().forged + bridge.link.counts().replayed, 0U);
  std::array<std::byte, kBridgeMostBytes> into;
  BridgeAddress from;
  EXPECT_EQ(bridge.link.receive(into, from), 0U) << "there is nothing more";
}

TEST(SealedLink, DropsWhatHasNoTagOrAnother) {
  Bridge bridge;
  const BridgeDatagram bare = encode(hello_of(1));
  std::uint64_t tried = 0;
  const auto expect_dropped = [&](Bytes bytes) {
    EXPECT_EQ(bridge.take(std::move(bytes)), BridgeLink::kDropped);
    EXPECT_EQ(bridge.link.counts().forged, ++tried);
  };
  expect_dropped({bare.span().begin(), bare.span().end()});
  expect_dropped(sealed(hello_of(1), key_of('2')));
  expect_dropped(sealed(hello_of(1), key_of('1'), BridgeSender::bridge));  // sent back
  const Bytes whole = sealed(hello_of(1));
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    Bytes other = whole;
    other[bit / 8] ^= std::byte{1} << (bit % 8);
    expect_dropped(std::move(other));
  }
  for (std::size_t size = 1; size < whole.size(); ++size) {
    expect_dropped({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)});
  }
  expect_dropped(Bytes(10'000));
  EXPECT_EQ(bridge.take(whole), kBridgeHelloBytes);
}

TEST(SealedLink, DropsWhatWasSaidBefore) {
  Bridge bridge;
  const auto from = [](std::uint64_t sequence, std::uint16_t port) {
    return sealed(hello_of(sequence), key_of('1'), BridgeSender::simulator, port);
  };
  const Bytes first = from(1000, 7);
  EXPECT_EQ(bridge.take(first), kBridgeHelloBytes);
  EXPECT_EQ(bridge.take(first), BridgeLink::kDropped) << "from where it came";
  EXPECT_EQ(bridge.take(from(999, 8), kElsewhere), BridgeLink::kDropped)
      << "who is new must be newer";
  EXPECT_EQ(bridge.link.counts().replayed, 2U);
  EXPECT_EQ(bridge.take(first, kElsewhere), BridgeLink::kDropped);
  EXPECT_EQ(bridge.take(from(5000, 7), kElsewhere), BridgeLink::kDropped)
      << "not even before it came";
  EXPECT_EQ(bridge.link.counts().forged, 2U);
  EXPECT_EQ(bridge.take(from(2000, 8), kElsewhere), kBridgeHelloBytes);
  EXPECT_EQ(bridge.take(from(1001, 7)), kBridgeHelloBytes)
      << "who was there goes on from where he was";
  // However many come: those who are forgotten must be newer than all.
  for (std::uint16_t n = 0; n < 100; ++n) {
    const auto port = static_cast<std::uint16_t>(100 + n);
    EXPECT_EQ(bridge.take(from(3000U + n, port), {kLoopbackHost, port}), kBridgeHelloBytes);
  }
  EXPECT_EQ(bridge.take(from(1002, 7)), BridgeLink::kDropped);
}

/// A session hears of it only that there was something.
TEST(SealedLink, LetsASessionHearNothingOfStrangers) {
  Bridge bridge;
  BridgeSession session(bridge.link, {});
  bridge.carrier.in.emplace_back(sealed(hello_of(1)), kAt);
  BridgeProxy proxy;
  proxy.header = {2, 0, kBridgeContact};
  bridge.carrier.in.emplace_back(sealed(proxy), kAt);
  session.receive(0.0);
  ASSERT_NE(session.newest(), nullptr);
  const auto heard = session.counts();
  for (int n = 0; n < 20; ++n) {
    proxy.header.sequence = 100U + static_cast<std::uint64_t>(n);
    proxy.position_mm.x = 1.0;
    bridge.carrier.in.emplace_back(sealed(proxy, key_of('3')), kAt);
    bridge.carrier.in.emplace_back(sealed(BridgeBye{{200, 0, 0}, {}}, key_of('3')), kAt);
    bridge.carrier.in.emplace_back(Bytes(33), kElsewhere);
  }
  session.receive(0.0);
  EXPECT_TRUE(bridge.carrier.in.empty());
  EXPECT_EQ(session.newest()->header.sequence, 2U);
  EXPECT_TRUE(session.has_simulator());
  EXPECT_EQ(session.counts().malformed, heard.malformed);
  EXPECT_EQ(bridge.link.counts().forged, 60U);
}

/// Whatever strangers send, a tick takes so many of it from the wire, and reads none of that.
TEST(SealedLink, CostsATickNoMoreThanItsShareOfAFlood) {
  Bridge bridge;
  BridgeSession session(bridge.link, {});
  const Bytes heard = sealed(hello_of(1));
  bridge.carrier.in.emplace_back(heard, kAt);
  session.receive(0.0);
  BridgeProxy proxy;
  proxy.header = {9, 0, kBridgeContact};
  constexpr std::size_t kFlood = 3000;
  for (std::size_t n = 0; n < kFlood; n += 3) {
    bridge.carrier.in.emplace_back(sealed(proxy, key_of('3')), kElsewhere);
    bridge.carrier.in.emplace_back(Bytes(10'000), kElsewhere);
    bridge.carrier.in.emplace_back(heard, kAt);
  }
  const std::size_t answers = bridge.carrier.out.size();
  for (std::size_t tick = 1; tick <= 10; ++tick) {
    session.receive(1e-3 * static_cast<double>(tick));
    ASSERT_EQ(bridge.carrier.in.size(), kFlood - tick * BridgeSession::kMostReceived);
  }
  const SealedCounts& dropped = bridge.link.counts();
  EXPECT_EQ(dropped.forged + dropped.replayed, 10U * BridgeSession::kMostReceived);
  EXPECT_EQ(session.counts().malformed + session.counts().strangers, 0U);
  EXPECT_EQ(bridge.carrier.out.size(), answers) << "nobody is answered";
}

fs::perms mode_of(const fs::path& path) { return fs::status(path).permissions(); }

TEST(BridgeKeyFile, IsTheOwnersAlone) {
  const test::ScratchFolder folder;
  const fs::path file = folder / "new" / "bridge.key";
  const BridgeKey key = BridgeKey::random();
  {
    const auto kept = BridgeKeyFile::write(file, key);
    ASSERT_TRUE(kept.ok()) << kept.error().message;
    EXPECT_EQ(mode_of(file), fs::perms::owner_read | fs::perms::owner_write);
    EXPECT_EQ(mode_of(file.parent_path()), fs::perms::owner_all);
    std::string text;
    std::ifstream(file) >> text;
    EXPECT_EQ(text, key.text());
  }
  EXPECT_FALSE(fs::exists(file)) << "it ends with the bridge";
  EXPECT_TRUE(fs::is_empty(file.parent_path()));
}

TEST(BridgeKeyFile, ReplacesAKeyAndNothingElse) {
  const test::ScratchFolder folder;
  const fs::path file = folder / "bridge.key";
  std::ofstream(file) << key_of('2').text() << "\n";
  { EXPECT_TRUE(BridgeKeyFile::write(file, key_of('1')).ok()); }
  std::ofstream(file) << "what somebody wrote";
  const auto refused = BridgeKeyFile::write(file, key_of('1'));
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().kind, ErrorKind::bad_input);
  EXPECT_NE(refused.error().message.find("--key"), std::string::npos);
  std::string text;
  std::getline(std::ifstream(file), text);
  EXPECT_EQ(text, "what somebody wrote");
  fs::remove(file);
  fs::create_symlink(folder / "elsewhere", file);
  EXPECT_FALSE(BridgeKeyFile::write(file, key_of('1')).ok()) << "a link leads to who knows where";
}

TEST(BridgeKeyFile, DoesNotLieWhereOthersMayPutOne) {
  const test::ScratchFolder folder;
  fs::create_directory(folder / "open");
  fs::permissions(folder / "open", fs::perms::all);
  const auto refused = BridgeKeyFile::write(folder / "open" / "bridge.key", key_of('1'));
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("others may write"), std::string::npos);
}

/// A folder that another user made, or a link that leads to one of his choice.
TEST(BridgeKeyFile, DoesNotLieBehindALinkOfAnothers) {
  const test::ScratchFolder folder;
  const fs::path own = folder / "own";
  const fs::path link = folder / "link";
  fs::create_directory(own);
  fs::permissions(own, fs::perms::owner_all);
  fs::create_directory_symlink(own, link);
  { EXPECT_TRUE(BridgeKeyFile::write(link / "bridge.key", key_of('1')).ok()) << "one's own link"; }
  constexpr uid_t kAnother = 12'345;
  if (::lchown(link.c_str(), kAnother, kAnother) != 0) {
    GTEST_SKIP() << "to give a link away needs root";
  }
  const auto refused = BridgeKeyFile::write(link / "bridge.key", key_of('1'));
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("others may write"), std::string::npos);
  EXPECT_TRUE(fs::is_empty(own));
}

std::string first_line_of(const fs::path& file) {
  std::string text;
  std::getline(std::ifstream(file), text);
  return text;
}

TEST(BridgeKeyFile, IsNotTakenFromABridgeThatLives) {
  const test::ScratchFolder folder;
  const fs::path file = folder / "bridge.key";
  {
    const auto first = BridgeKeyFile::write(file, key_of('1'));
    ASSERT_TRUE(first.ok()) << first.error().message;
    const auto second = BridgeKeyFile::write(file, key_of('2'));
    ASSERT_FALSE(second.ok());
    EXPECT_EQ(second.error().kind, ErrorKind::bad_input);
    EXPECT_NE(second.error().message.find("another file with --key"), std::string::npos)
        << second.error().message;
    EXPECT_EQ(first_line_of(file), key_of('1').text());
    EXPECT_EQ(folder.names().size(), 1U);
  }
  EXPECT_TRUE(folder.names().empty());
  EXPECT_TRUE(BridgeKeyFile::write(file, key_of('2')).ok()) << "once it has ended";
}

TEST(BridgeKeyFile, RemovesNoOtherThanItsOwn) {
  const test::ScratchFolder folder;
  const fs::path file = folder / "bridge.key";
  {
    auto first = BridgeKeyFile::write(file, key_of('1'));
    ASSERT_TRUE(first.ok());
    fs::remove(file);  // as a person may
    const auto second = BridgeKeyFile::write(file, key_of('2'));
    ASSERT_TRUE(second.ok()) << second.error().message;
    { const BridgeKeyFile ends = std::move(first).value(); }
    EXPECT_EQ(first_line_of(file), key_of('2').text());
  }
  EXPECT_TRUE(folder.names().empty());
}

TEST(BridgeKeyFile, WaitsForNobodyWhereAPipeLies) {
  const test::ScratchFolder folder;
  const fs::path file = folder / "bridge.key";
  ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
  EXPECT_FALSE(BridgeKeyFile::write(file, key_of('1')).ok());
}

}  // namespace
}  // namespace argil::haptics
