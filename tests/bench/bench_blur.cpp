// SPDX-License-Identifier: GPL-3.0-or-later
// How much of the picture is not yet what it should be 100 ms after a dab: strokes with tools of
// several sizes on a ball whose finest level is everywhere, drawn as the window draws them. While
// the tool is held against a redraw of another clay that has the same dabs, none of them waiting;
// 100 ms after the end of the stroke against the clay when everything is done. Prints a markdown
// table. Usage: bench_blur [LEAST_RADIUS_MM [VOXEL_MM]]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "argil/io/project_file.h"
#include "argil/io/stroke_script.h"

#include "bench/clock.h"
#include "bench/quantile.h"
#include "document/block_news.h"
#include "document/document_thread.h"
#include "gl/gl_renderer.h"
#include "picture/camera.h"
#include "support/bumpy_clay.h"
#include "support/scratch.h"
#include "viewer/support/offscreen.h"

namespace argil::bench {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr double kBallMm = 14.0;
constexpr double kVoxelMm = 0.1;  ///< unless another is asked for
constexpr double kAfterMs = 100.0;
constexpr int kDabs = 24;
constexpr int kStepsSeen = 4;  ///< of 255: what the eye tells apart beside its neighbour

[[noreturn]] void stop(const std::string& message) {
  std::fprintf(stderr, "bench_blur: %s\n", message.c_str());
  std::exit(1);
}

/// A window without panels, looked into while the document thread works.
class Watched {
 public:
  explicit Watched(double voxel_mm) {
    std::string why_not;
    screen_ = test::Offscreen::make(kWidth, kHeight, why_not);
    if (screen_ == nullptr) stop(why_not);
    renderer_ = renderer();
    redrawer_ = renderer();
    const double half = kBallMm + 3.0;
    content_mm_ = {{-half, -half, -half}, {half, half, half}};
    camera_.resize(kWidth, kHeight);
    camera_.look_from({0.0, -1.0, 0.0}, {0.0, 0.0, 1.0});
    camera_.frame(content_mm_);
    camera_.zoom(2.0, {0.5 * kWidth, 0.5 * kHeight});  // the usual voxel is three pixels
    auto clay = test::bumpy_ball(kBallMm, voxel_mm);
    if (!clay) stop(clay.error().message);
    if (auto done = io::save_project(folder_ / "p.vdb", clay.value()); !done)
      stop(done.error().message);
    other_ = std::make_unique<Clay>(std::move(clay).value());
    thread_.look(camera_.display_view());
    thread_.send(viewer::OpenFile{folder_ / "p.vdb"});
    while (!thread_.is_idle()) take();
    settle();
  }

  viewer::DocumentThread& thread() { return thread_; }
  /// The clay that is redrawn, with a stroke of its own.
  Clay& other() { return *other_; }

  Image redrawn() {
    auto news = feed_.update(*other_, camera_.display_view());
    if (!news) stop(news.error().message);
    put(news.value(), *redrawer_);
    draw(*redrawer_);
    return redrawer_->read_image(screen_->framebuffer(), kWidth, kHeight);
  }

