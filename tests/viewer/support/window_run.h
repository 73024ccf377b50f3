// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "picture/camera.h"
#include "support/clients.h"
#include "support/scratch.h"

namespace argil::test {

/// Small, because software OpenGL pays for every pixel. The tools take 212 of them at the left, the
/// brush and what is shown 296 at the right.
inline constexpr int kWindowWidth = 640;
inline constexpr int kWindowHeight = 480;

/// The same as arguments.
inline constexpr const char* kWindowSize = "--width 640 --height 480";

/// How a run of `argil view` ended.
struct WindowRun {
  int status = -1;
  nlohmann::json report;  ///< what --json printed; null when that was no object
  std::string words;      ///< on stderr
};

/// Runs the program in a window of a display of its own (Xvfb, software OpenGL), in a scratch
/// folder and with a home folder of its own.
class WindowTest : public testing::Test {
 protected:
  void SetUp() override {
    ARGIL_CLIENT_OR_SKIP("Xvfb");
    std::filesystem::create_directories(home());
  }

  std::filesystem::path home() const { return folder_ / "home"; }

  /// `argil view ARGUMENTS` with a script of these lines as its input.
  WindowRun play(const std::string& script, const std::string& arguments = "",
                 const std::string& size = kWindowSize);
  /// `argil view ARGUMENTS &`, its process in $view, then these lines of a shell, as a person at
  /// another program would do.
  WindowRun run_beside(const std::string& shell, const std::string& arguments);

  /// The camera as it stands when a clay was just opened.
  static viewer::Camera first_camera(const Box3& bounds_mm);

  ScratchFolder folder_;
  std::string display_ = "1280x800";  ///< pixels of the display that runs begin

 private:
  WindowRun run(const std::string& shell);
};

/// A file in the quotes of a shell; for names without any.
std::string shell_word(const std::filesystem::path& file);

/// A project, a ball, with a stroke that only its journal has: what a killed window leaves. Makes
/// its folder. Returns the hash that it has with that stroke.
std::uint64_t leave_a_stroke(const std::filesystem::path& project, double radius_mm = 25.0);

/// The lines of a script that name a file in an open dialog.
std::string name_file(const std::filesystem::path& file);

}  // namespace argil::test
