// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace argil::viewer {

/// What the desktop's own dialog asks for.
struct FileQuestion {
  std::string title;
  std::filesystem::path start;       ///< a folder, or a name in it to begin with
  bool is_new = false;               ///< to be written: asks before an old file is replaced
  std::vector<std::string> endings;  ///< ".vdb"
};

/// A file dialog of the desktop, zenity or kdialog, in a process of its own: the window draws on.
///
/// Threads  one. The destructor ends the process.
class SystemDialog {
 public:
  /// Whether there is one, and a desktop to show it on.
  static bool is_there();

  SystemDialog() = default;
  ~SystemDialog();
  SystemDialog(const SystemDialog&) = delete;
  SystemDialog& operator=(const SystemDialog&) = delete;

  /// Opens a dialog; one that is open is closed. False when the process could not be started.
  bool ask(const FileQuestion& question);
  bool is_open() const noexcept { return process_ > 0; }
  /// Ends the dialog, whose answer is not wanted any more.
  void close();

  /// Nothing until the dialog is answered; then, once, the file, or "" for none.
  std::optional<std::filesystem::path> answer();

 private:
  void end();

  pid_t process_ = 0;
  int pipe_ = -1;
  std::string said_;
};

/// The words of the command that asks: of zenity, or of kdialog.
std::vector<std::string> zenity_words(const FileQuestion& question);
std::vector<std::string> kdialog_words(const FileQuestion& question);

}  // namespace argil::viewer
