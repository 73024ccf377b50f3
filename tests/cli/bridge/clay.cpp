// SPDX-License-Identifier: GPL-3.0-or-later
// argil bridge --clay with simulators in processes of their own: what they show is the clay that is
// saved, and what is felt is not theirs.
#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <chrono>
#include <cstring>
#include <fstream>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/mount.h>
#include <sys/socket.h>

#include "argil/engine/surface.h"
#include "argil/haptics/bridge/bridge_mesh.h"
#include "argil/io/session.h"

#include "cli/bridge/clients.h"
#include "cli/run_argil.h"
#include "support/clients.h"
#include "support/effort.h"
#include "support/scratch.h"

namespace argil::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Simulator = std::function<Words(const std::string& port, const Words& more)>;

const Simulator kStandIn = [](const std::string& port, const Words& more) {
  return stand_in(port, more);
};
const Simulator kBlender = [](const std::string& port, const Words& more) {
  Words words{"--scene", "clay"};
  words.insert(words.end(), more.begin(), more.end());
  return blender(port, words);
};

/// A project of a small ball with a fine bump, so that its surface has levels; of coarser voxels it
/// has one.
fs::path small_project(const ScratchFolder& folder, double voxel_mm = 0.5,
                       double radius_mm = 15.0) {
  const fs::path script = folder / "ball.strokes.jsonl";
  std::ofstream(script)
      << R"({"argil_strokes":1,"units":"mm","start":{"shape":"ball","radius_mm":)" << radius_mm
      << R"(,"voxel_mm":)" << voxel_mm << "}}\n"
      << R"({"tool":"add","shape":"ball","radius_mm":1,"poses":[[0,3,-14,1],[0.2,6,-13,3]]})"
      << "\n";
  const fs::path project = folder / "ball.vdb";
  const Ended made = run_argil({"sculpt", "--strokes", script.string(), "-o", project.string()});
  EXPECT_EQ(made.status, 0) << made.err;
  return project;
}

/// A triangle's corners as floats, the least first: the same whatever its vertices' numbers are.
using Corners = std::array<std::array<float, 3>, 3>;
Corners turned_to_least(Corners corners) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

std::vector<Corners> read_stl(const fs::path& file) {
  constexpr std::size_t kHead = 84;
  constexpr std::size_t kFacet = 50;
  constexpr std::size_t kNormal = 12;
  const std::string text = content_of(file);
  std::vector<Corners> all;
  for (std::size_t at = kHead; at + kFacet <= text.size(); at += kFacet) {
    Corners corners;
    std::memcpy(&corners, text.data() + at + kNormal, sizeof corners);
    all.push_back(turned_to_least(corners));
  }
  std::ranges::sort(all);
  return all;
}

