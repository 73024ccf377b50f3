// SPDX-License-Identifier: GPL-3.0-or-later
// A device and its servo in the process of a simulator: `argil bridge` without a program and a
// socket.
#include "bridge.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "argil/haptics/bridge/bridge_run.h"
#include "argil/haptics/bridge/bridge_session.h"
#include "argil/haptics/servo/servo_run.h"
#include "argil/haptics/simulation/sim_falcon.h"

#include "arrays.h"
#include "choice.h"
#include "common/falcon_options.h"
#include "common/hand_option.h"
#include "memory_link.h"
#include "work.h"

namespace argil::python {
namespace {

constexpr double kTickS = 1e-3;

haptics::BridgeLaw law_of(const std::string& law) {
  Words<haptics::BridgeLaw> known;
  for (const auto one :
       {haptics::BridgeLaw::direct, haptics::BridgeLaw::indirect, haptics::BridgeLaw::plane}) {
    known.emplace_back(haptics::bridge_law_name(one), one);
  }
  return choice_of<haptics::BridgeLaw>("law", law, known);
}

haptics::Hand hand_of(const std::string& hand) {
  Words<haptics::Hand> known;
  for (const haptics::Hand one : cli::kHands)
    known.emplace_back(haptics::hand_model(one).name, one);
  return choice_of<haptics::Hand>("hand", hand, known);
}

/// Rows of t, x, y, z and how hard the hand presses along -y; times ascend.
std::vector<haptics::HandKey> keys_of(const Rows& motion) {
  check_columns("motion", motion, 5);
  std::vector<haptics::HandKey> keys(static_cast<std::size_t>(motion.shape(0)));
  if (keys.empty()) raise_bad_input("motion has no row; give t, x, y, z and the press in N");
  const double* row = motion.data();
  for (std::size_t n = 0; n < keys.size(); ++n, row += 5) {
    haptics::HandKey& key = keys[n];
    key.time_s = row[0];
    key.place_mm = {row[1], row[2], row[3]};
    key.press_n = row[4];
    const bool ascends = n == 0 || key.time_s > keys[n - 1].time_s;
    if (!(std::isfinite(key.time_s) && is_in_reach(key.place_mm) && key.press_n >= 0.0 &&
          key.press_n <= 8.0 && ascends)) {
      raise_bad_input(
          "motion[" + std::to_string(n) +
          "] is out of range: times ascend, places are within 1 km, and a hand presses 0 "
          "to 8 N");
    }
  }
  return keys;
}

/// Ticks from its making until `stop`.
class LocalBridge {
 public:
  LocalBridge(std::unique_ptr<haptics::Device> device, const haptics::BridgeTerms& terms)
      : device_(std::move(device)),
        session_(link_, terms),
        scene_(session_, {}),
        servo_(*device_, scene_, haptics::bridge_servo(kTickS)),
        driver_(session_, link_, [](const haptics::BridgeRow&) {}),
        thread_(std::in_place, servo_, &driver_) {}
  ~LocalBridge() {
    const InterpreterReleased released;
    thread_.reset();
  }
  LocalBridge(const LocalBridge&) = delete;
  LocalBridge& operator=(const LocalBridge&) = delete;

  MemoryLink& link() noexcept { return link_; }

  /// The servo's figures; the hand is let go.
  py::dict stop() {
    {
      const InterpreterReleased released;
      thread_->stop();
    }
    const haptics::ServoRun& run = thread_->stop();
    py::dict report;
    report["ticks"] = run.ticks;
    report["late_ticks"] = run.late_ticks;
    report["proxies"] = session_.counts().proxies;
    report["malformed"] = session_.counts().malformed;
    report["priority"] = thread_->priority_refusal();
    return report;
  }

