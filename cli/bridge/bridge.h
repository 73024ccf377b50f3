// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/haptics/bridge/bridge_run.h"
#include "argil/haptics/bridge/sealed_link.h"
#include "argil/haptics/force/tool_force.h"
#include "argil/haptics/servo/servo_run.h"
#include "argil/haptics/simulation/hand_model.h"

#include "common/command.h"
#include "common/falcon_options.h"
#include "common/feel_options.h"
#include "common/guidance_option.h"
#include "play/scene_option.h"

namespace argil::cli::bridge {

/// Of the servo, whatever the simulator's rate is.
inline constexpr double kTickS = 1e-3;

/// Of clay that a simulator shows.
struct BridgeClayOptions {
  std::filesystem::path project;  ///< "": there is none
  haptics::ForceTool tool{haptics::ToolShape::ellipsoid, {4.0, 4.0, 4.0}, {}, {}, {}, {}};
  std::size_t action = 1;  ///< which of kWorkActions
  haptics::ForceMaterial material;
};

/// What the command line chose. Names are those of the options.
struct BridgeOptions {
  std::size_t law = 2;  ///< of BridgeLaw; `clay` or `scene` where there is one
  BridgeClayOptions clay;
  std::string scene;  ///< of the catalogue; "": none
  SceneSettings settings;
  int port = 0;
  std::filesystem::path key;         ///< "": usual_key_file
  std::string listen = "127.0.0.1";  ///< as host_of takes it
  haptics::BridgeSpring spring;
  FeelChoice feel;  ///< its mix is of clay
  double scale = 1.0;
  bool is_forced = false;
  bool is_lockstep = false;
  std::string device = "sim";  ///< or falcon
  FalconChoice falcon;
  std::size_t hand = 2;  ///< push, light, arm, firm
  std::string motion;    ///< press, slide, carve, free, or a file; "": the usual one
  double press_n = 3.0;
  double seconds = 0.0;  ///< 0: until Ctrl-C; in lockstep: until the motion is over and 4 s
  double wait_s = 0.0;   ///< 0: for ever
  GuidanceChoice guidance;
  std::filesystem::path log;
  std::filesystem::path plot;
};

/// Keys of the simulated hand, its device's frame. The built-in motions have their surface at y =
/// 0: `press` taps it at the origin and presses, `slide` goes on along x by 40 mm in two seconds,
/// `carve` by 16 mm, its button held, 2 mm deep, and presses again, `free` stays 10 mm above. Else
/// FILE: lines of time_s,x_mm,y_mm,z_mm, the press in N along -y and, where wanted, 1 to hold the
/// button until the next line. Usual is `press`, and with a scene what the lab's hand does there.
/// Errors  as read_numbers.
Result<std::vector<haptics::HandKey>> motion_of(const BridgeOptions& options);

/// Lines of `columns` numbers parted by commas, and up to `more` behind them; empty lines and those
/// that begin with # are left out.
/// Errors  bad_input naming file and line, and where there is no line at all.
Result<std::vector<std::vector<double>>> read_numbers(const std::filesystem::path& file,
                                                      std::size_t columns, std::size_t more = 0);

/// The last two seconds of a run.
class BridgeWindow {
 public:
  explicit BridgeWindow(double period_s);
  void add(const haptics::BridgeRow& row);

  struct Summary {
    Vec3 force_mean_n;
    double force_deviation_n = 0.0;  ///< the largest distance from the mean
    double force_rms_n = 0.0;        ///< of that distance
    double most_force_n = 0.0;       ///< of the whole run
    double depth_mm = 0.0;           ///< mean, behind the simulator's plane where it sends one
    int contact_breaks = 0;          ///< from some force to none
  };
  Summary summary() const;

 private:
  std::size_t most_rows_;
  std::deque<haptics::BridgeRow> rows_;
  double most_force_n_ = 0.0;
};

/// Both sides of each tick as CSV: with a scene a line "# " and what scene_json says of it, a
/// header that names units, every number to its last bit. Nothing in it depends on real time when
/// the run is in lockstep.
void write_log_header(std::ostream& stream, const Json& scene);
void write_log_row(std::ostream& stream, const haptics::BridgeRow& row);

/// Draws a log: handle and proxy, force, contact, and the fraction of the
/// simulator's force that is felt, over time.
/// Errors  as draw_plot.
Result<void> draw_log(const std::filesystem::path& picture, const std::filesystem::path& log,
                      const std::string& title);

struct BridgeReport {
  haptics::ServoRun servo;
  std::string priority;  ///< why a real-time run had none; "" otherwise
  haptics::BridgeCounts counts;
  haptics::SealedCounts sealed;
  haptics::Histogram latency;
  double simulator_rate_hz = 0.0;
  std::uint64_t dropped = 0;  ///< rows that the log could not take
  BridgeWindow::Summary last;
  Json clay;  ///< as BridgeClay reports it; null without
};

/// Waits for a simulator, couples it with the device, and leaves.
/// Errors  bad_input, device when the port is taken, nobody comes in time, or a simulator in
///         lockstep does not answer; disk; of the clay as BridgeClay. Whatever ends it, the clay's
///         project has every finished stroke.
Result<BridgeReport> run_bridge(const BridgeOptions& options, bool quiet, const Progress& progress);

}  // namespace argil::cli::bridge