  /// As the window would show it then, each piece of news drawn when it is there.
  Image after(double ms) {
    const double end = wall_ms() + ms;
    do {
      if (!take()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    } while (wall_ms() < end);
    return image();
  }
  Image settled() {
    settle();
    return image();
  }

 private:
  bool take() {
    std::vector<double> inputs;
    const viewer::SceneNews news = thread_.take_blocks(inputs);
    for (const auto& [piece, blocks] : news.pieces) {
      piece_ = piece;
      put(blocks, *renderer_);
    }
    if (!news.empty()) draw(*renderer_);
    return !news.empty();
  }
  void settle() {
    do {
      if (!take()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    } while (!thread_.is_idle());
  }
  void put(const viewer::BlockNews& news, viewer::Renderer& renderer) const {
    if (news.is_fresh) renderer.drop(piece_);
    for (const BlockId& id : news.gone) renderer.drop(piece_, id);
    for (const auto& [id, block] : news.changed) {
      if (const auto done = renderer.put(piece_, block); !done) stop(done.error().message);
    }
  }
  void draw(viewer::Renderer& renderer) {
    viewer::Picture picture;
    picture.pieces = {viewer::ShownPiece{.piece = piece_}};
    picture.lens = camera_.lens(content_mm_);
    const auto done = renderer.draw(picture, screen_->framebuffer(), kWidth, kHeight);
    if (!done) stop(done.error().message);
  }
  static std::unique_ptr<viewer::Renderer> renderer() {
    auto made = viewer::make_gl_renderer();
    if (!made) stop(made.error().message);
    return std::move(made).value();
  }
  Image image() { return renderer_->read_image(screen_->framebuffer(), kWidth, kHeight); }

  test::ScratchFolder folder_;
  viewer::DocumentThread thread_{viewer::DocumentThreadOptions{folder_.path()}};
  std::unique_ptr<test::Offscreen> screen_;
  std::unique_ptr<viewer::Renderer> renderer_;
  std::unique_ptr<viewer::Renderer> redrawer_;
  std::unique_ptr<Clay> other_;
  viewer::BlockFeed feed_;  ///< of that
  viewer::Camera camera_;
  Box3 content_mm_;
  viewer::PieceKey piece_ = 0;
};

/// The share of pixels, in percent, of which any colour differs by more than can be seen.
double differing_percent(const Image& a, const Image& b) {
  std::size_t count = 0;
  const std::size_t pixels = a.rgb.size() / 3;
  for (std::size_t n = 0; n < pixels; ++n) {
    int most = 0;
    for (std::size_t c = 3 * n; c < 3 * n + 3; ++c)
      most = std::max(most, std::abs(int{a.rgb[c]} - int{b.rgb[c]}));
    count += most > kStepsSeen ? 1 : 0;
  }
  return 100.0 * static_cast<double>(count) / static_cast<double>(pixels);
}

/// What was seen of one stroke 100 ms after its last dab, while the tool is still held, and 100 ms
/// after its end.
struct Seen {
  double held = 0.0;
  double ended = 0.0;
};

/// The stroke as far as `dabs`, each dab followed by 100 ms; then it is taken back.
Seen seen_of(Watched& window, const Tool& tool, int dabs) {
  window.thread().send(viewer::BeginStroke{tool, {}});
  if (const auto begun = window.other().begin_stroke(tool); !begun) stop(begun.error().message);
  Seen seen;
  Image held;
  for (int n = 0; n < dabs; ++n) {
    const double turn = 0.03 * n - 0.36;
    const Vec3 place = kBallMm * Vec3{std::sin(turn), -std::cos(turn), 0.1};
    const std::vector<StrokeSample> samples{{0.1 * n, place, {}, 1.0}};
    window.thread().send(viewer::ExtendStroke{samples, 0.0});
    held = window.after(kAfterMs);
    if (const auto done = window.other().extend_stroke(samples); !done) stop(done.error().message);
  }
  seen.held = differing_percent(held, window.redrawn());
  window.other().cancel_stroke();
  window.thread().send(viewer::EndStroke{});
  const Image ended = window.after(kAfterMs);
  seen.ended = differing_percent(ended, window.settled());
  window.thread().send(viewer::DoStep{io::HistoryStep::undo});
  window.settled();
  return seen;
}

void stroke(Watched& window, Action action, const char* name, double radius_mm, double strength) {
  Tool tool;
  tool.action = action;
  tool.radii_mm = {radius_mm, radius_mm, radius_mm};
  tool.strength = strength;
  std::vector<double> held;
  std::vector<double> ended;
  for (int dabs = kDabs / 4; dabs <= kDabs; dabs += kDabs / 4) {
    const Seen seen = seen_of(window, tool, dabs);
    held.push_back(seen.held);
    ended.push_back(seen.ended);
  }
  std::printf("| %s, %.1f mm | %.3f | %.3f | %.3f | %.3f |\n", name, radius_mm, quantile(held, 0.5),
              quantile(held, 1.0), quantile(ended, 0.5), quantile(ended, 1.0));
  std::fflush(stdout);
}

}  // namespace
}  // namespace argil::bench

int main(int count, char** arguments) {
  using namespace argil;
  using namespace argil::bench;
  const double least_mm = count > 1 ? std::atof(arguments[1]) : 0.0;
  Watched window(count > 2 ? std::atof(arguments[2]) : kVoxelMm);
  std::printf(
      "Percent of all pixels that differ by more than %d of 255 from a redraw of the clay with "
      "the\n"
      "same dabs; strokes of %d to %d dabs, 100 ms each.\n\n"
      "| tool | 100 ms after a dab, median | worst | 100 ms after the end, median | worst |\n"
      "|---|---|---|---|---|\n",
      kStepsSeen, kDabs / 4, kDabs);
  for (const double radius : {1.0, 3.0, 5.0, 8.0}) {
    if (radius < least_mm) continue;
    stroke(window, Action::inflate, "Draw", radius, 0.4);
    stroke(window, Action::carve, "Carve", radius, 0.5);
    stroke(window, Action::smooth, "Smooth", radius, 0.5);
    stroke(window, Action::grab, "Grab", radius, 0.4);
    stroke(window, Action::twist, "Twist", radius, 0.4);
    stroke(window, Action::elastic, "Elastic", radius, 0.4);
  }
}