std::array<float, 3> rounded(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// The surface that argil itself extracts from a project.
std::vector<Corners> surface_of(const fs::path& project) {
  const auto opened = io::open_project(project);
  EXPECT_TRUE(opened.ok());
  if (!opened) return {};
  const TriangleMesh mesh = extract_surface(opened.value().sculpture.clay());
  std::vector<Corners> all;
  for (const Triangle& t : mesh.triangles) {
    all.push_back(turned_to_least({rounded(mesh.positions[t[0]]), rounded(mesh.positions[t[1]]),
                                   rounded(mesh.positions[t[2]])}));
  }
  std::ranges::sort(all);
  return all;
}

void expect_shown(const fs::path& shown, const fs::path& project) {
  const std::vector<Corners> theirs = read_stl(shown);
  const std::vector<Corners> ours = surface_of(project);
  EXPECT_GT(ours.size(), 1000U);
  EXPECT_EQ(theirs.size(), ours.size());
  EXPECT_TRUE(theirs == ours) << "other triangles";
}

/// The bridge with that clay, and one simulator from beginning to end.
json bridged(const Words& simulator, const std::string& port, const fs::path& project,
             const Words& more) {
  const ScratchFolder folder;
  Beside beside(simulator, folder / "said");
  Words words{"bridge", "--port",         port,     "--wait", "60",
              "--clay", project.string(), "--tool", "ball:3", "--json"};
  words.insert(words.end(), more.begin(), more.end());
  const Ended run = run_argil(words);
  EXPECT_EQ(run.status, 0) << run.err << content_of(folder / "said");
  EXPECT_EQ(beside.wait(), 0) << content_of(folder / "said");
  return json::parse(run.out, nullptr, false);
}

/// The whole stroke ends at 3.5 s; usually the run ends in it.
const Words kCarve{"--lockstep", "--motion", "carve", "--seconds", effort("2.5", "4")};
const Words kFree{"--lockstep", "--motion", "free", "--seconds", "1"};

std::string hash_of(const fs::path& project) {
  return run_argil({"info", project.string(), "--json"}).json()["hash"];
}

/// A stroke in lockstep: what is shown in the end is what is saved.
void expect_shows_what_is_saved(const Simulator& simulator) {
  const ScratchFolder folder;
  const fs::path project = small_project(folder);
  const std::string before = hash_of(project);
  const std::string port = free_port();
  const std::string stl = (folder / "shown.stl").string();
  const json run = bridged(simulator(port, {"--save", stl}), port, project, kCarve);
  EXPECT_EQ(run["law"], "clay");
  EXPECT_EQ(run["clay"]["strokes"], 1);
  EXPECT_EQ(run["clay"]["hash"], hash_of(project));
  EXPECT_NE(run["clay"]["hash"], before);
  expect_shown(stl, project);
  EXPECT_EQ(static_cast<std::size_t>(run["clay"]["triangles"]), read_stl(stl).size());
}

TEST(BridgeClayStandInClient, ShowsTheClayThatIsSaved) {
  ARGIL_CLIENT_OR_SKIP("python3");
  expect_shows_what_is_saved(kStandIn);
}

TEST(BridgeClayBlenderClient, ShowsTheClayThatIsSaved) {
  ARGIL_CLIENT_OR_SKIP("blender");
  expect_shows_what_is_saved(kBlender);
}

TEST(BridgeClayStandInClient, SendsWhatAStrokeChangesAndNoMore) {
  ARGIL_CLIENT_OR_SKIP("python3");
  const ScratchFolder folder;
  const fs::path project = small_project(folder);
  const std::string port = free_port();
  const json still = bridged(stand_in(port), port, project, kFree)["clay"];
  EXPECT_EQ(still["updates"], 1) << "nothing was worked: the whole clay, once";
  const json carved = bridged(stand_in(port), port, project, kCarve)["clay"];
  const double whole_bytes = still["bytes_sent"];
  const double whole_blocks = still["blocks_sent"];
  const double more_bytes = carved["bytes_sent"].get<double>() - whole_bytes;
  const double more_blocks = carved["blocks_sent"].get<double>() - whole_blocks;
  const double updates = carved["updates"].get<double>() - 1.0;
  ASSERT_GT(updates, 5.0);
  EXPECT_LT(more_blocks / updates, 0.5 * whole_blocks) << "an update is a part of the clay";
  // What a changed block takes, finer than others as it may be, and the mark of its update.
  EXPECT_LT(more_bytes, 3.0 * more_blocks * whole_bytes / whole_blocks + 48.0 * updates);
}

/// What is felt, as the log has it.
const Words kFelt{"x_mm", "y_mm", "z_mm", "force_x_n", "force_y_n", "force_z_n"};

TEST(BridgeClayStandInClient, IsFeltTheSameWhateverTheSimulatorsRate) {
  ARGIL_CLIENT_OR_SKIP("python3");
  const ScratchFolder folder;
  const fs::path project = small_project(folder, effort(1.0, 0.5));
  const std::string port = free_port();
  const std::string file = (folder / "run.csv").string();
  std::vector<std::string> texts;
  std::vector<Log> logs;
  const Words rates = effort<Words>({"60", "60", "200"}, {"60", "60", "60", "60", "200"});
  for (const std::string& rate : rates) {
    const fs::path copy = folder / "copy.vdb";
    fs::copy_file(project, copy, fs::copy_options::overwrite_existing);
    bridged(stand_in(port, {"--rate", rate}), port, copy, with(kCarve, {"--log", file}));
    texts.push_back(content_of(file));
    logs.push_back(read_log(file));
  }
  for (std::size_t n = 1; n + 1 < texts.size(); ++n) {
    EXPECT_TRUE(texts[n] == texts[0]) << "the same bits every time";
  }
  EXPECT_NE(texts.front(), texts.back());
  for (const std::string& column : kFelt) {
    EXPECT_EQ(logs.front().at(column), logs.back().at(column));
  }
  EXPECT_GT(std::ranges::max(logs[0].at("force_y_n")), 1.0);
  EXPECT_EQ(std::ranges::max(logs[0].at("contact")), 0.0) << "the simulator claims nothing";
}

TEST(BridgeClayBlenderClient, FeelsTheClayAndNothingOfBlender) {
  ARGIL_CLIENT_OR_SKIP("blender");
  const ScratchFolder folder;
  const fs::path project = small_project(folder);
  const std::string port = free_port();
  const std::string file = (folder / "run.csv").string();
  const std::string theirs = (folder / "blender.csv").string();
  const Words press{"--lockstep", "--motion", "press", "--seconds", "2", "--log", file};
  const json run = bridged(kBlender(port, {"--log", theirs}), port, project, press);
  const Log log = read_log(file);
  std::set<std::array<double, 6>> felt;
  for (std::size_t n = 0; n < log.at("tick").size(); ++n) {
    std::array<double, 6> row{};
    std::ranges::transform(kFelt, row.begin(), [&](const auto& name) { return log.at(name)[n]; });
    felt.insert(row);
    EXPECT_EQ(log.at("contact")[n] + log.at("plane")[n], 0.0) << "Blender claims nothing";
  }
  const Log seen = read_log(theirs);
  ASSERT_GE(seen.at("frame").size(), 100U);
  double most_n = 0.0;
  for (std::size_t n = 0; n < seen.at("frame").size(); ++n) {
    std::array<double, 6> row{};
    std::ranges::transform(kFelt, row.begin(), [&](const auto& name) { return seen.at(name)[n]; });
    EXPECT_TRUE(felt.contains(row)) << "frame " << n;
    most_n = std::max(most_n, row[4]);
  }
  EXPECT_GT(most_n, 1.0);
  EXPECT_GT(run["force_mean_n"][1].get<double>(), 0.5);
}

/// To and fro over the top, the button held, for longer than any run, and deeper each time, so that
/// there is always clay to feel.
void write_carving(const fs::path& file) {
  constexpr int kSeconds = 120;
  std::ofstream stream(file);
  stream << "0,-6,8,0,0\n";
  for (int n = 1; n < kSeconds; ++n) {
    const double depth_mm = std::min(8.0, 0.5 + 0.2 * n);
    stream << n << ',' << (n % 2 == 0 ? -6 : 6) << ',' << -depth_mm << ",0,0,1\n";
  }
}

/// Waits, a minute at most, until so many simulators have said that they are coupled.
void wait_until_coupled(const fs::path& said, int simulators) {
  for (int n = 0; n < 600; ++n) {
    const std::string text = fs::exists(said) ? content_of(said) : "";
    int seen = 0;
    for (std::size_t at = 0; (at = text.find(": coupled", at)) != std::string::npos; ++at) ++seen;
    if (seen >= simulators) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  ADD_FAILURE() << "no simulator " << simulators << " came";
}

/// Felt at some time while no simulator was heard. A log that is still written ends in part of a
/// row.
double most_alone_n(const Log& log) {
  double most_n = 0.0;
  if (!log.contains("tick")) return most_n;
  for (std::size_t n = 0; n + 1 < log.at("tick").size(); ++n) {
    if (log.at("share")[n] > 0.0 || log.at("age_s")[n] <= 0.3) continue;
    most_n = std::max(most_n, log.at("force_y_n")[n]);
  }
  return most_n;
}

/// Waits, half a minute at most: on a busy machine the clay answers late, and then less is felt.
/// While a log is written its name is hidden (argil/io/safe_file.h).
void wait_until_felt_alone(const fs::path& log) {
  const std::string hidden = '.' + log.stem().string() + '.';
  for (int n = 0; n < 120; ++n) {
    for (const auto& entry : fs::directory_iterator(log.parent_path())) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with(hidden) && most_alone_n(read_log(entry.path())) > 0.0) return;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(250));
  }
}

