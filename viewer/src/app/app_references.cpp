// SPDX-License-Identifier: GPL-3.0-or-later
// Images that the window asks for and that are read beside it: those to emboss with, and reference
// images, which go with the project that they are of.
#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "argil/io/image_file.h"

#include "app/app.h"
#include "base/text.h"
#include "commands/brush_preset.h"
#include "commands/command.h"
#include "commands/references.h"
#include "settings/alpha_list.h"
#include "settings/image_reader.h"
#include "settings/reference_list.h"

namespace argil::viewer {

namespace fs = std::filesystem;

/// An image may be to emboss with, or to sculpt by, which is asked; anything else is opened. One
/// that is damaged is an image by its name, and one of another name by its content.
void App::take_dropped(const std::vector<std::string>& files) {
  if (open_dialog(ui_) != Dialog::none || files.empty()) return;
  const fs::path file = files.front();
  if (looks_like_preset(file)) return take_preset(file);
  if (!has_image_ending(file) && !io::is_image_file(file)) return open_file(file, ui_, document_);
  ui_.dropped_image = file;
}

/// What this frame has wished for.
void App::ask_for_images() {
  // Once: a palette that is not looked at costs nothing.
  if (std::exchange(ui_.wants_alphas, false) && !std::exchange(has_asked_alphas_, true)) {
    ui_.reads_alphas = true;
    images_.read_alphas();
  }
  if (const auto file = std::exchange(ui_.dropped_alpha, std::nullopt)) images_.add_alpha(*file);
  std::vector<ReferenceWish>& wishes = ui_.reference_wishes;
  for (ReferenceWish& wish : wishes) {
    if (!std::exchange(wish.is_asked, true)) images_.read_reference(wish.file);
  }
  const auto dropped = std::stable_partition(
      wishes.begin(), wishes.end(), [](const ReferenceWish& wish) { return !wish.is_dropped; });
  const std::vector<ReferenceWish> gone(dropped, wishes.end());
  wishes.erase(dropped, wishes.end());
  for (const ReferenceWish& wish : gone) {
    if (!is_awaited(wish.file)) images_.forget_reference(wish.file);
  }
}

/// Whether anybody waits for the pixels of a file.
bool App::is_awaited(const fs::path& file) const {
  const auto waits = [&](const auto& one) { return one.file == file; };
  const auto lacks = [&](const ReferenceImage& one) { return one.is_awaited && waits(one); };
  return std::any_of(ui_.references.begin(), ui_.references.end(), lacks) ||
         std::any_of(ui_.reference_wishes.begin(), ui_.reference_wishes.end(), waits);
}

void App::take_images() {
  if (!images_.has_news()) return;
  ImageReader::News news = images_.take_news();
  for (const auto& [file, read] : news.references) take_pixels(file, read);
  if (news.alphas) take_alphas(*std::move(news.alphas));
  for (const auto& added : news.added) take_added_alpha(added);
}

/// For all that show this file. The list that is kept has the same pixels, or they would count as a
/// change of it.
void App::take_pixels(const fs::path& file, const ImageReader::News::Pixels& read) {
  for (std::vector<ReferenceImage>* list : {&ui_.references, &kept_references_}) {
    for (ReferenceImage& image : *list) {
      if (!image.is_awaited || image.file != file) continue;
      image.is_awaited = false;
      if (read) image.pixels = read.value();
    }
  }
  const auto is_met = [&](const ReferenceWish& wish) { return wish.is_asked && wish.file == file; };
  std::vector<ReferenceWish>& wishes = ui_.reference_wishes;
  for (const ReferenceWish& wish : wishes) {
    if (read && is_met(wish)) put_reference(wish, read.value(), ui_);
  }
  const bool was_wished = std::erase_if(wishes, is_met) > 0;
  if (read) return;
  // One of a list may be back the next time.
  tell(was_wished ? notice_of(read.error()) : Notice{Notice::Kind::warning, read.error().message});
}

void App::take_alphas(AlphaList list) {
  ui_.alphas = std::move(list.alphas);
  ui_.reads_alphas = false;
  if (std::exchange(has_told_alphas_, true)) return;
  for (const Error& problem : list.problems) tell({Notice::Kind::warning, problem.message});
}

/// It joins those that one may emboss with, and is taken for the next stroke.
void App::take_added_alpha(const Result<fs::path>& added) {
  if (!added) return tell(notice_of(added.error()));
  ui_.brush.action = Action::emboss;
  ui_.brush.is_stamp = false;
  has_asked_alphas_ = true;
  images_.read_alphas();
  document_.send(LoadAlpha{added.value()});
}

/// Those of the project that was opened; then what is changed of them is kept beside it, once the
/// mouse lets go. They go along when it is saved under another name; without a name they are in the
/// window alone.
void App::follow_references() {
  if (!ui_.clay.has_clay) return;
  const bool is_other = std::exchange(referenced_clay_, ui_.clay.number) != ui_.clay.number;
  if (is_other) return open_references();
  if (ui_.clay.is_untitled || gui_.is_held()) return;
  const bool is_renamed = std::exchange(referenced_file_, ui_.clay.file) != ui_.clay.file;
  if (!is_renamed && ui_.references == kept_references_) return;
  kept_references_ = ui_.references;  // also where it fails, or it would be told with every frame
  if (auto kept = write_references(ui_.clay.file, ui_.references, unread_references_); !kept) {
    tell(notice_of(kept.error()));
  }
}

/// What was to be read for the clay before is of no use to this one.
void App::open_references() {
  referenced_file_ = ui_.clay.file;
  images_.forget_references();
  ui_.reference_wishes.clear();
  ReferenceList list = ui_.clay.is_untitled ? ReferenceList() : read_references(ui_.clay.file);
  for (const Error& problem : list.problems) tell({Notice::Kind::warning, problem.message});
  for (ReferenceImage& image : list.images) {
    image.is_awaited = true;
    images_.read_reference(image.file);
  }
  ui_.references = kept_references_ = std::move(list.images);
  unread_references_ = std::move(list.unread);
}

/// In the view that the window looks in, but where there are two pictures for two eyes.
void App::add_references(Picture& picture) const {
  if (picture.right_lens) return;
  picture.references = marks_of(ui_.references, straight_view_of(picture.lens));
}

}  // namespace argil::viewer
