// SPDX-License-Identifier: GPL-3.0-or-later
#include "panels/file_list.h"

#include <algorithm>
#include <cassert>
#include <system_error>
#include <utility>

#include <imgui.h>

#include "argil/io/path_file.h"

#include "base/text.h"
#include "commands/command.h"
#include "commands/references.h"
#include "gui/dialog.h"
#include "gui/gui.h"
#include "gui/layout.h"
#include "panels/file_picture.h"

namespace argil::viewer {
namespace {

namespace fs = std::filesystem;

/// Extensions of the files that a wish may choose, the usual one first.
std::vector<std::string> endings_of(FileWish wish) {
  std::vector<std::string> meshes{".3mf", ".stl", ".obj", ".ply", ".glb"};
  if (wish == FileWish::save_as) return {".vdb"};
  if (wish == FileWish::firmware) return {".bin"};
  if (wish == FileWish::alpha || wish == FileWish::reference) return {".png", ".jpg", ".jpeg"};
  if (wish == FileWish::path) return {".jsonl", ".csv", ".txt", ".xyz"};
  if (wish == FileWish::export_mesh) return meshes;
  meshes.emplace_back(".gltf");  // only read
  if (wish != FileWish::open) return meshes;
  std::vector<std::string> all{".vdb"};
  all.insert(all.end(), meshes.begin(), meshes.end());
  return all;
}

/// Whether a file is of a kind that is asked for.
bool is_offered(const fs::path& file, FileWish wish) {
  const std::vector<std::string> wanted = endings_of(wish);
  return std::find(wanted.begin(), wanted.end(), extension_of(file)) != wanted.end();
}

/// What is named, with the ending that it will get.
fs::path with_ending(fs::path file, FileWish wish) {
  std::error_code error;
  if (fs::is_directory(file, error)) return file;
  if (wish == FileWish::save_as && extension_of(file) != ".vdb") file += ".vdb";
  if (wish == FileWish::export_mesh && !file.has_extension()) file += ".3mf";
  return file;
}

const char* title_of(FileWish wish) {
  switch (wish) {
    case FileWish::open:
      return "Open";
    case FileWish::save_as:
      return "Save as";
    case FileWish::export_mesh:
      return "Export as";
    case FileWish::stamp:
      return "Stamp with a mesh";
    case FileWish::alpha:
      return "Emboss an image";
    case FileWish::reference:
      return "A reference image";
    case FileWish::firmware:
      return "Firmware of the Falcon";
    case FileWish::path:
      return "Path of the guidance";
    case FileWish::import_piece:
      return "Add a mesh as a piece";
    case FileWish::import_mesh:
    case FileWish::none:  // is never shown
      break;
  }
  return "Import a mesh";
}

const char* verb_of(FileWish wish) {
  return wish == FileWish::open           ? "Open it"
         : wish == FileWish::import_mesh  ? "Import it"
         : wish == FileWish::import_piece ? "Add it"
         : wish == FileWish::stamp        ? "Stamp with it"
         : wish == FileWish::alpha        ? "Emboss it"
         : wish == FileWish::reference    ? "Show it"
         : wish == FileWish::firmware     ? "Send it"
         : wish == FileWish::path         ? "Follow it"
         : wish == FileWish::save_as      ? "Save there"
                                          : "Export there";
}

/// A thousand points at most: read at once.
void take_path(const fs::path& file, UiState& ui, DocumentThread& document) {
  auto path = io::read_path(file);
  if (!path) {
    ui.notices.push_back({Notice::Kind::error, path.error().message});
    return;
  }
  document.send(CheckPath{path.value(), active_key(ui.clay)});
  ui.haptics.guidance.path_mm = std::move(path).value();
  if (ui.haptics.guidance.kind == haptics::GuidanceKind::none) {
    ui.haptics.guidance.kind = haptics::GuidanceKind::direct;
  }
}

constexpr float kMarkedWidth = 208.0F;  // units, of the picture beside the list

/// The picture of the project that is marked, and what the list does not say of it.
void draw_marked_file(const UiState& ui) {
  const float width = kMarkedWidth * unit();
  const float height = width * kThumbnailHeight / kThumbnailWidth;
  ImGui::BeginGroup();
  ImGui::Dummy({width, height});
  const ShownFile* known = known_file(ui, ui.marked_file);
  if (!ui.marked_file.empty()) {
    draw_picture_in(known != nullptr ? known->picture : ShownPicture(), *ImGui::GetWindowDrawList(),
                    ImGui::GetItemRectMin(), ImGui::GetItemRectMax(),
                    known != nullptr ? "no picture" : "");
  }
  if (known != nullptr && known->look.is_there) {
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width);
    ImGui::TextUnformatted(words_of_look(known->look).c_str());
    ImGui::PopTextWrapPos();
  }
  ImGui::EndGroup();
}

}  // namespace