/// Killed while the hand carves: the hand feels on, nothing is lost, and another one is shown all.
void expect_comes_back(const Simulator& simulator) {
  const ScratchFolder folder;
  const fs::path project = small_project(folder);
  const std::string port = free_port();
  const std::string file = (folder / "run.csv").string();
  const std::string stl = (folder / "shown.stl").string();
  const fs::path said = folder / "said";
  write_carving(folder / "carve.csv");
  std::optional<Beside> first(std::in_place, simulator(port, {}), said);
  std::optional<Beside> second;
  std::atomic<bool> is_done = false;
  std::thread meddler([&] {
    wait_until_coupled(said, 1);
    std::this_thread::sleep_for(std::chrono::seconds(effort(2, 3)));  // it carves from 1 s on
    first->kill();
    wait_until_felt_alone(file);
    second.emplace(simulator(port, {"--save", stl}), said);
    wait_until_coupled(said, 2);
    std::this_thread::sleep_for(std::chrono::seconds(effort(1, 2)));
    is_done = true;
  });
  RunOptions ended;
  ended.interrupt_when = [&] { return is_done.load(); };
  const Ended run =
      run_argil({"bridge", "--port", port, "--wait", "60", "--clay", project.string(), "--tool",
                 "ball:3", "--motion", (folder / "carve.csv").string(), "--log", file, "--json"},
                ended);
  meddler.join();
  ASSERT_EQ(run.status, 0) << run.err << content_of(said);
  EXPECT_EQ(second->wait(), 0) << content_of(said);
  const json clay = run.json()["clay"];
  EXPECT_EQ(run.json()["sessions"], 2) << content_of(said);
  EXPECT_GE(clay["readers"], 2);
  EXPECT_GE(clay["strokes"], 1);
  EXPECT_FALSE(fs::exists(folder / "ball.journal.jsonl")) << "Ctrl-C is its usual end: it is saved";
  EXPECT_EQ(clay["hash"], hash_of(project));
  expect_shown(stl, project);
  EXPECT_GT(most_alone_n(read_log(file)), 0.0) << run.out;
}

