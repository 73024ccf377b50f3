// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"

#include "chart/sheet.h"
#include "common/command.h"

namespace argil::evaluation {

/// What the kinds of chart have in common. A kind is one folder whose chart.cpp adds its subcommand
/// below `chart`, a line in kinds.h and one in cli/cmd_chart.cpp.
struct ChartOptions {
  std::filesystem::path folder = "charts";
  bool quick = false;
};

/// A kind of chart with the options -o and --quick. `options` must live as long as `work`.
CLI::App* add_kind(CLI::App& chart, cli::Selected& selected, const std::string& name,
                   const std::string& description, ChartOptions& options, cli::Work work);

/// Tells how far the measuring is.
/// Errors  interrupted, when the user asked to stop: then nothing has been written yet.
Result<void> tell(const Progress& progress, std::string_view stage, double fraction);

/// The files of one chart in their folder, each written whole or not at all.
class ChartFiles {
 public:
  /// Makes the folder when it is not there: before anything is measured.
  /// Errors  disk, naming the folder.
  static Result<ChartFiles> in(const std::filesystem::path& folder);

  Result<void> write(const std::string& name, const std::string& text);
  /// Writes the script, and its picture when gnuplot is there.
  /// Errors  as cli::drawn_by_gnuplot and io::replace_text: a picture that was there is as it was.
  Result<void> draw(const Script& script);

  bool has_pictures() const noexcept { return has_pictures_; }
  /// What was written, folder and name, in that order.
  const std::vector<std::string>& written() const noexcept { return written_; }

 private:
  explicit ChartFiles(std::filesystem::path folder);

  std::filesystem::path folder_;
  std::vector<std::string> written_;
  bool has_pictures_;
};

/// Writes the one table and the one script of a small chart and tells `outcome` the files; says in
/// its text where the picture is, or why there is none.
Result<void> write_chart(ChartFiles& files, const std::string& csv_name, const std::string& csv,
                         const Script& script, cli::Outcome& outcome);

}  // namespace argil::evaluation
