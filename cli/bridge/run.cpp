// SPDX-License-Identifier: GPL-3.0-or-later
// A bridge from its first HELLO to its BYE, in lockstep or on the machine's clock.
#include <atomic>
#include <cassert>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "argil/core/spsc_ring.h"
#include "argil/haptics/bridge/bridge_key.h"
#include "argil/haptics/bridge/bridge_shown.h"
#include "argil/haptics/bridge/bridge_udp.h"
#include "argil/haptics/bridge/sealed_link.h"
#include "argil/haptics/servo/guided_scene.h"
#include "argil/haptics/simulation/sim_falcon.h"
#include "argil/io/safe_file.h"

#include "bridge/bridge.h"
#include "bridge/clay.h"
#include "bridge/scene.h"
#include "common/command.h"
#include "common/hand_option.h"
#include "common/output.h"

namespace argil::cli::bridge {
namespace {

namespace fs = std::filesystem;
using haptics::BridgeRow;
using haptics::BridgeUdp;
using haptics::SealedLink;

constexpr double kBridgeSettleS = 4.0;
constexpr double kLookS = 0.01;
/// Four seconds of a main thread that does not look.
constexpr std::size_t kRingRows = 4096;

haptics::BridgeTerms terms_of(const BridgeOptions& options, double damping_n_s_per_m) {
  haptics::BridgeTerms terms;
  terms.law = static_cast<haptics::BridgeLaw>(options.law);
  terms.spring = options.spring;
  terms.scale = options.scale;
  terms.servo_period_s = kTickS;
  terms.device_damping_n_s_per_m = damping_n_s_per_m;
  // Of a force of our own the governor counts it.
  if (const auto filter = options.feel.filter(); filter && !haptics::is_own_force(terms.law)) {
    terms.filter_lag_s = haptics::filter_lag_s(*filter, kTickS);
  }
  terms.is_forced = options.is_forced;
  terms.is_lockstep = options.is_lockstep;
  return terms;
}

/// Why it is refused, and what to choose; `period_s` without the filter's lag.
std::string rule_text(const haptics::BridgeTerms& terms, double period_s) {
  assert(period_s > 0.0 && terms.filter_lag_s >= 0.0);
  const bool is_filtered = terms.filter_lag_s > 0.0;
  const double damping = terms.device_damping_n_s_per_m;
  const double most = 1.99 * damping / (period_s + 2.0 * terms.filter_lag_s);
  return number(terms.spring.stiffness_n_per_m) + " N/m every " + number(1e3 * period_s) + " ms" +
         (is_filtered ? ", felt " + number(1e3 * terms.filter_lag_s) + " ms late by --filter,"
                      : "") +
         " breaks k T < 2 b of a device of " + number(damping) +
         " N s/m; choose at most --stiffness " + number(most) +
         (is_filtered ? ", no --filter" : "") + ", or --force";
}

int delay_ticks_of(const haptics::Device& device) {
  return static_cast<int>(std::lround(device.traits(kTickS).delay_s / kTickS));
}

/// A simulated Falcon in a hand that moves as it is told, or a real one once a person has homed it.
Result<std::unique_ptr<haptics::Device>> device_of(const BridgeOptions& options,
                                                   std::vector<haptics::HandKey> motion, bool quiet,
                                                   const Progress& progress) {
  assert(options.hand < kHands.size() && !motion.empty());
  if (options.device == "falcon") return open_homed_falcon(options.falcon, quiet, progress);
  return std::unique_ptr<haptics::Device>(std::make_unique<haptics::SimFalcon>(
      haptics::FalconModel(), haptics::hand_model(kHands[options.hand]),
      haptics::HandPlan(std::move(motion))));
}

/// What of ours is felt, clay or a scene of the Falcon report; neither: a simulator's force.
struct OwnMatter {
  std::unique_ptr<BridgeClay> clay;
  std::unique_ptr<haptics::ForceScene> scene;