TEST(BridgeClayStandInClient, IsKilledWhileCarvingAndComesBack) {
  ARGIL_CLIENT_OR_SKIP("python3");
  expect_comes_back(kStandIn);
}

TEST(BridgeClayBlenderClient, IsKilledWhileCarvingAndComesBack) {
  ARGIL_CLIENT_OR_SKIP("blender");
  expect_comes_back(kBlender);
}

/// Until the program says that, a minute at most.
bool waits_for(const fs::path& said, const std::string& words) {
  for (int n = 0; n < 600; ++n) {
    if (fs::exists(said) && content_of(said).find(words) != std::string::npos) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return false;
}

/// Asks for the clay and reads nothing of it until it is told to.
class SilentReader {
 public:
  explicit SilentReader(const std::string& port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(std::stoi(port)));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int small = 4096;
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &small, sizeof small);
    for (int n = 0; n < 300 && !is_connected; ++n) {
      is_connected =
          ::connect(socket_, std::bit_cast<const sockaddr*>(&address), sizeof address) == 0;
      if (!is_connected) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    std::vector<std::byte> proven(sizeof(haptics::BridgeKey::Nonce));
    ::recv(socket_, proven.data(), proven.size(), MSG_WAITALL);
    haptics::MeshAsk own;
    std::memcpy(&own.sequence, haptics::BridgeKey::nonce().data(), sizeof own.sequence);
    std::vector<std::byte> ask = encode(own);
    proven.insert(proven.end(), ask.begin(), ask.end());
    const auto key = key_of_bridge(port);
    if (!key) return;
    const auto tag = key->tag(haptics::BridgeSender::simulator, proven);
    ask.insert(ask.end(), tag.begin(), tag.end());
    ::send(socket_, ask.data(), ask.size(), MSG_NOSIGNAL);
  }
  ~SilentReader() { ::close(socket_); }
  SilentReader(const SilentReader&) = delete;
  SilentReader& operator=(const SilentReader&) = delete;

  /// Reads a little, again and again, until there is no more; whether that ends as it should, by
  /// END.
  bool trickle(std::atomic<bool>& is_reading, const std::atomic<bool>& is_over) {
    std::vector<std::byte> last;
    std::array<std::byte, 1024> some;
    for (;;) {
      const ssize_t got = ::recv(socket_, some.data(), some.size(), 0);
      if (got <= 0) break;
      is_reading = true;
      last.insert(last.end(), some.begin(), some.begin() + got);
      if (last.size() > haptics::kMeshEndBytes) {
        last.erase(last.begin(), last.end() - haptics::kMeshEndBytes);
      }
      if (!is_over) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    const auto message = haptics::decode_mesh(last);
    return message && std::holds_alternative<haptics::MeshEnd>(*message);
  }
  bool is_connected = false;

 private:
  int socket_;
};

TEST(BridgeClayStandInClient, IsHeldUpByNoReaderThatReadsNothing) {
  ARGIL_CLIENT_OR_SKIP("python3");
  const ScratchFolder folder;
  const fs::path project = small_project(folder);
  const std::string port = free_port();
  std::optional<SilentReader> silent;
  std::thread connects([&] { silent.emplace(port); });
  const std::string stl = (folder / "shown.stl").string();
  const json run = bridged(stand_in(port, {"--save", stl}), port, project, kCarve);
  connects.join();
  EXPECT_TRUE(silent->is_connected);
  EXPECT_EQ(run["clay"]["readers"], 2);
  EXPECT_EQ(run["faults"], json::array()) << "no window came late";
  expect_shown(stl, project);
}

/// One that takes a little again and again would have it wait for half a minute.
TEST(BridgeClayStandInClient, EndsForCtrlCWhateverAReaderDoes) {
  ARGIL_CLIENT_OR_SKIP("python3");
  const ScratchFolder folder;
  const fs::path project = small_project(folder, 0.05, 40.0);  // more than lies in sockets
  const std::string port = free_port();
  const fs::path said = folder / "said";
  Beside beside(stand_in(port), said);
  std::atomic<bool> is_reading = false;
  std::atomic<bool> is_over = false;
  bool has_end = true;
  std::thread reads([&] { has_end = SilentReader(port).trickle(is_reading, is_over); });
  RunOptions ended;
  ended.interrupt_when = [&] {
    return is_reading && content_of(said).find(": coupled") != std::string::npos;
  };
  const Ended run = run_argil({"bridge", "--port", port, "--wait", "60", "--clay", project.string(),
                               "--tool", "ball:3", "--motion", "free", "--json"},
                              ended);
  is_over = true;
  reads.join();
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.json()["clay"]["hash"], hash_of(project));
  EXPECT_FALSE(has_end) << "the bridge was held by who reads slowly";
  EXPECT_FALSE(fs::exists(folder / "ball.journal.jsonl"));
}

