// SPDX-License-Identifier: GPL-3.0-or-later
// argil edit: changes a project as a whole, operation after operation.
#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "argil/engine/mask_filter.h"
#include "argil/engine/operation.h"
#include "argil/engine/sculpture.h"
#include "argil/io/solid_file.h"

#include "commands.h"
#include "common/options.h"
#include "common/output.h"
#include "common/project.h"

namespace argil::cli {
namespace {

/// An operation as the command line names it; `file` is of the other solid, read when it is due.
/// An edit of the mask or of the piece itself, whose name is filled in then, replaces the operation
/// when there is one.
struct NamedOperation {
  std::string name;
  Operation operation;
  std::string file;
  std::optional<std::variant<MaskEdit, MaskFilter>> mask = {};
  std::optional<std::variant<ScalePiece, SplitPiece>> piece = {};

  bool is_operation() const noexcept { return !mask && !piece; }
};

struct EditOptions {
  std::string project;
  std::string piece;
  std::filesystem::path output;
  std::map<std::string, std::vector<std::string>> texts;  // by option, in order
  std::vector<NamedOperation> operations;
};

/// `count` numbers parted by commas.
std::vector<double> parse_numbers(const std::string& option, const std::string& text,
                                  std::size_t count, const char* form) {
  std::vector<double> numbers;
  std::size_t begin = 0;
  // One more than the text is long: an empty number at its end is refused, not passed over.
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    numbers.push_back(parse_number(option + " " + form, text.substr(begin, end - begin), {}));
    begin = end + 1;
  }
  if (numbers.size() == count) return numbers;
  throw CLI::ValidationError(option + " is '" + text + "'; must be " + form + " without spaces");
}

Vec3 triple_at(const std::vector<double>& n, std::size_t first) {
  return {n[first], n[first + 1], n[first + 2]};
}

Drain parse_drain(const std::string& text) {
  const auto n = parse_numbers("--drain", text, 7, "X,Y,Z,DX,DY,DZ,R");
  return {triple_at(n, 0), triple_at(n, 3), n[6]};
}

Cut parse_cut(const std::string& text) {
  const auto n = parse_numbers("--cut", text, 6, "X,Y,Z,NX,NY,NZ");
  return {triple_at(n, 0), triple_at(n, 3), false};
}

void add_turn(const std::string& text, Combine& with) {
  const auto n = parse_numbers("--turn", text, 4, "W,X,Y,Z");
  with.placement.orientation = {n[0], n[1], n[2], n[3]};
}

/// The last operation when it is a T, else a throw that says what `option` belongs to.
template <class T>
T& last_operation(EditOptions& options, const std::string& option, const char* after) {
  T* last =
      options.operations.empty() ? nullptr : std::get_if<T>(&options.operations.back().operation);
  if (last != nullptr && options.operations.back().is_operation()) return *last;
  throw CLI::ValidationError(option + " belongs to " + after + "; name it right after that");
}

void add_combination(const std::string& option, const std::string& file, CombineKind kind,
                     EditOptions& options) {
  Combine with;
  with.kind = kind;
  options.operations.push_back({option.substr(2), with, file});
}

/// Of "cavity:R[,FACTOR]" with the numbers behind the colon.
MaskCavity parse_cavity(const std::string& text, bool is_inverted) {
  const bool has_factor = text.find(',') != std::string::npos;
  const auto n = parse_numbers("--mask", text, has_factor ? 2 : 1,
                               has_factor ? "cavity:RADIUS,FACTOR" : "cavity:RADIUS");
  return {n[0], has_factor ? n[1] : 1.0, is_inverted};
}

std::variant<MaskEdit, MaskFilter> parse_mask_edit(const std::string& text) {
  if (text == "clear") return MaskEdit::clear;
  if (text == "invert") return MaskEdit::invert;
  if (text == "blur") return MaskEdit::blur;
  if (text == "fill") return MaskEdit::fill;
  if (text == "sharpen") return MaskEdit::sharpen;
  const std::size_t colon = text.find(':');
  if (colon != std::string::npos) {
    const std::string name = text.substr(0, colon);
    const std::string numbers = text.substr(colon + 1);
    if (name == "grow" || name == "shrink") {
      const double by_mm = parse_number("--mask " + name, numbers, kPositive);
      return MaskFilter(MaskGrow{name == "grow" ? by_mm : -by_mm});
    }
    if (name == "cavity") return MaskFilter(parse_cavity(numbers, false));
    if (name == "cavity-inverted") return MaskFilter(parse_cavity(numbers, true));
  }
  throw CLI::ValidationError("--mask is '" + text +
                             "'; must be clear, invert, blur, fill, sharpen, grow:MM, shrink:MM, "
                             "cavity:RADIUS[,FACTOR] or cavity-inverted:RADIUS[,FACTOR]");
}

void read_operation(const std::string& option, const std::string& text, EditOptions& options) {
  constexpr const char* kSolids = "--union, --difference or --intersection";
  auto& list = options.operations;
  if (option == "--offset") {
    list.push_back({"offset", Offset{parse_number(option, text, {})}, ""});
  } else if (option == "--hollow") {
    list.push_back({"hollow", Hollow{parse_number(option, text, kPositive), {}}, ""});
  } else if (option == "--drain") {
    last_operation<Hollow>(options, option, "--hollow").drains.push_back(parse_drain(text));
  } else if (option == "--cut") {
    list.push_back({"cut", parse_cut(text), ""});
  } else if (option == "--union") {
    add_combination(option, text, CombineKind::unite, options);
  } else if (option == "--difference") {
    add_combination(option, text, CombineKind::subtract, options);
  } else if (option == "--intersection") {
    add_combination(option, text, CombineKind::intersect, options);
  } else if (option == "--at") {
    last_operation<Combine>(options, option, kSolids).placement.position_mm =
        parse_triple(option, text);
  } else if (option == "--turn") {
    add_turn(text, last_operation<Combine>(options, option, kSolids));
  } else if (option == "--mask") {
    list.push_back({"mask " + text, {}, "", parse_mask_edit(text)});
  } else if (option == "--scale") {
    list.push_back({"scale", {}, "", {}, ScalePiece{"", parse_number(option, text, kPositive)}});
  } else if (option == "--split") {
    list.push_back({"split", {}, "", {}, SplitPiece{"", parse_number(option, text, {})}});
  } else {
    list.push_back({"voxel", Resample{parse_number(option, text, kPositive)}, ""});
  }
}

/// Puts the operations in the order in which the command line named them.
void read_operations(const CLI::App& command, EditOptions& options) {
  options.operations.clear();
  std::map<std::string, std::size_t> read;
  // CLI11 collects the texts by option; their order is that of the operations.
  for (const CLI::Option* option : command.parse_order()) {
    const std::string name = option->get_name();
    const auto texts = options.texts.find(name);
    if (texts == options.texts.end()) continue;
    read_operation(name, texts->second.at(read[name]++), options);
  }
  // What CLI11 does not know it names itself, later.
  if (!options.operations.empty() || command.remaining_size() > 0) return;
  throw CLI::ValidationError("no operation was named; give at least one, such as --offset 0.4");
}

/// What is done to the active piece as a piece.
Result<OperationReport> apply_edit(const NamedOperation& named, Sculpture& sculpture,
                                   const Progress& progress) {
  const auto done = std::visit(
      [&](auto edit) {
        edit.name = sculpture.look(sculpture.active()).name;
        return sculpture.apply(PieceEdit(std::move(edit)), progress);
      },
      *named.piece);
  if (!done) return done.error();
  OperationReport report;
  report.replaced_levels = true;
  for (const LevelStats& level : sculpture.clay().level_stats()) {
    report.changed_leaves += level.leaves;
  }
  return report;
}

Result<OperationReport> apply_one(const NamedOperation& named, Sculpture& sculpture,
                                  const Progress& progress) {
  if (named.piece) return apply_edit(named, sculpture, progress);
  Clay& clay = sculpture.clay();
  if (named.mask) {
    const auto* filter = std::get_if<MaskFilter>(&*named.mask);
    auto ok = filter != nullptr ? filter_mask(clay, *filter, progress)
                                : clay.apply(std::get<MaskEdit>(*named.mask));
    if (!ok) return ok.error();
    return OperationReport{};
  }
  Operation operation = named.operation;
  if (auto* with = std::get_if<Combine>(&operation)) {
    auto other = io::read_operand(named.file);
    if (!other) return other.error();
    with->clay = std::move(other.value().clay);
    with->mesh = std::move(other.value().mesh);
  }
  return clay.apply(operation, progress);
}

Result<Json> run_one(const NamedOperation& named, Sculpture& sculpture, const Progress& progress) {
  const Stopwatch watch;
  const auto report = apply_one(named, sculpture, progress);
  if (!report) return Error{report.error().kind, named.name + ": " + report.error().message};
  Json json;
  json["operation"] = named.name;
  json["changed_leaves"] = report.value().changed_leaves;
  json["replaced_levels"] = report.value().replaced_levels;
  json["pieces"] = sculpture.piece_count();
  json["seconds"] = watch.seconds();
  return json;
}

std::string edit_text(const Json& json, const std::string& levels,
                      const std::filesystem::path& output) {
  std::string text;
  for (const Json& one : json["operations"]) {
    text += one["operation"].get<std::string>() + ": " +
            grouped(one["changed_leaves"].get<std::int64_t>()) + " leaves changed in " +
            number(one["seconds"].get<double>()) + " s\n";
  }
  return text + levels + "hash " + json["hash"].get<std::string>() + "\nsaved '" + output.string() +
         "'\n";
}

Result<void> check_files(const EditOptions& options) {
  if (auto input = check_input(options.project); !input) return input;
  for (const NamedOperation& named : options.operations) {
    if (named.file.empty()) continue;
    if (auto input = check_input(named.file); !input) return input;
  }
  return check_output(options.output);
}

Result<Outcome> run_edit(const EditOptions& options, const Progress& progress) {
  const Stopwatch watch;
  if (auto ok = check_files(options); !ok) return ok.error();
  auto opened = open_project(options.project, progress);
  if (!opened) return opened.error();
  Sculpture& sculpture = opened.value().sculpture;
  const std::string active = sculpture.look(sculpture.active()).name;
  const std::uint64_t first_hash = sculpture.hash();
  if (auto selected = select_piece(options.project, options.piece, sculpture); !selected) {
    return selected.error();
  }
  if (auto free = sculpture.check_unlocked(); !free) return named(options.project, free.error());
  Outcome outcome;
  outcome.json["operations"] = Json::array();
  for (const NamedOperation& named : options.operations) {
    auto done = run_one(named, sculpture, progress);
    if (!done) return done.error();
    outcome.json["operations"].push_back(std::move(done).value());
    if (auto stop = check_interrupt(); !stop) return stop.error();
  }
  outcome.json["levels"] = to_json(sculpture.clay().level_stats());
  const std::string levels = levels_text(sculpture.clay().level_stats());
  // That another piece was worked on is no reason that it is worked on next.
  if (auto back = sculpture.apply(SelectPiece{active}); !back) return back.error();
  if (auto saved = replace_project(options.output, sculpture); !saved) return saved.error();
  outcome.json["recovered_strokes"] = opened.value().recovered_steps;
  outcome.json["hash"] = hex(sculpture.hash());
  outcome.json["start_hash"] = hex(first_hash);
  outcome.json["seconds"] = watch.seconds();
  outcome.text = edit_text(outcome.json, levels, options.output);
  return outcome;
}

}  // namespace

