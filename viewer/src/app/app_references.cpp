// SPDX-License-Identifier: GPL-3.0-or-later
// Reference images go with the project that they are of.
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/app.h"
#include "base/text.h"
#include "commands/brush_preset.h"
#include "commands/command.h"
#include "settings/alpha_list.h"
#include "settings/reference_list.h"

namespace argil::viewer {

namespace fs = std::filesystem;

/// An image may be to emboss with, or to sculpt by, which is asked; anything else is opened.
void App::take_dropped(const std::vector<std::string>& files) {
  if (open_dialog(ui_) != Dialog::none || files.empty()) return;
  const fs::path file = files.front();
  if (looks_like_preset(file)) return take_preset(file);
  if (extension_of(file) != ".png") return open_file(file, ui_, document_);
  ui_.dropped_image = file;
}

/// It joins those that one may emboss with, and is taken for the next stroke.
void App::take_dropped_alpha() {
  const auto file = std::exchange(ui_.dropped_alpha, std::nullopt);
  if (!file) return;
  const auto added = add_alpha(home_, *file);
  if (!added) return tell(notice_of(added.error()));
  ui_.brush.action = Action::emboss;
  ui_.brush.is_stamp = false;
  ui_.alphas.clear();
  ui_.wants_alphas = true;
  document_.send(LoadAlpha{added.value()});
}

/// Those of the project that was opened; then what is changed of them is kept beside it, once the
/// mouse lets go. They go along when it is saved under another name; without a name they are in the
/// window alone.
void App::follow_references() {
  if (!ui_.clay.has_clay) return;
  const bool is_other = std::exchange(referenced_clay_, ui_.clay.number) != ui_.clay.number;
  if (is_other) {
    referenced_file_ = ui_.clay.file;
    ReferenceList list = ui_.clay.is_untitled ? ReferenceList() : read_references(ui_.clay.file);
    for (const Error& problem : list.problems) tell({Notice::Kind::warning, problem.message});
    ui_.references = kept_references_ = std::move(list.images);
    unread_references_ = std::move(list.unread);
    return;
  }
  if (ui_.clay.is_untitled || gui_.is_held()) return;
  const bool is_renamed = std::exchange(referenced_file_, ui_.clay.file) != ui_.clay.file;
  if (!is_renamed && ui_.references == kept_references_) return;
  kept_references_ = ui_.references;  // also where it fails, or it would be told with every frame
  if (auto kept = write_references(ui_.clay.file, ui_.references, unread_references_); !kept) {
    tell(notice_of(kept.error()));
  }
}

/// In the view that the window looks in, but where there are two pictures for two eyes.
void App::add_references(Picture& picture) const {
  if (picture.right_lens) return;
  picture.references = marks_of(ui_.references, straight_view_of(picture.lens));
}

}  // namespace argil::viewer
