// SPDX-License-Identifier: GPL-3.0-or-later
// Single holds: what fixes what.
#include "stability/cases.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <sstream>

#include "argil/haptics/scene/scene_wall.h"

#include "common/output.h"
#include "stability/clay.h"

namespace argil::evaluation {
namespace {

/// A scene with a damper wherever it pushes, which never pulls.
class DampedScene final : public haptics::ForceScene {
 public:
  DampedScene(haptics::ForceScene& scene, double damping_n_s_per_m)
      : scene_(scene), damping_n_s_per_mm_(1e-3 * damping_n_s_per_m) {}
  haptics::SceneForce force_at(const haptics::HandleState& handle) const noexcept override {
    haptics::SceneForce felt = scene_.force_at(handle);
    if (felt.force_n.y <= 0.0) return felt;
    felt.force_n.y =
        std::max(0.0, felt.force_n.y - damping_n_s_per_mm_ * handle.velocity_mm_per_s.y);
    return felt;
  }

 private:
  haptics::ForceScene& scene_;
  double damping_n_s_per_mm_;
};

/// What is pressed into, and where the handle rests there.
struct Contact {
  std::string name;
  std::function<std::unique_ptr<haptics::ForceScene>()> make;
  double rest_mm = 0.0;
};

Contact wall(const std::string& name, haptics::WallKind kind, double value, double damping = 0.0) {
  haptics::WallOptions options;
  options.kind = kind;
  options.offset_mm = 0.0;
  (kind == haptics::WallKind::rigid ? options.rigid_force_n : options.stiffness_n_per_m) = value;
  options.damping_n_s_per_m = damping;
  // Where 3 N are felt: a rigid wall gives them at its face.
  const double rest_mm = kind == haptics::WallKind::rigid ? 0.0 : -1e3 * kPressN / value;
  return {name, [options] { return std::make_unique<haptics::WallScene>(options); }, rest_mm};
}

Contact field_contact(double slope_n_per_m) {
  return {
      "field " + cli::number(slope_n_per_m),
      [slope_n_per_m] { return std::make_unique<ClayPlane>(0.0, material_of(4.0, slope_n_per_m)); },
      0.0};
}

/// What is done about it.
struct Help {
  std::string name;
  haptics::ServoOptions servo = haptics::bare_servo(1e-3);
  std::optional<double> force_gain;
  std::optional<double> damping_n_s_per_m;
};

Help direct(double period_s = 1e-3) {
  return {"direct", haptics::bare_servo(period_s), std::nullopt, std::nullopt};
}

Help force_filter(double gain) {
  Help help = direct();
  help.name = "force filter " + cli::number(gain);
  help.force_gain = gain;
  return help;
}

Help position_filter(double gain, double lambda_mm) {
  Help help = direct();
  help.name = "position filter " + cli::number(gain) + " lambda " + cli::number(lambda_mm);
  help.servo.position_filter = haptics::PositionFilterOptions{gain, lambda_mm};
  return help;
}

std::vector<Help> all_help() {
  Help viscosity = direct();
  viscosity.name = "viscosity 10";
  viscosity.damping_n_s_per_m = 10.0;
  Help passivity = direct();
  passivity.name = "passivity controller";
  passivity.servo.passivity.controls = true;
  Help indirect = direct();
  indirect.name = "coupling 1500";
  indirect.servo.coupling.kind = haptics::CouplingKind::indirect;
  Help usual = direct();
  usual.name = "default";
  usual.servo = {};
  return {direct(), force_filter(0.2), position_filter(0.2, 1.0), viscosity, passivity, indirect,
          usual};
}

/// A row and how to measure it.
struct Case {
  Contact contact;
  Help help;
  bool is_frictionless = false;
};

std::vector<Case> all_cases() {
  using haptics::WallKind;
  std::vector<Case> cases;
  for (const Help& help : all_help()) {
    for (const Contact& contact :
         {wall("rigid 20 N", WallKind::rigid, 20.0), wall("linear 8000", WallKind::linear, 8000.0),
          field_contact(10000.0), field_contact(30000.0)}) {
      cases.push_back({contact, help});
    }
  }
  cases.push_back({wall("rigid 3.2 N", WallKind::rigid, 3.2), direct()});
  for (const double period_s : {0.5e-3, 2e-3}) {
    cases.push_back({wall("rigid 20 N", WallKind::rigid, 20.0), direct(period_s)});
  }
  cases.push_back({field_contact(3000.0), direct()});
  cases.push_back({field_contact(3000.0), force_filter(0.1)});
  for (const double lambda_mm : {0.2, 0.5, 1.0, 2.0, 5.0}) {
    cases.push_back({field_contact(3000.0), position_filter(0.1, lambda_mm)});
  }
  Help mean = direct();
  mean.name = "velocities in a mean of 0.1";
  // The time constant of a mean that takes a tenth of the new value each ms.
  mean.servo.velocity_lag_s = -1e-3 / std::log(0.9);
  for (const double damping : {2.7, 10.0, 20.0, 50.0}) {
    const Contact damped =
        wall("linear 3000 B " + cli::number(damping), WallKind::linear, 3000.0, damping);
    cases.push_back({damped, direct(), true});
    cases.push_back({damped, mean, true});
  }
  return cases;
}

void measure_case(const Case& what, CaseRow& row) {
  row.contact = what.contact.name;
  row.remedy = what.help.name;
  row.is_frictionless = what.is_frictionless;
  row.period_s = what.help.servo.period_s;
  const HoldCase held{row.hand, falcon(what.is_frictionless, 1), what.help.servo};
  const std::unique_ptr<haptics::ForceScene> scene = what.contact.make();
  const double rest_mm = what.contact.rest_mm - coupling_give_mm(held);
  if (what.help.force_gain) {
    LateScene late(*scene, *what.help.force_gain, row.period_s);
    row.found = hold(late, held, rest_mm);
  } else if (what.help.damping_n_s_per_m) {
    DampedScene damped(*scene, *what.help.damping_n_s_per_m);
    row.found = hold(damped, held, rest_mm);
  } else {
    row.found = hold(*scene, held, rest_mm);
  }
}

}  // namespace

Result<std::vector<CaseRow>> measure_cases(const Progress& progress, double from, double to) {
  const std::vector<Case> cases = all_cases();
  std::vector<CaseRow> rows(cases.size() * kHands.size());
  std::vector<std::function<void()>> work;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].hand = kHands[i % kHands.size()];
    work.emplace_back([&, i] { measure_case(cases[i / kHands.size()], rows[i]); });
  }
  if (auto done = run_all(work, progress, "what fixes what", from, to); !done) {
    return done.error();
  }
  return rows;
}

std::string case_csv(const std::vector<CaseRow>& rows) {
  std::ostringstream text;
  text << "# Holds of 3 N, one tick of delay\n"
          "contact,remedy,device,period_ms,hand,verdict,position_pp_mm,force_pp_n,work_mw,"
          "frequency_hz\n";
  text.precision(3);
  for (const CaseRow& row : rows) {
    const haptics::HoldJudgement& found = row.found;
    text << row.contact << ',' << row.remedy << ','
         << (row.is_frictionless ? "frictionless" : "nominal") << ',' << 1e3 * row.period_s << ','
         << haptics::hand_model(row.hand).name << ',' << haptics::verdict_name(found.verdict) << ','
         << found.position_pp_mm << ',' << found.force_pp_n << ',' << found.work_mw << ','
         << found.frequency_hz << '\n';
  }
  return text.str();
}

}  // namespace argil::evaluation