void FileList::start(UiState& ui) {
  assert(ui.file_wish != FileWish::none);
  wish_ = ui.file_wish;
  // What was to follow after saving follows only where something is saved.
  if (wish_ != FileWish::save_as) ui.after_saving = AfterSaving::nothing;
  std::error_code error;
  folder_ =
      fs::is_directory(ui.folder, error) ? fs::absolute(ui.folder, error) : fs::current_path(error);
  const std::string stem = ui.clay.is_untitled ? "sculpture" : ui.clay.file.stem().string();
  name_ = wish_ == FileWish::save_as       ? stem + ".vdb"
          : wish_ == FileWish::export_mesh ? stem + ".3mf"
                                           : "";
  read_folder();
  const bool is_new = wish_ == FileWish::save_as || wish_ == FileWish::export_mesh;
  if (has_system_ && SystemDialog::is_there()) {
    // Without a name the path ends with a slash, by which the dialog knows a folder.
    system_.ask({title_of(wish_), folder_ / name_, is_new, endings_of(wish_)});
  }
}

void FileList::read_folder() {
  folders_.clear();
  files_.clear();
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder_, error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with('.')) continue;  // hidden
    std::error_code ignored;
    if (entry.is_directory(ignored)) {
      folders_.push_back(entry.path());
    } else if (is_offered(entry.path(), wish_)) {
      files_.push_back(entry.path());
    }
  }
  std::sort(folders_.begin(), folders_.end());
  std::sort(files_.begin(), files_.end());
}

void FileList::draw(UiState& ui, DocumentThread& document) {
  ui.marked_file.clear();
  if (ui.file_wish == FileWish::none) system_.close();
  if (ui.file_wish != FileWish::none && wish_ != ui.file_wish) start(ui);
  const bool is_asked = open_dialog(ui) == Dialog::file;
  const float height = std::min(460.0F, 0.9F * ImGui::GetIO().DisplaySize.y / unit());
  const bool has_picture = wish_ == FileWish::open && !system_.is_open();
  const DialogLayout layout{false, has_picture ? 640.0F : 560.0F,
                            system_.is_open() ? 0.0F : height};
  bool is_open = true;
  const bool is_drawn = begin_dialog(title_of(wish_), is_asked, &is_open, layout);
  if (is_drawn && system_.is_open()) {
    draw_waiting(ui, document, is_open);
  } else if (is_drawn) {
    draw_list(ui, document, is_open);
  }
  if (is_drawn) end_dialog();
  if (!is_open) give_up(ui);
  // The window is found by its title, which must stay until it is closed.
  if (!is_drawn && ui.file_wish == FileWish::none) wish_ = FileWish::none;
}

/// While the desktop asks.
void FileList::draw_waiting(UiState& ui, DocumentThread& document, bool& is_open) {
  ImGui::TextUnformatted("Choose in the dialog of the desktop.");
  if (button("Cancel")) is_open = false;
  const auto answer = system_.answer();
  if (answer && answer->empty()) is_open = false;
  if (answer && !answer->empty()) take(*answer, ui, document);
}

