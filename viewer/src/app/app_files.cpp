// SPDX-License-Identifier: GPL-3.0-or-later
// Files in lists have pictures, which are read when a list is opened and dropped when it is closed.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "app/app.h"
#include "commands/command.h"
#include "settings/settings.h"

namespace argil::viewer {

namespace fs = std::filesystem;

/// Those that the open dialog shows.
std::vector<fs::path> App::listed_files() const {
  const Dialog dialog = open_dialog(ui_);
  if (dialog == Dialog::recent) return ui_.recent;
  if (dialog == Dialog::file && !ui_.marked_file.empty()) return {ui_.marked_file};
  if (dialog != Dialog::recover) return {};
  std::vector<fs::path> files{ui_.clay.left->asked.file};
  for (const LeftProject& left : ui_.left_projects) {
    if (left.file != files.front()) files.push_back(left.file);
  }
  return files;
}

ShownPicture App::kept_picture(const std::shared_ptr<const ReferencePixels>& pixels) {
  if (!pixels) return {};
  return {renderer_->keep_image(*pixels), pixels->width, pixels->height};
}

void App::drop_file(const ShownFile& file) {
  for (const ShownPicture& picture : {file.picture, file.work}) {
    if (picture.number != 0) renderer_->drop_image(picture.number);
  }
}

/// Once a frame: asks for what a list shows and did not show in the last one, and takes what came.
void App::follow_files() {
  FileShelf& shelf = ui_.shelf;
  const std::vector<fs::path> wanted = listed_files();
  if (wanted != shelf.wanted) {
    shelf.wanted = wanted;
    const auto is_wanted = [&](const fs::path& file) {
      return std::find(wanted.begin(), wanted.end(), file) != wanted.end();
    };
    std::erase_if(shelf.known, [&](const auto& known) {
      if (is_wanted(known.first)) return false;
      drop_file(known.second);
      return true;
    });
    std::vector<fs::path> unknown = wanted;
    std::erase_if(unknown, [&](const fs::path& file) { return shelf.known.contains(file); });
    looks_.want(std::move(unknown));
  }
  for (FileLook& look : looks_.take()) {
    ShownFile shown;
    shown.picture = kept_picture(look.picture);
    if (look.work) shown.work = kept_picture(look.work->pixels);
    if (look.work) shown.work_steps = look.work->steps;
    // The card has them now.
    look.picture.reset();
    look.work.reset();
    const fs::path file = look.file;
    shown.look = std::move(look);
    const auto [known, is_new] = shelf.known.try_emplace(file, shown);
    if (is_new) continue;
    drop_file(known->second);
    known->second = std::move(shown);
  }
}

void App::forget_recent() {
  const auto file = std::exchange(ui_.forgotten_recent, std::nullopt);
  if (!file) return;
  if (auto kept = remove_recent(home_, *file, ui_.recent); !kept) {
    tell({Notice::Kind::warning, kept.error().message});
  }
}

}  // namespace argil::viewer
