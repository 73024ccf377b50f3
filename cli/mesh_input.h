// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>

#include <CLI/CLI.hpp>

#include "argil/core/result.h"
#include "argil/io/mesh_frame.h"

#include "common/outcome.h"

namespace argil::cli {

/// --unit and --up of commands that read a mesh; outlives the command line.
class MeshFrameOptions {
 public:
  void add_to(CLI::App& command);

  CLI::Option* unit_option() const noexcept { return unit_given_; }
  bool is_given() const { return unit_given_->count() + up_given_->count() > 0; }
  io::MeshFrame frame() const;

 private:
  std::size_t unit_ = 0;
  std::size_t up_ = 0;
  CLI::Option* unit_given_ = nullptr;
  CLI::Option* up_given_ = nullptr;
};

/// io::read_framed_mesh; its doubts are told on stderr.
Result<io::FramedMesh> open_mesh(const std::filesystem::path& file,
                                 const MeshFrameOptions& options);

/// bad_input for a project, whose unit and axes are known, where options say what they are.
Result<void> check_no_frame(const std::filesystem::path& project, const MeshFrameOptions& options);

/// The keys "unit" and "up", each {"value","source","looks_like"}.
void add_frame_keys(Json& json, const io::FrameReport& frame);

}  // namespace argil::cli