void FileList::draw_list(UiState& ui, DocumentThread& document, bool& is_open) {
  ImGui::TextDisabled("%s", folder_.string().c_str());
  const bool has_picture = wish_ == FileWish::open;
  const float beside = has_picture ? kMarkedWidth * unit() + ImGui::GetStyle().ItemSpacing.x : 0.0F;
  ImGui::BeginChild("list", {-beside, -2.6F * ImGui::GetFrameHeight()}, true);
  std::optional<fs::path> into;
  if (choice("..", false)) into = folder_.parent_path();
  for (const fs::path& folder : folders_) {
    if (choice((folder.filename().string() + "/").c_str(), false)) into = folder;
  }
  // A double click does not write: it could replace a file before the warning is read.
  const bool writes = wish_ == FileWish::save_as || wish_ == FileWish::export_mesh;
  for (const fs::path& file : files_) {
    const std::string name = file.filename().string();
    if (choice(name.c_str(), name == name_)) name_ = name;
    if (!writes && ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0)) finish(ui, document);
  }
  ImGui::EndChild();
  if (has_picture) {
    const fs::path file = folder_ / name_;  // asks no disk, as every frame would
    if (!name_.empty() && extension_of(file) == ".vdb") ui.marked_file = file;
    ImGui::SameLine();
    draw_marked_file(ui);
  }
  ImGui::SetNextItemWidth(-1.0F);
  // Whoever is asked for a name types one at once; what is offered is chosen whole.
  if (writes && ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  if (text_field("##name", name_)) finish(ui, document);
  if (ui.file_wish != FileWish::none && button(verb_of(wish_))) finish(ui, document);
  ImGui::SameLine();
  if (button("Cancel")) is_open = false;
  std::error_code error;
  if (writes && fs::exists(chosen(), error) && !name_.empty()) {
    ImGui::SameLine();
    ImGui::TextUnformatted("replaces the file that is there");
  }
  if (into) {
    folder_ = *into;
    read_folder();
  }
}

void FileList::give_up(UiState& ui) {
  ui.file_wish = FileWish::none;
  ui.after_saving = AfterSaving::nothing;
}

fs::path FileList::chosen() const {
  return with_ending(folder_ / name_, wish_);  // an absolute name stands alone
}

void FileList::finish(UiState& ui, DocumentThread& document) {
  if (name_.empty()) return;
  const fs::path file = chosen();
  std::error_code error;
  // A folder that was typed is entered.
  if (fs::is_directory(file, error)) {
    folder_ = file;
    name_.clear();
    read_folder();
    return;
  }
  take(file, ui, document);
}

void FileList::take(fs::path file, UiState& ui, DocumentThread& document) {
  assert(wish_ != FileWish::none && !file.empty());
  file = with_ending(std::move(file), wish_);
  remember_folder_of(file, ui);
  ui.file_wish = FileWish::none;
  if (wish_ == FileWish::open || wish_ == FileWish::import_mesh) {
    open_file(file, ui, document);
  } else if (wish_ == FileWish::import_piece) {
    document.send(ImportPiece{file});
  } else if (wish_ == FileWish::stamp) {
    document.send(LoadStamp{file});
  } else if (wish_ == FileWish::alpha) {
    document.send(LoadAlpha{file});
  } else if (wish_ == FileWish::reference) {
    add_reference(file, ui);
  } else if (wish_ == FileWish::firmware) {
    // Absolute, since the next window may begin in another folder.
    std::error_code error;
    ui.firmware = ui.settings.firmware = fs::absolute(file, error);
  } else if (wish_ == FileWish::path) {
    take_path(file, ui, document);
  } else if (wish_ == FileWish::save_as) {
    document.send(SaveProjectAs{file, ui.after_saving != AfterSaving::nothing});
    go_on_after_saving(true, ui, document);
  } else {
    document.send(ExportMesh{file, ui.export_options});
    ui.panels.has_print = true;
  }
}

}  // namespace argil::viewer