 private:
  MemoryLink link_;
  std::unique_ptr<haptics::Device> device_;
  haptics::BridgeSession session_;
  haptics::BridgeScene scene_;
  haptics::Servo servo_;
  haptics::BridgeDriver driver_;
  std::optional<haptics::ServoThread> thread_;
};

std::unique_ptr<LocalBridge> make_bridge(const std::string& law, double stiffness_n_per_m,
                                         double damping_n_s_per_m, double scale,
                                         const std::string& device, const std::string& hand,
                                         const Rows& motion) {
  haptics::BridgeTerms terms;
  terms.law = law_of(law);
  terms.spring = {stiffness_n_per_m, damping_n_s_per_m};
  terms.scale = scale;
  terms.servo_period_s = kTickS;
  if (!(stiffness_n_per_m > 0.0 && stiffness_n_per_m <= 1e6 && damping_n_s_per_m >= 0.0 &&
        damping_n_s_per_m <= 20.0 && scale >= 1e-3 && scale <= 1e3)) {
    raise_bad_input(
        "stiffness_n_per_m must be above 0 up to 1e6, damping_n_s_per_m 0 to 20 and "
        "scale 0.001 to 1000");
  }
  std::unique_ptr<haptics::Device> felt;
  if (device == "sim") {
    felt = std::make_unique<haptics::SimFalcon>(haptics::FalconModel(),
                                                haptics::hand_model(hand_of(hand)),
                                                haptics::HandPlan(keys_of(motion)));
  } else if (device == "falcon") {
    felt = run([](const Progress& progress) {
      return cli::open_homed_falcon(cli::FalconChoice(), false, progress);
    });
  } else {
    raise_bad_input("device is '" + device + "'; must be sim or falcon");
  }
  terms.device_damping_n_s_per_m = felt->traits(kTickS).damping_n_s_per_m;
  // Of the direct law the simulator's rate decides, which its HELLO says.
  if (terms.law != haptics::BridgeLaw::direct &&
      !haptics::is_bridge_stable(stiffness_n_per_m, kTickS, terms.device_damping_n_s_per_m)) {
    raise_bad_input("stiffness_n_per_m is " + std::to_string(stiffness_n_per_m) +
                    ", which breaks k T < 2 b of a device of " +
                    std::to_string(terms.device_damping_n_s_per_m) + " N s/m; give less");
  }
  return std::make_unique<LocalBridge>(std::move(felt), terms);
}

/// In slices, between which Ctrl-C is heard.
bool wait_for_bridge(LocalBridge& self, double seconds) {
  if (!(seconds <= 3600.0)) raise_bad_input("seconds must be a number up to 3600");
  SignalWatch watch;
  bool has_come = false;
  {
    constexpr double kSliceS = 0.06;
    const InterpreterReleased released;
    for (double left = seconds; !has_come && left > 0.0 && watch.goes_on(); left -= kSliceS) {
      has_come = self.link().wait_to_take(std::min(left, kSliceS));
    }
  }
  watch.rethrow();
  return has_come;
}

py::object take(LocalBridge& self) {
  const auto datagram = self.link().take();
  if (!datagram) return py::none();
  return py::bytes(reinterpret_cast<const char*>(datagram->bytes.data()), datagram->size);
}

}  // namespace

void add_bridge(py::module_& module) {
  py::class_<LocalBridge>(module, "LocalBridge")
      .def(py::init(&make_bridge), py::arg("law"), py::arg("stiffness_n_per_m"),
           py::arg("damping_n_s_per_m"), py::arg("scale"), py::arg("device"), py::arg("hand"),
           py::arg("motion"))
      .def(
          "put",
          [](LocalBridge& self, const py::bytes& datagram) {
            const auto bytes = static_cast<std::string_view>(datagram);
            return self.link().put(std::as_bytes(std::span(bytes.data(), bytes.size())));
          },
          py::arg("datagram"))
      .def("take", &take)
      .def("wait", &wait_for_bridge, py::arg("seconds"))
      .def("stop", &LocalBridge::stop);
}

}  // namespace argil::python