void add_edit(CLI::App& app, Selected& selected) {
  auto options = std::make_shared<EditOptions>();
  CLI::App* command =
      add_command(app, selected, "edit", "change a project as a whole: operations in their order",
                  [options](const Progress& progress) { return run_edit(*options, progress); });
  command->add_option("PROJECT", options->project, "the project to change")->required();
  add_piece_option(*command, options->piece);
  add_file(*command, "-o,--output", options->output, {".vdb"}, "the project to write")->required();
  const auto add = [&](const std::string& name, const char* form, const char* help) {
    // One word for each option, or CLI11 would take the operand behind it as well.
    command->add_option(name, options->texts[name], help)
        ->allow_extra_args(false)
        ->option_text(form);
  };
  add("--offset", "MM", "move the surface outward, inward where negative");
  add("--hollow", "WALL", "leave a wall of so many mm");
  add("--drain", "X,Y,Z,DX,DY,DZ,R", "after --hollow: a hole from a point along a direction");
  add("--cut", "X,Y,Z,NX,NY,NZ", "take away what the normal of a plane points to");
  add("--union", "FILE", "add another project or mesh");
  add("--difference", "FILE", "take another project or mesh away");
  add("--intersection", "FILE", "keep what lies in another project or mesh");
  add("--at", "X,Y,Z", "after one of these three: where the other's origin goes");
  add("--turn", "W,X,Y,Z", "after one of these three: the quaternion that turns the other");
  add("--voxel-mm", "H", "resample to another finest voxel");
  add("--scale", "FACTOR", "so many times as large, about its origin; the voxel grows with it");
  add("--split", "SHARE",
      "each solid a piece of its own; less than SHARE of the largest one's volume stays with it");
  add("--mask", "WHAT",
      "the mask: clear, invert, blur, fill, sharpen, grow:MM, shrink:MM or cavity:RADIUS[,FACTOR]");
  command->parse_complete_callback([command, options] { read_operations(*command, *options); });
}

}  // namespace argil::cli
