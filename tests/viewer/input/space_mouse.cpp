// SPDX-License-Identifier: GPL-3.0-or-later
// libspnav against a daemon of the test, which speaks spacenavd's first protocol: eight integers an
// event, of which the first is its kind (0 motion, 1 and 2 a button pressed and let go).
#include "input/space_mouse.h"

#include <array>
#include <chrono>
#include <cstdlib>
#include <thread>

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "support/scratch.h"

namespace argil::viewer {
namespace {

using Words = std::array<int, 8>;

class Daemon {
 public:
  explicit Daemon(const std::string& path) : listener_(socket(AF_UNIX, SOCK_STREAM, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.copy(address.sun_path, sizeof address.sun_path - 1);
    EXPECT_EQ(bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(listen(listener_, 1), 0);
  }
  ~Daemon() {
    hang_up();
    close(listener_);
  }
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;

  void accept_one() { client_ = accept(listener_, nullptr, nullptr); }
  void say(const Words& words) {
    ASSERT_EQ(write(client_, words.data(), sizeof words), static_cast<ssize_t>(sizeof words));
  }
  void hang_up() {
    if (client_ >= 0) close(client_);
    client_ = -1;
  }

 private:
  int listener_;
  int client_ = -1;
};

class SpaceMouseTest : public testing::Test {
 protected:
  // NOLINTBEGIN(concurrency-mt-unsafe): this test has one thread
  SpaceMouseTest() { setenv("SPNAV_SOCKET", path_.c_str(), 1); }
  ~SpaceMouseTest() override { unsetenv("SPNAV_SOCKET"); }
  // NOLINTEND(concurrency-mt-unsafe)

  /// What comes within a second, until there are so many.
  static std::vector<InputEvent> heard(SpaceMouse& mouse, std::size_t count) {
    std::vector<InputEvent> all;
    for (int n = 0; n < 1000 && all.size() < count; ++n) {
      for (const InputEvent& event : mouse.poll()) all.push_back(event);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return all;
  }

  test::ScratchFolder folder_;
  std::string path_ = (folder_.path() / "spnav.sock").string();
};

TEST_F(SpaceMouseTest, IsNotThereWithoutADaemon) { EXPECT_EQ(SpaceMouse::open(), nullptr); }

TEST_F(SpaceMouseTest, TellsHowFarThePuckIsPushedAndTurned) {
  Daemon daemon(path_);
  std::thread server([&] { daemon.accept_one(); });
  const auto mouse = SpaceMouse::open();
  server.join();
  ASSERT_NE(mouse, nullptr);
  daemon.say({0, 350, -175, 70, 35, 0, -700, 16});
  const auto events = heard(*mouse, 1);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].kind, InputEvent::Kind::puck);
  EXPECT_EQ(events[0].puck_shift, (Vec3{1.0, -0.5, 0.2}));
  EXPECT_EQ(events[0].puck_turn, (Vec3{0.1, 0.0, -1.0})) << "no farther than to the stop";
  EXPECT_DOUBLE_EQ(events[0].puck_s, 0.016);
}

TEST_F(SpaceMouseTest, ItsFirstButtonIsTheKeyHome) {
  Daemon daemon(path_);
  std::thread server([&] { daemon.accept_one(); });
  const auto mouse = SpaceMouse::open();
  server.join();
  ASSERT_NE(mouse, nullptr);
  daemon.say({1, 0, 0, 0, 0, 0, 0, 0});
  daemon.say({2, 0, 0, 0, 0, 0, 0, 0});
  daemon.say({1, 5, 0, 0, 0, 0, 0, 0});
  const auto events = heard(*mouse, 2);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].kind, InputEvent::Kind::key_down);
  EXPECT_EQ(events[1].kind, InputEvent::Kind::key_up);
  EXPECT_EQ(events[0].key, kKeyHome);
}

TEST_F(SpaceMouseTest, ADaemonThatEndsIsQuiet) {
  Daemon daemon(path_);
  std::thread server([&] { daemon.accept_one(); });
  const auto mouse = SpaceMouse::open();
  server.join();
  ASSERT_NE(mouse, nullptr);
  daemon.hang_up();
  EXPECT_TRUE(heard(*mouse, 1).empty());
}

}  // namespace
}  // namespace argil::viewer
