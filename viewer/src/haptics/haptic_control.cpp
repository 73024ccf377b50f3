// SPDX-License-Identifier: GPL-3.0-or-later
#include "haptics/haptic_control.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>

#include "argil/haptics/scene/scene_catalogue.h"

#include "document/touch.h"
#include "haptics/felt_tool.h"
#include "haptics/recording_note.h"

namespace argil::viewer {
namespace {

/// A change of the brush takes effect this long after the last start, so that dragging a slider
/// does not restart the servo with each pixel.
constexpr double kSettleS = 0.4;
/// Half the part of the Falcon's reach over which a clay is spread.
constexpr double kHalfReachMm = 45.0;

/// The mouse runs no rig; the options asked about for it are those of a simulated device.
haptics::RigDevice rig_device(DeviceChoice choice) noexcept {
  switch (choice) {
    case DeviceChoice::falcon:
      return haptics::RigDevice::falcon;
    case DeviceChoice::replay:
      return haptics::RigDevice::replay;
    case DeviceChoice::sim:
    case DeviceChoice::mouse:
      break;
  }
  return haptics::RigDevice::sim;
}

/// Whether two brushes are felt and work alike: what is left out needs no new rig.
bool are_same(const Brush& a, const Brush& b) noexcept {
  const bool have_same_image = a.alpha == b.alpha && a.alpha_mode == b.alpha_mode &&
                               a.amplitude == b.amplitude && a.mid_level == b.mid_level &&
                               a.angle_deg == b.angle_deg && a.use_rake == b.use_rake &&
                               a.tile == b.tile && a.tip_roundness == b.tip_roundness;
  if (a.action == Action::emboss && !have_same_image) return false;
  return a.action == b.action && shape_of(a) == shape_of(b) && a.height == b.height &&
         a.turn_deg == b.turn_deg && a.mesh == b.mesh && a.strength == b.strength &&
         a.is_inverted == b.is_inverted && a.spacing == b.spacing && a.steady_mm == b.steady_mm &&
         a.mirror.x == b.mirror.x && a.mirror.y == b.mirror.y && a.mirror.z == b.mirror.z &&
         a.radial.count == b.radial.count && a.radial.axis == b.radial.axis;
}

}  // namespace

HapticControl::HapticControl(UiState& ui, DocumentThread& document, haptics::FalconOptions falcon)
    : ui_(ui), document_(document), falcon_(std::move(falcon)) {}

haptics::RigOptions HapticControl::wanted_options() const {
  const HapticChoice& choice = ui_.haptics;
  haptics::RigOptions options;
  options.device = rig_device(choice.device);
  options.falcon = falcon_;
  options.falcon.firmware = ui_.firmware;
  options.replay_file = choice.replay_file;
  options.hand = choice.hand;
  options.coupling =
      choice.is_direct ? haptics::CouplingKind::direct : haptics::CouplingKind::indirect;
  options.coupling_stiffness_n_per_m = choice.stiffness_n_per_m;
  options.damping = choice.damping;
  options.scene = choice.scene;
  options.has_vibro = choice.has_vibro;
  options.scene_settings = choice.scene_settings;
  options.material = choice.material;
  options.mix = choice.mix;
  options.mix_ramp_s = choice.mix_ramp_s;
  if (choice.is_filtered) options.position_filter = choice.filter;
  options.tool = felt_tool(ui_.brush, radius_on(ui_.brush, 1.0));
  options.own_cut_mm = own_cut_mm(ui_.brush, radius_on(ui_.brush, 1.0));
  options.heartbeat = &heartbeat_;
  // A scene of the catalogue stands in the device's own frame; the clay is scaled into its reach.
  if (const haptics::SceneEntry* scene = haptics::find_scene(choice.scene)) {
    haptics::SceneValues values(scene->parameters);
    // What is out of range is said by the rig, when it starts.
    static_cast<void>(values.set_all(choice.scene_settings));
    options.start_mm = scene->start_mm(values);
    return options;
  }
  const Box3& box = ui_.clay.bounds_mm;
  const double half = 0.5 * std::max({box.size().x, box.size().y, box.size().z});
  options.placement.scale =
      std::clamp(choice.scale > 0.0 ? choice.scale : half / kHalfReachMm, 0.05, 20.0);
  options.placement.offset_mm = box.center();
  options.placement.is_z_up = true;
  // Until there is a path, nothing guides.
  if (!choice.guidance.path_mm.empty()) options.guidance = choice.guidance;
  options.start_mm = {0.0, 0.0, 60.0};  // before the clay
  return options;
}

double HapticControl::most_surface_force_n() const {
  constexpr double kMostN = 8.0;
  if (!ui_.haptics.is_direct || ui_.haptics.scene != "clay") return kMostN;
  const haptics::RigOptions options = wanted_options();
  const double limit = haptics::most_direct_stiffness_n_per_m(options);
  const double felt = options.placement.scale * options.mix.contact_passive;
  assert(limit > 0.0 && felt > 0.0);
  // Stiffness grows in proportion to the surface force: that of 1 N tells that of all.
  haptics::ForceMaterial one = options.material;
  one.surface_force_n = 1.0;
  // A little less, so that rounding puts no choice outside.
  const double most = 0.999 * limit / (felt * most_stiffness_n_per_m(one));
  return std::min(kMostN, most);
}

bool HapticControl::is_as_wanted() const {
  return running_ == ui_.haptics && firmware_ == ui_.firmware && are_same(brush_, ui_.brush) &&
         radius_mm_ == radius_on(ui_.brush, 1.0) && clay_ == ui_.clay.file &&
         piece_ == active_key(ui_.clay);
}

Result<void> HapticControl::start(double now_s) {
  assert(ui_.haptics.device != DeviceChoice::mouse);
  tried_s_ = now_s;
  running_ = ui_.haptics;
  firmware_ = ui_.firmware;
  brush_ = ui_.brush;
  radius_mm_ = radius_on(ui_.brush, 1.0);
  clay_ = ui_.clay.file;
  piece_ = active_key(ui_.clay);
  last_hit_.reset();
  // Noted before it starts: what cannot be started is not tried again until something changes.
  if (auto started = rig_.start(wanted_options()); !started) {
    stop();
    return started;
  }
  if (!rig_.priority_refusal().empty() && !std::exchange(is_refusal_told_, true)) {
    ui_.notices.push_back({Notice::Kind::warning, rig_.priority_refusal()});
  }
  Tool tool = tool_of(brush_with(ui_.brush, {}), rig_.options().tool.radii_mm.x);
  StrokeStyle style = style_of(ui_.brush);
  style.has_dots = false;  // a device tells where it is 200 times a second
  document_.send(LinkHaptics{&rig_.ring(), &rig_.channel(), &heartbeat_, tool, style, piece_});
  return {};
}

void HapticControl::stop() {
  document_.send(UnlinkHaptics{});
  // What the recording lost is reported by stop_recording, which comes first.
  [[maybe_unused]] const auto stopped = rig_.stop();
}

/// Stopping comes last, so that it wins where both were asked for in one frame. Without a device
/// there is no force to stop.
void HapticControl::obey() {
  const bool has_device = ui_.haptics.device != DeviceChoice::mouse;
  if (std::exchange(ui_.wants_force, false)) rig_.resume();
  if (std::exchange(ui_.wants_emergency_stop, false) && has_device) rig_.halt();
  ui_.is_force_stopped = has_device && rig_.is_halted();
}

Result<void> HapticControl::tick(double now_s, const std::optional<SurfaceHit>& hit, bool presses) {
  obey();
  const bool wants = ui_.haptics.device != DeviceChoice::mouse && ui_.clay.has_clay;
  Result<void> done;
  if (!wants) {
    if (rig_.is_running()) stop();
    running_.device = DeviceChoice::mouse;
  } else if (!is_as_wanted() && !was_pressing_ && now_s - tried_s_ > kSettleS) {
    done = start(now_s);
  }
  // A press beside the clay does not work at the position where the hand was left.
  if (!presses || hit) is_on_clay_ = hit.has_value();
  if (rig_.is_running()) {
    rig_.set_clutched(ui_.is_clutched);
    lead(hit, presses && is_on_clay_);
  }
  was_pressing_ = presses;
  return done;
}

/// The simulated hand aims a little below the surface under the pointer, so that it presses; beside
/// the clay it keeps its depth.
void HapticControl::lead(const std::optional<SurfaceHit>& hit, bool presses) {
  assert(rig_.is_running());
  if (hit) last_hit_ = hit;
  const haptics::RigSnapshot& seen = rig_.look();
  most_force_n_ = std::max(most_force_n_, length(seen.tick.force_n));
  if (running_.device != DeviceChoice::sim || running_.scene != "clay" || !last_hit_) return;
  const Vec3 position = pressed_position(rig_.options().tool, *last_hit_, running_.press_mm);
  rig_.lead({seen.placement.to_device(position), true, presses});
}

Result<std::filesystem::path> HapticControl::toggle_recording() {
  if (rig_.is_recording()) {
    if (auto stopped = rig_.stop_recording(); !stopped) return stopped.error();
    return recording_;
  }
  const std::filesystem::path folder = ui_.folder.empty() ? "." : ui_.folder;
  // The first name that is free: a recording never replaces another.
  int n = 1;
  std::error_code error;
  const auto name = [&] { return folder / ("argil-run-" + std::to_string(n) + ".csv"); };
  while (std::filesystem::exists(name(), error)) ++n;
  recording_ = name();
  const std::string note = recording_note(clay_.filename().string(), rig_.options());
  if (auto started = rig_.start_recording(recording_, note); !started) return started.error();
  return std::filesystem::path();
}

}  // namespace argil::viewer