  haptics::ForceScene* felt() const noexcept { return clay ? &clay->scene() : scene.get(); }
  /// A scene of the report stands in the device's own frame.
  haptics::Placement place() const noexcept { return clay ? clay->place() : haptics::Placement(); }
};

/// The matter, guided along a path in its frame. Empty without: a simulator's scene has guidance of
/// its own, in the device's frame.
std::optional<haptics::GuidedScene> guided_matter(const OwnMatter& matter,
                                                  haptics::GuidanceOptions guidance,
                                                  const haptics::Device& device) {
  if (matter.felt() == nullptr) return std::nullopt;
  guidance.scale = matter.place().scale;
  return std::optional<haptics::GuidedScene>(std::in_place, *matter.felt(), std::move(guidance),
                                             delay_ticks_of(device));
}

/// What is felt: what the simulator says, or what of ours it shows.
std::unique_ptr<haptics::ForceScene> scene_of(haptics::BridgeSession& session,
                                              haptics::GuidanceOptions guidance,
                                              haptics::GuidedScene* guided,
                                              const OwnMatter& matter) {
  if (guided == nullptr)
    return std::make_unique<haptics::BridgeScene>(session, std::move(guidance));
  return std::make_unique<haptics::BridgeShownScene>(session, *guided, matter.place());
}

/// What is ours is felt as everywhere else: through the virtual coupling, under the governor.
haptics::ServoOptions servo_options(const BridgeOptions& options) {
  haptics::ServoOptions servo;
  if (haptics::is_own_force(static_cast<haptics::BridgeLaw>(options.law))) {
    servo.period_s = kTickS;
    servo.coupling.stiffness_n_per_m = options.spring.stiffness_n_per_m;
  } else {
    servo = haptics::bridge_servo(kTickS);
  }
  servo.position_filter = options.feel.filter();
  return servo;
}

/// The wire, and the key by which a simulator is known on it.
struct Wire {
  std::unique_ptr<BridgeUdp> udp;
  haptics::BridgeKey key;
  haptics::BridgeKeyFile key_file;
  SealedLink link{*udp, key, haptics::BridgeSender::bridge, udp->port()};
};

Result<std::unique_ptr<Wire>> open_wire(const BridgeOptions& options) {
  const std::uint32_t host = haptics::host_of(options.listen).value();
  auto udp = BridgeUdp::open({host, static_cast<std::uint16_t>(options.port)});
  if (!udp) return udp.error();
  const haptics::BridgeKey key = haptics::BridgeKey::random();
  const fs::path file =
      options.key.empty() ? haptics::usual_key_file(udp.value()->port()) : options.key;
  // After the port is bound: the usual name of the file holds its number.
  auto written = haptics::BridgeKeyFile::write(file, key);
  if (!written) return written.error();
  return std::unique_ptr<Wire>(new Wire{std::move(udp).value(), key, std::move(written).value()});
}

/// Device, servo and session. What follows uses what stands before it.
struct Coupled {
  Coupled(const BridgeOptions& options, std::unique_ptr<Wire> open,
          std::unique_ptr<haptics::Device> felt, haptics::GuidanceOptions guidance, OwnMatter shown)
      : wire(std::move(open)),
        device(std::move(felt)),
        matter(std::move(shown)),
        session(wire->link, terms_of(options, device->traits(kTickS).damping_n_s_per_m)),
        guided(guided_matter(matter, guidance, *device)),
        scene(scene_of(session, std::move(guidance), guided ? &*guided : nullptr, matter)),
        servo(*device, *scene, servo_options(options)) {}

  std::unique_ptr<Wire> wire;
  std::unique_ptr<haptics::Device> device;
  OwnMatter matter;
  haptics::BridgeSession session;
  std::optional<haptics::GuidedScene> guided;  ///< the matter
  std::unique_ptr<haptics::ForceScene> scene;
  haptics::Servo servo;

  BridgeClay* clay() const noexcept { return matter.clay.get(); }
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Until a simulator has greeted. The servo begins only then.
Result<void> await_simulator(Coupled& coupled, const BridgeOptions& options, bool quiet,
                             const Progress& progress) {
  const haptics::BridgeAddress at = coupled.wire->udp->address();
  const std::string key = coupled.wire->key_file.path().string();
  if (at.host != haptics::kLoopbackHost) {
    std::fprintf(
        stderr,
        "argil: listening on %s: every machine that reaches it is heard if it has the key, "
        "and whoever is between them can read what is said and alter the clay that is shown\n",
        options.listen.c_str());
  }
  if (!quiet) {
    std::fprintf(stderr, "argil: waiting for a simulator on %s port %d, with the key in '%s'\n",
                 options.listen.c_str(), at.port, key.c_str());
  }
  const auto start = std::chrono::steady_clock::now();
  std::uint64_t refused = 0;
  while (true) {
    coupled.wire->link.wait(kLookS);
    coupled.session.receive(0.0);
    // Who was welcomed has come: an interrupt in the same moment ends a run, not the wait for one.
    if (coupled.session.has_simulator()) return {};
    if (coupled.session.counts().refused > refused) {
      const haptics::BridgeTerms& terms = coupled.session.terms();
      std::fprintf(stderr, "argil: refused a simulator: %s\n",
                   rule_text(terms, haptics::bridge_period_s(terms.law, terms.servo_period_s,
                                                             coupled.session.refused_rate_hz()))
                       .c_str());
      refused = coupled.session.counts().refused;
    }
    if (!progress("waiting", 0.0)) {
      return Error{ErrorKind::interrupted, "interrupted; no simulator had come"};
    }
    if (options.wait_s > 0.0 && seconds_since(start) > options.wait_s) {
      return Error{ErrorKind::device,
                   "no simulator was welcomed on port " + std::to_string(at.port) + " within " +
                       number(options.wait_s) + " s; start it, or check its port and its key"};
    }
  }
}

/// Where rows go on the main thread.
class RowSink {
 public:
  RowSink(BridgeWindow& window, std::ostream* log, const Json& scene) : window_(window), log_(log) {
    if (log_ != nullptr) write_log_header(*log_, scene);
  }
  void take(const BridgeRow& row) {
    window_.add(row);
    if (log_ != nullptr) write_log_row(*log_, row);
  }

