// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart gallery: every action at three levels beside Blender's, with figures below.
#include "chart/chart.h"

#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "chart/kinds.h"
#include "gallery/picture.h"
#include "gallery/run.h"

namespace argil::evaluation {
namespace {

/// What --quick does: one of each kind of figures and of Blender's answers.
constexpr std::array kQuick{Action::carve, Action::inflate, Action::crease, Action::noise};

struct GalleryOptions : ChartOptions {
  std::vector<std::string> actions;  ///< names; none: all
};

/// Refuses what is no action while the options are read.
std::string name_fault(const std::string& name) {
  if (std::find(kActionNames.begin(), kActionNames.end(), name) != kActionNames.end()) return {};
  std::string all;
  for (const std::string_view each : kActionNames) {
    all += (all.empty() ? "" : ", ") + std::string(each);
  }
  return "--action is '" + name + "'; must be one of " + all;
}

std::vector<Plate> wanted_plates(const GalleryOptions& options) {
  std::vector<Plate> plates = all_plates();
  const std::set<std::string> named(options.actions.begin(), options.actions.end());
  std::erase_if(plates, [&](const Plate& plate) {
    if (!named.empty()) return !named.contains(info_of(plate.action).name);
    return options.quick && std::find(kQuick.begin(), kQuick.end(), plate.action) == kQuick.end();
  });
  return plates;
}

std::string gallery_summary(const GalleryResult& result) {
  std::string text;
  for (const MadePlate& made : result.plates) {
    text += plate_text(made.plate) + "\n";
    for (const Column& column : made.columns) {
      text += "  " + column.maker + ", " + column.with + ":";
      for (const Figure& figure : column.figures) {
        text += " " + figure.name + " " + figure_text(figure) + ";";
      }
      text += (column.image ? "" : " " + column.reason) + "\n";
    }
  }
  for (const std::string& reason : result.skipped) text += "skipped " + reason + "\n";
  return text;
}

Result<cli::Outcome> make_gallery_chart(const GalleryOptions& options, const Progress& progress) {
  auto files = ChartFiles::in(options.folder);
  if (!files) return files.error();
  auto made = make_gallery(wanted_plates(options), progress);
  if (!made) return made.error();
  std::vector<std::string> sheets;
  for (const MadePlate& plate : made.value().plates) {
    auto svg = plate_svg(plate.plate, plate.columns, progress);
    if (!svg) return svg.error();
    sheets.push_back(std::move(svg).value());
  }
  for (std::size_t n = 0; n < sheets.size(); ++n) {
    const Action action = made.value().plates[n].plate.action;
    if (auto done = files.value().write(std::string(info_of(action).name) + ".svg", sheets[n]);
        !done)
      return done.error();
  }
  if (auto done = files.value().write("gallery.csv", gallery_csv(made.value().plates)); !done) {
    return done.error();
  }
  cli::Outcome outcome;
  outcome.text = gallery_summary(made.value());
  outcome.json["plates"] = made.value().plates.size();
  outcome.json["skipped"] = made.value().skipped;
  outcome.json["files"] = files.value().written();
  return outcome;
}

}  // namespace

void add_chart_gallery(CLI::App& chart, cli::Selected& selected) {
  auto options = std::make_shared<GalleryOptions>();
  CLI::App* command = add_kind(
      chart, selected, "gallery", "every action at three levels, beside Blender's", *options,
      [options](const Progress& progress) { return make_gallery_chart(*options, progress); });
  command->add_option("--action", options->actions, "only this one; again for more")
      ->type_name("NAME")
      ->each([](const std::string& name) {
        if (const std::string fault = name_fault(name); !fault.empty())
          throw CLI::ValidationError(fault);
      });
}

}  // namespace argil::evaluation