/// Strokes of 10 ms until one is due, which cannot be: its name leads to what is no file.
TEST(BridgeClayStandInClient, SaysThatAnAutosaveFailedAndGoesOn) {
  ARGIL_CLIENT_OR_SKIP("python3");
  const ScratchFolder folder;
  const fs::path project = small_project(folder, 1.0);
  std::ofstream motion(folder / "dabs.csv");
  motion << "0,0,2,0,0\n";
  for (int n = 0; n < 560; ++n) {
    const double at_s = 1.0 + 0.01 * n;
    motion << at_s << ',' << n % 5 - 2 << ",-1,0,0,1\n" << at_s + 0.005 << ",0,-1,0,0,0\n";
  }
  motion.close();
  const std::string port = free_port();
  const fs::path said = folder / "said";
  Beside beside(stand_in(port, {"--think-ms", "5"}), said);
  std::thread meddler([&] {
    EXPECT_TRUE(waits_for(said, ": coupled"));
    fs::create_symlink("/dev/null", folder / ".ball.autosave.vdb");
  });
  const Ended run = run_argil({"bridge", "--port", port, "--wait", "60", "--clay", project.string(),
                               "--tool", "ball:1", "--lockstep", "--motion",
                               (folder / "dabs.csv").string(), "--seconds", "7", "--json"});
  meddler.join();
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_GT(run.json()["clay"]["kept_strokes"], 510);
  EXPECT_EQ(run.json()["clay"]["refused_strokes"], 0);
  const std::size_t at = run.err.find("the autosave failed");
  ASSERT_NE(at, std::string::npos) << run.err;
  EXPECT_EQ(run.err.find("the autosave failed", at + 1), std::string::npos) << "once";
}

