// SPDX-License-Identifier: GPL-3.0-or-later
// argil render: a picture of a project or mesh, without a display.
#include <charconv>
#include <memory>

#include "argil/engine/render.h"
#include "argil/engine/surface.h"
#include "argil/io/png.h"

#include "commands.h"
#include "common/options.h"
#include "common/output.h"
#include "common/project.h"
#include "mesh_input.h"

namespace argil::cli {
namespace {

constexpr int kLeastPixels = 16;
constexpr int kMostPixels = 16384;

struct RenderCommand {
  std::string input;
  std::string piece;
  std::filesystem::path picture;
  RenderOptions render;
  MeshFrameOptions frame;
};

struct View {
  const char* name;
  Vec3 toward;  // from the object toward the camera
  Vec3 up;
};

// The front is seen from -y and z is up, as on a printer's bed. The side views look down a little,
// so that the ground and its shadow show.
constexpr Vec3 kZ{0.0, 0.0, 1.0};
constexpr Vec3 kY{0.0, 1.0, 0.0};
constexpr View kViews[] = {
    {"iso", {0.55, -1.0, 0.42}, kZ},  {"front", {0.0, -1.0, 0.12}, kZ},
    {"back", {0.0, 1.0, 0.12}, kZ},   {"left", {-1.0, 0.0, 0.12}, kZ},
    {"right", {1.0, 0.0, 0.12}, kZ},  {"top", {0.0, 0.0, 1.0}, kY},
    {"bottom", {0.0, 0.0, -1.0}, kY},
};

void read_view(const std::string& text, RenderOptions& options) {
  for (const View& view : kViews) {
    if (text != view.name) continue;
    options.toward = view.toward;
    options.up = view.up;
    return;
  }
  if (text.find(',') == std::string::npos) {
    throw CLI::ValidationError("--view is '" + text +
                               "'; must be iso, front, back, left, right, top, bottom or a "
                               "direction X,Y,Z toward the camera");
  }
  options.toward = parse_triple("--view", text);
  options.up = kZ;
}

void read_size(const std::string& text, RenderOptions& options) {
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, options.width);
  // from_chars and not scanf: no blanks, and nothing behind the numbers.
  const bool parted = width.ec == std::errc{} && width.ptr != end && *width.ptr == 'x';
  const auto height = std::from_chars(parted ? width.ptr + 1 : end, end, options.height);
  const auto fits = [](int pixels) { return pixels >= kLeastPixels && pixels <= kMostPixels; };
  if (parted && height.ec == std::errc{} && height.ptr == end && fits(options.width) &&
      fits(options.height)) {
    return;
  }
  throw CLI::ValidationError("--size is '" + text +
                             "'; must be WIDTHxHEIGHT in pixels, each 16 to 16384, as in 1280x960");
}

bool is_project(const std::filesystem::path& file) { return file.extension() == ".vdb"; }

/// What is to be seen, and the clay it is of, for its mask; none for a mesh or several pieces.
struct Subject {
  TriangleMesh mesh;
  std::shared_ptr<const Clay> clay;
  std::int64_t recovered = 0;
  Json frame = Json::object();  ///< of a mesh
};

Result<Subject> subject_of(const std::string& file, const std::string& piece,
                           const MeshFrameOptions& frame, const Progress& progress) {
  if (!is_project(file)) {
    if (auto none = check_no_piece(file, piece); !none) return none.error();
    auto read = open_mesh(file, frame);
    if (!read) return read.error();
    Subject subject{std::move(read.value().mesh), nullptr, 0};
    add_frame_keys(subject.frame, read.value().frame);
    return subject;
  }
  if (auto none = check_no_frame(file, frame); !none) return none.error();
  auto opened = open_project(file, progress);
  if (!opened) return opened.error();
  const std::int64_t recovered = opened.value().recovered_steps;
  Sculpture& sculpture = opened.value().sculpture;
  if (piece.empty() && sculpture.piece_count() > 1) {
    auto surface = extract_surface(sculpture, progress);
    if (!surface) return surface.error();
    return Subject{std::move(surface).value(), nullptr, recovered};
  }
  if (auto selected = select_piece(file, piece, sculpture); !selected) return selected.error();
  auto clay = std::make_shared<const Clay>(std::move(sculpture).take_clay());
  auto surface = extract_surface(*clay, progress);
  if (!surface) return surface.error();
  return Subject{std::move(surface).value(), clay, recovered};
}

Result<Outcome> run_render(const RenderCommand& command, const Progress& progress) {
  const Stopwatch watch;
  if (auto input = check_input(command.input); !input) return input.error();
  if (auto output = check_output(command.picture); !output) return output.error();
  const auto read = subject_of(command.input, command.piece, command.frame, progress);
  if (!read) return read.error();
  const Subject& subject = read.value();
  if (auto stop = check_interrupt(); !stop) return stop.error();
  const Stopwatch render_watch;
  RenderOptions options = command.render;
  if (subject.clay && subject.clay->has_mask()) {
    // What is masked is drawn darker.
    options.darkness = [&](const Vec3& point_mm) { return subject.clay->mask_at(point_mm); };
  }
  const auto image = render(subject.mesh, options, progress);
  if (!image) return image.error();
  const double render_seconds = render_watch.seconds();
  auto saved = io::write_png(command.picture, image.value(), progress);
  if (!saved) return saved.error();
  Outcome outcome;
  outcome.json["seconds"] = watch.seconds();
  outcome.json["render_seconds"] = render_seconds;
  outcome.json["triangles"] = subject.mesh.triangles.size();
  outcome.json["recovered_strokes"] = subject.recovered;
  outcome.json["width"] = image.value().width;
  outcome.json["height"] = image.value().height;
  outcome.json.update(subject.frame);
  outcome.text = "saved '" + command.picture.string() + "' in " + number(watch.seconds()) + " s\n";
  return outcome;
}

}  // namespace

void add_render(CLI::App& app, Selected& selected) {
  auto options = std::make_shared<RenderCommand>();
  read_view("iso", options->render);
  CLI::App* command =
      add_command(app, selected, "render", "make a picture of a project or mesh",
                  [options](const Progress& progress) { return run_render(*options, progress); });
  command
      ->add_option("INPUT", options->input, "a project (NAME.vdb) or OBJ, STL, PLY, GLB, glTF, 3MF")
      ->required();
  add_file(*command, "-o,--output", options->picture, {".png"}, "the picture to write")->required();
  add_piece_option(*command, options->piece);
  options->frame.add_to(*command);
  command
      ->add_option_function<std::string>(
          "--size", [options](const std::string& text) { read_size(text, options->render); },
          "pixels; default 1280x960")
      ->type_name("WxH");
  command
      ->add_option_function<std::string>(
          "--view", [options](const std::string& text) { read_view(text, options->render); },
          "iso, front, back, left, right, top, bottom, or a direction X,Y,Z toward the camera")
      ->type_name("VIEW");
  add_integer(*command, "--samples", options->render.samples, 1, 8,
              "rays across a pixel on edges; default 4");
}

}  // namespace argil::cli
