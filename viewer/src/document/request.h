// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <variant>
#include <vector>

#include "argil/core/clay_heartbeat.h"
#include "argil/core/tool_sample.h"
#include "argil/core/window_channel.h"
#include "argil/engine/pick.h"
#include "argil/engine/stroke.h"
#include "argil/engine/tool.h"
#include "argil/io/export.h"
#include "argil/io/stroke_script.h"
#include "argil/mesh/printer.h"

#include "document/mesh_offer.h"
#include "picture/outline_trim.h"
#include "picture/renderer.h"

namespace argil::viewer {

// What the window asks for, in the sculpture's frame but where something else is said. Done in the
// order in which it was sent, on the document thread.

// A stroke arrives in pieces while the hand makes it.

struct BeginStroke {
  Tool tool;
  StrokeStyle style;
  bool is_stamp = false;  ///< listed as a stamp among the steps
  bool goes_on = false;  ///< of the gesture of the stroke before, which left the clay and came back
};
struct ExtendStroke {
  std::vector<StrokeSample> samples;
  /// When its input came, by any clock: given back once a picture shows it, to measure the latency.
  double input_s = 0.0;
};
struct EndStroke {};
/// Takes back the whole gesture, with the strokes before this one that it goes on from.
struct CancelStroke {};

/// Undo, redo, an operation on the whole clay or its mask (in the active piece's frame), a piece:
/// one step of the journal.
struct DoStep {
  io::ScriptStep step;
  /// That an operation or its numbers were meant for: refused where another one is active by then.
  /// Nothing: whichever is. Undo, redo and changes of pieces are meant for no single one.
  std::optional<PieceKey> piece = {};
};

/// Trims this piece within or around what was outlined over it, as deep as its clay is by then.
/// Nothing where the outline lies beside it.
struct TrimPiece {
  OutlineTrim trim;               ///< in the piece's frame
  std::optional<PieceKey> piece;  ///< as of DoStep
};

/// Strokes go to the piece that a ray meets first; nothing where it meets none.
struct SelectPieceAt {
  Ray ray;
};
/// A ball beside all that is there, a third as large, in the voxels of the active piece.
struct AddBallPiece {};
/// A mesh as another piece, closed, where it stands in its file, 256 voxels along its longest side.
struct ImportPiece {
  std::filesystem::path file;
};
/// A copy of the active piece, in its place.
struct DuplicatePiece {};
/// Moves the active piece: its lowest point straight to z = 0; the middle of the box around it to x
/// = y = 0; or turned so that it lies on the largest side that it can rest on, at z = 0. Or all
/// visible pieces together straight, the lowest point of all to z = 0, in one step. Stopped, or
/// where one of them is locked, all stay where they are.
struct StandPiece {
  enum class Where { bed, middle, flat, all_on_bed } where = Where::bed;
};

/// Undo or redo as often as it takes until this many of ClayState::steps are done.
struct GoToStep {
  std::size_t done = 0;
};

/// Another clay instead of this one, whose changes are saved or dropped once the new one is there.
struct NewClay {
  io::StartShape start;
  bool saves_former = true;
};
/// A project, or a mesh that becomes clay as `argil import` makes it, 256 voxels along its longest
/// side.
struct OpenFile {
  std::filesystem::path file;
  bool saves_former = true;
  /// What becomes of steps that a killed session left.
  enum class Left { ask, repeat, put_aside } left = Left::ask;
};
/// Looks at a mesh that may be imported: it becomes ClayState::offer once it is read. Only the one
/// that was sent last counts: an earlier one ends without an offer.
struct LookAtMesh {
  std::filesystem::path file;
  std::int64_t number = 0;  ///< above 0 and not used before; given back in the offer
};
/// A mesh that becomes clay, as OpenFile, in the way that was chosen.
struct ImportMesh {
  std::filesystem::path file;
  MeshImport how;
  bool saves_former = true;
};
/// A closed mesh to stamp with: it becomes ClayState::stamp once it is read.
struct LoadStamp {
  std::filesystem::path file;
};
/// A PNG or a JPEG to emboss with: it becomes ClayState::alpha once it is read.
struct LoadAlpha {
  std::filesystem::path file;
};
/// Says by a notice where a path of guidance, in the active piece's frame, does not lie on the
/// clay; nothing where it does, or where another piece than that of the path is active by then.
struct CheckPath {
  std::vector<Vec3> path_mm;
  std::optional<PieceKey> piece = {};  ///< nothing: whichever is active
};
/// Drops the question ClayState::left. The document that is open stays open.
struct ForgetQuestion {};
/// Removes a project that a killed window left, for good, and the question about it.
struct DropProject {
  std::filesystem::path file;
};
/// A renderer had no room for blocks: all of them are sent again, and what it has of them may go.
struct SendBlocksAgain {};
/// Drops all that can be undone, in memory and on the disk. Of a clay with no changes.
struct ForgetHistory {};
struct SaveProject {};
struct SaveProjectAs {
  std::filesystem::path file;
  bool goes_on = false;  ///< the next request is skipped when this one fails
};
/// Ends the session, its steps saved or dropped.
struct EndProject {
  bool saves = true;
};

struct ExportMesh {
  std::filesystem::path file;
  io::ExportOptions options;
};
struct CheckPrint {
  mesh::Printer printer;
};

/// The hand of a device works the clay as well: its samples come out of the ring, windows for the
/// servo to feel go into the channel, the heartbeat tells it that this thread is alive. All three
/// must live until UnlinkHaptics is done.
struct LinkHaptics {
  ToolSampleRing* ring = nullptr;
  WindowChannel* channel = nullptr;
  ClayHeartbeat* heartbeat = nullptr;
  Tool tool;
  StrokeStyle style;
  /// In whose frame the samples are: while another one is active the hand neither works nor feels.
  /// Nothing: whichever is.
  std::optional<PieceKey> piece = {};
};
struct UnlinkHaptics {};

using Request =
    std::variant<BeginStroke, ExtendStroke, EndStroke, CancelStroke, DoStep, TrimPiece, GoToStep,
                 SelectPieceAt, AddBallPiece, ImportPiece, DuplicatePiece, StandPiece, NewClay,
                 OpenFile, LookAtMesh, ImportMesh, ForgetQuestion, DropProject, LoadStamp,
                 LoadAlpha, CheckPath, SendBlocksAgain, ForgetHistory, SaveProject, SaveProjectAs,
                 EndProject, ExportMesh, CheckPrint, LinkHaptics, UnlinkHaptics>;

}  // namespace argil::viewer