TEST(BridgeClayStandInClient, BelievesNoProofThatWasRecorded) {
  ARGIL_CLIENT_OR_SKIP("python3");
  const ProgramRun run = run_program({"python3", "tests/cli/bridge/proof.py"});
  EXPECT_EQ(run.status, 0) << run.output;
}

TEST(BridgeClayStandInClient, LosesNoStrokeWhenTheBridgeIsKilled) {
  ARGIL_CLIENT_OR_SKIP("python3");
  const ScratchFolder folder;
  const fs::path project = small_project(folder);
  const std::string before = hash_of(project);
  const std::string port = free_port();
  Beside beside(stand_in(port), folder / "said");
  RunOptions killed;
  killed.signal = SIGKILL;
  // The stroke ends at 3.5 s: it is in the journal some time after, and the journal at the project.
  const fs::path journal = folder / "ball.journal.jsonl";
  killed.interrupt_when = [&, lines = 0]() mutable {
    std::ifstream stream(journal);
    lines = 0;
    for (std::string line; std::getline(stream, line) && !stream.eof();) ++lines;  // whole ones
    return lines >= 2;
  };
  const Ended run = run_argil({"bridge", "--port", port, "--wait", "60", "--clay", project.string(),
                               "--tool", "ball:3", "--motion", "carve", "--seconds", "60"},
                              killed);
  EXPECT_EQ(run.signal, SIGKILL) << run.err;
  const Ended info = run_argil({"info", project.string(), "--json"});
  EXPECT_EQ(info.json()["recovered_strokes"], 1) << info.out << info.err;
  EXPECT_NE(info.json()["hash"], before);
}

TEST(BridgeClayStandInClient, RefusesAloudTheStrokeThatTheDiskDoesNotTake) {
  ARGIL_CLIENT_OR_SKIP("python3");
  const ScratchFolder folder;
  const fs::path project = small_project(folder);
  const std::string before = hash_of(project);
  const std::string port = free_port();
  const std::string stl = (folder / "shown.stl").string();
  Beside beside(stand_in(port, {"--save", stl}), folder / "said");
  RunOptions full;
  full.largest_file_bytes = 2000;  // the journal's first line and a piece of the stroke
  const Ended run =
      run_argil({"bridge", "--port", port, "--wait", "60", "--clay", project.string(), "--tool",
                 "ball:3", "--lockstep", "--motion", "carve", "--seconds", "4"},
                full);
  EXPECT_EQ(run.status, 5) << run.err;
  EXPECT_NE(run.err.find("the last one was taken back"), std::string::npos) << run.err;
  EXPECT_EQ(beside.wait(), 0);
  const std::string said = content_of(folder / "said");
  EXPECT_NE(said.find("strokes are refused until they can be kept"), std::string::npos) << said;
  EXPECT_NE(said.find("0 strokes kept, 1 refused"), std::string::npos) << said;
  EXPECT_EQ(hash_of(project), before);
  expect_shown(stl, project);
}