 private:
  BridgeWindow& window_;
  std::ostream* log_;
};

Result<void> run_lockstep(Coupled& coupled, double seconds, RowSink& sink, BridgeReport& report,
                          const Progress& progress) {
  std::atomic<bool> is_over = false;
  bool is_interrupted = false;
  double time_s = 0.0;
  const auto goes_on = [&] {
    is_interrupted = is_interrupted || !progress("bridge", time_s / seconds);
    return !is_interrupted;
  };
  Result<void> worked;  // the clay's first error
  const haptics::BridgeDriver* running = nullptr;
  haptics::BridgeDriver driver(
      coupled.session, coupled.wire->link,
      [&](const BridgeRow& row) {
        sink.take(row);
        time_s = row.tick.time_s;
        if (coupled.clay() && worked) worked = coupled.clay()->after_tick(time_s);
        // A quarter of a second of the servo's time between two looks.
        if ((row.tick.number % 256 == 0 && !goes_on()) || running->is_over() || !worked)
          is_over = true;
      },
      goes_on);
  running = &driver;
  haptics::VirtualClock clock;
  report.servo = haptics::run_servo(coupled.servo, clock, seconds, is_over, &driver);
  if (!worked) return worked;
  if (is_interrupted) {
    return Error{ErrorKind::interrupted, coupled.clay() ? "interrupted; the project has its strokes"
                                                        : "interrupted; nothing was written"};
  }
  if (driver.is_unanswered()) {
    return Error{ErrorKind::device, "the simulator does not answer in lockstep; see what it says"};
  }
  if (const haptics::BridgeCounts& counts = coupled.session.counts(); counts.proxies == 0) {
    return Error{ErrorKind::device, "the simulator left without an answer; " +
                                        std::to_string(counts.malformed) +
                                        " datagrams were malformed; see what it says"};
  }
  return {};
}

Result<void> run_bridge_real_time(Coupled& coupled, double seconds, RowSink& sink,
                                  BridgeReport& report, bool quiet, const Progress& progress) {
  if (coupled.clay()) {
    if (auto started = coupled.clay()->start(); !started) return started;
  }
  SpscRing<BridgeRow> ring(kRingRows);
  haptics::BridgeDriver driver(coupled.session, coupled.wire->link,
                               [&](const BridgeRow& row) { ring.push(row); });
  const auto drain = [&] {
    for (BridgeRow row; ring.pop(row);) sink.take(row);
  };
  const auto start = std::chrono::steady_clock::now();
  haptics::ServoThread thread(coupled.servo, &driver);
  note_refusal(thread.priority_refusal(), quiet);
  // Ctrl-C is how a bridge without --seconds is ended: no error.
  while (progress("bridge", seconds > 0.0 ? seconds_since(start) / seconds : 0.0) &&
         (seconds <= 0.0 || seconds_since(start) < seconds)) {
    std::this_thread::sleep_for(std::chrono::duration<double>(kLookS));
    drain();
  }
  // What was pushed before the end is still in the ring.
  report.servo = thread.stop();
  drain();
  report.priority = thread.priority_refusal();
  report.dropped = ring.dropped();
  return {};
}

/// Says goodbye, and keeps what was made of the clay, however the run went: the first error counts.
Result<void> end_run(Coupled& coupled, Result<void> ran, BridgeReport& report) {
  // The clay first: its last blocks belong to what the simulator shows.
  const Result<void> worked = coupled.clay() ? coupled.clay()->end_work() : Result<void>();
  coupled.session.leave();
  if (coupled.clay()) coupled.clay()->finish();
  io::forget_interrupt();  // which is the usual end: project, log and picture are kept all the same
  if (!coupled.clay()) return ran;
  const Result<void> kept = coupled.clay()->close();
  report.clay = coupled.clay()->report();
  return !ran ? ran : !worked ? worked : kept;
}

Result<BridgeReport> run_logged(const BridgeOptions& options, Coupled& coupled, double seconds,
                                std::ostream* log, bool quiet, const Progress& progress) {
  BridgeReport report;
  BridgeWindow window(kTickS);
  RowSink sink(window, log, scene_json(options));
  Result<void> ran = options.is_lockstep ? run_lockstep(coupled, seconds, sink, report, progress)
                                         : run_bridge_real_time(coupled, options.seconds, sink,
                                                                report, quiet, progress);
  if (auto ended = end_run(coupled, std::move(ran), report); !ended) return ended.error();
  report.counts = coupled.session.counts();
  report.sealed = coupled.wire->link.counts();
  report.latency = coupled.session.latency();
  report.simulator_rate_hz = coupled.session.rate_hz();
  report.last = window.summary();
  return report;
}

/// The log is whole or not there. A run in real time that Ctrl-C ended is whole.
Result<BridgeReport> run_to_file(const BridgeOptions& options, Coupled& coupled, double seconds,
                                 bool quiet, const Progress& progress) {
  BridgeReport report;
  bool has_run = false;
  auto kept = io::replace_file(options.log, [&](const fs::path& part) -> Result<void> {
    std::ofstream stream(part, std::ios::binary);
    has_run = true;
    auto ran = run_logged(options, coupled, seconds, &stream, quiet, progress);
    if (!ran) return ran.error();
    report = std::move(ran).value();
    stream.close();
    if (stream) return {};
    return Error{ErrorKind::disk, "cannot write '" + options.log.string() + "'; is the disk full?"};
  });
  if (!has_run) kept = end_run(coupled, std::move(kept), report);
  if (!kept) return kept.error();
  return report;
}

/// While it lives, a program that is told to end does so within a second, in a library that asks
/// nobody too: there is nothing to save yet.
class EndsSoon {
 public:
  EndsSoon()
      : watch_([](const std::stop_token& stop) {
          while (!stop.stop_requested() && io::ending_signal() == 0) {
            std::this_thread::sleep_for(std::chrono::duration<double>(kLookS));
          }
          if (io::ending_signal() != 0) end_within_a_second();
        }) {}

