// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "argil/core/result.h"

namespace argil::cli {

/// Whether there is a gnuplot on the PATH.
bool has_gnuplot();

/// A picture that gnuplot made.
struct Picture {
  std::string name;  ///< as its script has it: set output 'NAME'
  std::string svg;   ///< all of it
};

/// What gnuplot makes of a script, which names one picture without a path, and data that lies
/// beside it likewise, or by its whole path. It draws in a folder of its own: nothing is left but
/// what comes back, and a picture that was there stays as it was until that takes its place.
///
/// An interrupt ends gnuplot, and so does whatever ends the program.
/// Errors  interrupted; internal with what gnuplot said, or where its picture is not whole; disk.
Result<Picture> drawn_by_gnuplot(const std::filesystem::path& script);

/// Draws the picture that --plot asked for: `script` names its own picture as it likes, and `data`,
/// where it is not empty, as 'run.dat'.
/// Errors  bad_input naming the package when gnuplot is not there; as drawn_by_gnuplot and
///         io::replace_text.
Result<void> draw_plot(const std::filesystem::path& picture, const std::string& script,
                       const std::string& data = {});

}  // namespace argil::cli
