// SPDX-License-Identifier: GPL-3.0-or-later
// Where the oldest steps of a journal may go, and the journal without them.
#include "project/history_cut.h"

#include <algorithm>
#include <cassert>
#include <variant>
#include <vector>

namespace argil::io {
namespace {

const PieceEdit* piece_edit(const ScriptStep& step) { return std::get_if<PieceEdit>(&step); }

bool is_select(const ScriptStep& step) {
  const PieceEdit* edit = piece_edit(step);
  return edit != nullptr && std::holds_alternative<SelectPiece>(*edit);
}

/// Whether another piece may be active behind it: all but changes of looks, places and size.
bool may_choose_piece(const ScriptStep& step) {
  const PieceEdit* edit = piece_edit(step);
  return edit != nullptr && !std::holds_alternative<ChangePiece>(*edit) &&
         !std::holds_alternative<PlacePieces>(*edit) && !std::holds_alternative<ScalePiece>(*edit);
}

/// By how much a step makes what can be taken back deeper.
int deeper_by(const ScriptStep& step) {
  if (const auto* move = std::get_if<HistoryStep>(&step)) {
    return *move == HistoryStep::undo ? -1 : 1;
  }
  return is_select(step) ? 0 : 1;
}

}  // namespace

std::optional<HistoryCut> history_cut(const Journal& journal,
                                      const std::vector<std::uint64_t>& solid_bytes,
                                      const HistoryBounds& bounds) {
  assert(journal.first_read == 0 && journal.damage.empty());
  assert(solid_bytes.size() == journal.steps.size());
  std::uint64_t solids = 0;
  std::optional<HistoryCut> cut;
  int undos = 0;    // from the end to before step `first`
  int deepest = 0;  // of these, of all states from there on
  int redos = 0;    // from there on, of what was taken back before
  bool may_choose = false;
  for (std::size_t first = journal.steps.size(); first-- > 0;) {
    if (journal.steps.size() - first > bounds.steps) break;
    solids += solid_bytes[first];
    if (journal.whole_bytes - journal.begins[first] + solids > bounds.bytes) break;
    const ScriptStep& step = journal.steps[first];
    undos += deeper_by(step);
    deepest = std::max(deepest, undos);
    if (const auto* move = std::get_if<HistoryStep>(&step)) {
      redos = std::max(0, redos + (*move == HistoryStep::redo ? 1 : -1));
    }
    may_choose = may_choose || may_choose_piece(step);
    const bool is_whole = undos == deepest && redos == 0;
    if (!is_whole || undos > bounds.undos) continue;
    if (!may_choose || is_select(step)) cut = HistoryCut{first, undos};
  }
  return cut;
}

std::string steps_from(const Journal& journal, std::string_view text, std::size_t first,
                       const ScriptHeader& header) {
  assert(first < journal.steps.size());
  std::string left = sealed_line(header_line(header));
  left += "\n";
  for (std::size_t n = first; n < journal.steps.size(); ++n) {
    const std::size_t begin = journal.begins[n];
    left += text.substr(begin, text.find('\n', begin) - begin);
    left += "\n";
  }
  return left;
}

std::string shortened(const Journal& journal, std::string_view text, std::size_t first,
                      const std::string& base_hash, const std::string& end_hash) {
  return steps_from(journal, text, first, {std::nullopt, base_hash, journal.keeps_history}) +
         sealed_line(mark_line({end_hash, journal.steps.size() - first, true})) + "\n";
}

}  // namespace argil::io