 private:
  std::jthread watch_;
};

/// Null where no clay is asked for.
Result<std::unique_ptr<BridgeClay>> clay_of(const BridgeOptions& options, const Wire& wire,
                                            const Progress& progress) {
  if (options.law != static_cast<std::size_t>(haptics::BridgeLaw::clay)) {
    return std::unique_ptr<BridgeClay>();
  }
  std::optional<EndsSoon> watch;  // a real device is to have its last words
  if (options.device != "falcon") watch.emplace();
  return BridgeClay::open(options, wire.udp->address(), wire.key, progress);
}

/// Whether what is felt can be held steadily, as far as that is known before a simulator comes.
Result<void> check_force(const BridgeOptions& options) {
  const haptics::BridgeTerms terms = terms_of(options, haptics::FalconModel().damping_n_s_per_m);
  if (haptics::is_own_force(terms.law)) return check_own_force(options);
  const double period_s = kTickS + 2.0 * terms.filter_lag_s;
  // Of the direct law the simulator's rate decides, which its HELLO says.
  if (terms.law != haptics::BridgeLaw::direct && !terms.is_forced &&
      !haptics::is_bridge_stable(terms.spring.stiffness_n_per_m, period_s,
                                 terms.device_damping_n_s_per_m)) {
    return Error{ErrorKind::bad_input, "--stiffness: " + rule_text(terms, kTickS)};
  }
  return {};
}

}  // namespace

Result<BridgeReport> run_bridge(const BridgeOptions& options, bool quiet,
                                const Progress& progress) {
  if (options.is_lockstep && options.device != "sim") {
    return Error{
        ErrorKind::bad_input,
        "--lockstep runs on virtual time, which a real Falcon does not keep; leave it out, "
        "or choose --device sim"};
  }
  if (auto good = check_force(options); !good) return good.error();
  auto motion = motion_of(options);
  if (!motion) return motion.error();
  auto guidance = guidance_of(options.guidance);
  if (!guidance) return guidance.error();
  const double planned_s = motion.value().back().time_s + kBridgeSettleS;
  auto wire = open_wire(options);
  if (!wire) return wire.error();
  auto device = device_of(options, std::move(motion).value(), quiet, progress);
  if (!device) return device.error();
  auto clay = clay_of(options, *wire.value(), progress);
  if (!clay) return clay.error();
  const auto coupled = std::make_unique<Coupled>(
      options, std::move(wire).value(), std::move(device).value(), std::move(guidance).value(),
      OwnMatter{std::move(clay).value(), make_scene(options)});
  if (auto came = await_simulator(*coupled, options, quiet, progress); !came) {
    BridgeReport none;
    return end_run(*coupled, std::move(came), none).error();
  }
  const double seconds = options.seconds > 0.0 ? options.seconds : planned_s;
  if (options.log.empty()) return run_logged(options, *coupled, seconds, nullptr, quiet, progress);
  return run_to_file(options, *coupled, seconds, quiet, progress);
}

}  // namespace argil::cli::bridge
