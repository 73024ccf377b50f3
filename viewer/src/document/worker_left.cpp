// SPDX-License-Identifier: GPL-3.0-or-later
// Projects that a killed window left: what is asked about them, and how one is thrown away.
#include <chrono>
#include <filesystem>
#include <system_error>

#include "argil/io/session.h"

#include "base/text.h"
#include "document/document_worker.h"

namespace argil::viewer {

namespace fs = std::filesystem;

/// True when the user has to decide first what becomes of left steps.
bool DocumentWorker::asks_about_left_steps(const OpenFile& open) {
  if (open.left != OpenFile::Left::ask) return false;
  if (io::is_in_session(open.file)) return false;  // its steps are not left: a window is at work
  // Looking for them reads the whole project.
  std::error_code error;
  if (!fs::exists(journal_of(open.file), error)) {
    if (!document_.is_without_name(open.file) || !has_steps_aside(open.file)) return false;
    const auto written = fs::last_write_time(open.file, error);
    left_ = LeftQuestion{open, {0, std::chrono::file_clock::to_sys(written)}};
    return true;
  }
  const auto found = io::left_steps(open.file);
  if (!found || !found.value()) return false;  // opening says what is wrong
  left_ = LeftQuestion{open, *found.value()};
  return true;
}

void DocumentWorker::on(const DropProject& drop) {
  left_.reset();
  outbox_.begin_silent_task("throw away");
  const auto removed = io::remove_project(drop.file);
  outbox_.end_task();
  if (!removed) return complain(removed.error());
  document_.forget_picture(drop.file);
  post(Notice::Kind::done, "threw away " + in_quotes(drop.file.filename().string()));
}

}  // namespace argil::viewer