TEST(BridgeClayStandInClient, GoesOnWhenThereIsRoomAgain) {
  ARGIL_CLIENT_OR_SKIP("python3");
  const ScratchFolder folder;
  const fs::path disk = folder / "disk";
  fs::create_directory(disk);
  if (::mount("argil", disk.c_str(), "tmpfs", 0, "size=16m") != 0) {
    GTEST_SKIP()
        << "mounting a small tmpfs needs root; RefusesAloudTheStroke... fills a disk without";
  }
  const fs::path project = disk / "ball.vdb";
  fs::copy_file(small_project(folder), project);
  // Strokes of half a second, again and again.
  std::ofstream motion(folder / "dabs.csv");
  motion << "0,0,2,0,0\n";
  for (int n = 1; n < 200; ++n) {
    motion << 0.5 * n << ',' << n % 5 - 2 << ",-1,0,0" << (n % 2 == 1 ? ",1" : ",0") << "\n";
  }
  motion.close();
  const std::string port = free_port();
  const fs::path said = folder / "said";
  Beside beside(stand_in(port), said);
  std::atomic<bool> is_done = false;
  std::thread meddler([&] {
    EXPECT_TRUE(waits_for(said, ": coupled"));
    std::this_thread::sleep_for(std::chrono::seconds(2));
    fill(disk / "filler", std::string(20 << 20, 'x'));  // as much of it as there is room for
    EXPECT_TRUE(waits_for(said, "strokes are refused until they can be kept"));
    fs::remove(disk / "filler");
    EXPECT_TRUE(waits_for(said, "strokes are kept again"));
    std::this_thread::sleep_for(std::chrono::seconds(2));
    is_done = true;
  });
  RunOptions ended;
  ended.interrupt_when = [&] { return is_done.load(); };
  const Ended run =
      run_argil({"bridge", "--port", port, "--wait", "60", "--clay", project.string(), "--tool",
                 "ball:3", "--motion", (folder / "dabs.csv").string(), "--json"},
                ended);
  meddler.join();
  EXPECT_EQ(run.status, 0) << run.err;
  const json clay = run.json()["clay"];
  EXPECT_GE(clay["kept_strokes"], 2) << content_of(said);
  EXPECT_GE(clay["refused_strokes"], 1);
  EXPECT_EQ(clay["hash"], hash_of(project));
  ::umount(disk.c_str());
}

TEST(BridgeClay, SaysWhatToDoWithoutAProject) {
  const ScratchFolder folder;
  const Ended run = run_argil({"bridge", "--clay", (folder / "none.vdb").string()});
  EXPECT_EQ(run.status, 3);
  EXPECT_NE(run.err.find("argil import"), std::string::npos) << run.err;
}

TEST(BridgeClay, RefusesWhatOnlyASimulatorsForceHas) {
  for (const Words& other : {Words{"--coupling", "plane"}, Words{"--damping", "1"}}) {
    const Ended run = run_argil(with({"bridge", "--clay", "some.vdb"}, other));
    EXPECT_EQ(run.status, 2) << run.err;
    EXPECT_NE(run.err.find(other.front()), std::string::npos) << run.err;
  }
  EXPECT_EQ(run_argil({"bridge", "--tool", "ball:3"}).status, 2) << "of --clay alone";
}

TEST(BridgeClay, LeavesTheProjectAsItWasWhenNobodyComes) {
  const ScratchFolder folder;
  const fs::path project = small_project(folder);
  const std::string before = content_of(project);
  const Ended run =
      run_argil({"bridge", "--port", free_port(), "--wait", "0.2", "--clay", project.string()});
  EXPECT_EQ(run.status, 4) << run.err;
  EXPECT_EQ(content_of(project), before);
  EXPECT_FALSE(fs::exists(folder / "ball.journal.jsonl"));
}

TEST(BridgeClayStandInClient, TakesAndRefusesWhatTheCorpusSays) {
  ARGIL_CLIENT_OR_SKIP("python3");
  const ProgramRun run = run_program({"python3", "tests/cli/bridge/clay_corpus.py"});
  EXPECT_EQ(run.status, 0) << run.output;
}

TEST(BridgeClayBlenderClient, IsShownByTheAddOn) {
  ARGIL_CLIENT_OR_SKIP("blender");
  const ScratchFolder folder;
  const fs::path project = small_project(folder);
  const std::string port = free_port();
  const json run = bridged({"blender", "-b", "--factory-startup", "--python-exit-code", "3",
                            "--python", "tests/cli/bridge/addon.py", "--", port, "12", "clay"},
                           port, project, {"--seconds", "5", "--motion", "carve"});
  // Real time on any machine: how much is felt depends on how late the clay answers.
  EXPECT_GT(run["most_force_n"].get<double>(), 0.0) << run;
  EXPECT_EQ(run["clay"]["strokes"], 1);
  EXPECT_EQ(run["sessions"], 1);
}

}  // namespace
}  // namespace argil::test
