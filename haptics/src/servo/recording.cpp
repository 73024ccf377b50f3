// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/servo/recording.h"

#include <array>
#include <bit>
#include <cassert>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cmath>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace argil::haptics {
namespace {

constexpr std::size_t kRingTicks = std::size_t{1} << 15U;
constexpr std::size_t kChunk = std::size_t{1} << 16U;
constexpr auto kIdle = std::chrono::milliseconds(5);
/// After so many ticks it is looked whether to go on.
constexpr std::uint64_t kLookTicks = 256;

constexpr std::string_view kHeader =
    "tick,time_s,ready,x_mm,y_mm,z_mm,buttons,vx_mm_per_s,vy_mm_per_s,vz_mm_per_s,"
    "proxy_x_mm,proxy_y_mm,proxy_z_mm,wanted_x_n,wanted_y_n,wanted_z_n,force_x_n,force_y_n,"
    "force_z_n,most_stiffness_n_per_m,faults,window,window_answers,window_age_s";
/// Recordings of before have no such column.
constexpr std::string_view kAgeColumn = ",window_age_s";
constexpr std::string_view kHeaderWithoutAge =
    kHeader.substr(0, kHeader.size() - kAgeColumn.size());
static_assert(kHeader.ends_with(kAgeColumn));

/// The columns of a tick, in the order of kHeader: written and read by the same list.
template <class Tick, class Column>
void each_column(Tick& tick, bool has_age, const Column& column) {
  const auto triple = [&](auto& v) {
    column(v.x);
    column(v.y);
    column(v.z);
  };
  column(tick.number);
  column(tick.time_s);
  column(tick.is_ready);
  triple(tick.position_mm);
  column(tick.buttons);
  triple(tick.velocity_mm_per_s);
  triple(tick.proxy_mm);
  triple(tick.wanted_n);
  triple(tick.force_n);
  column(tick.most_stiffness_n_per_m);
  column(tick.faults);
  column(tick.window.sequence);
  column(tick.window.answers);
  if (has_age) column(tick.window.age_s);
}

/// The shortest text that reads back as the same number.
template <class Number>
void append(std::string& line, Number value) {
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  assert(error == std::errc());
  line.append(text.data(), static_cast<std::size_t>(end - text.data()));
}
void append(std::string& line, bool value) { line += value ? '1' : '0'; }

void append_tick(std::string& text, const ServoTick& tick) {
  each_column(tick, true, [&](const auto& value) {
    append(text, value);
    text += ',';
  });
  text.back() = '\n';
}

bool parse_number(std::string_view text, bool& value) {
  value = text == "1";
  return value || text == "0";
}
template <class Number>
bool parse_number(std::string_view text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

/// Whether a replay can give it to the servo: a position where a handle can be, and a time; and
/// whether its age is one. The other columns are only compared with, and may be NaN where a scene
/// failed.
bool is_replayable(const ServoTick& tick) {
  constexpr double kLatestS = 1e9;  // thirty years
  return is_in_reach(tick.position_mm) && std::abs(tick.time_s) <= kLatestS &&
         std::abs(tick.window.age_s) <= kLatestS;
}

bool parse_tick(std::string_view line, bool has_age, ServoTick& tick) {
  bool is_good = true;
  bool is_over = false;
  each_column(tick, has_age, [&](auto& value) {
    const std::size_t comma = line.find(',');
    is_good = is_good && !is_over && parse_number(line.substr(0, comma), value);
    is_over = comma == std::string_view::npos;
    line = is_over ? std::string_view() : line.substr(comma + 1);
  });
  return is_good && is_over && is_replayable(tick);
}

/// Where a recording is written until it is whole.
std::filesystem::path part_of(std::filesystem::path file) { return file += ".part"; }

Error disk_error(const std::string& what, const std::filesystem::path& file, int error) {
  return {ErrorKind::disk, "cannot " + what + " '" + file.string() + "' (" +
                               std::generic_category().message(error) +
                               "); check the folder and the free space"};
}

/// 0, or the errno.
int write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(descriptor, text.data(), text.size());
    if (count < 0 && errno != EINTR) return errno;
    if (count > 0) text.remove_prefix(static_cast<std::size_t>(count));
  }
  return 0;
}

/// Shows how far a recording is written or replayed; false: stop.
bool may_go_on(const Progress& progress, const char* stage, const ServoTick& tick,
               const Recording& recording) {
  if (!progress || tick.number % kLookTicks != 0) return true;
  return progress(stage,
                  static_cast<double>(tick.number) / static_cast<double>(recording.ticks.size()));
}

Error interrupted(const char* what) { return {ErrorKind::interrupted, what}; }

bool same_bits(const Vec3& a, const Vec3& b) noexcept {
  const auto same = [](double p, double q) {
    return std::bit_cast<std::uint64_t>(p) == std::bit_cast<std::uint64_t>(q);
  };
  return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z);
}

/// Makes a new FILE.part, where a killed run may have left one, and never what a link of that name
/// leads to; its descriptor.
Result<int> open_part(const std::filesystem::path& file, const std::string& note) {
  if (note.find_first_of("\r\n") != std::string::npos) {
    return Error{ErrorKind::bad_input,
                 "the note of a recording must be one line; got '" + note + "'"};
  }
  const std::filesystem::path part = part_of(file);
  ::unlink(part.c_str());
  const int descriptor =
      ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644);
  if (descriptor < 0) return disk_error("write", part, errno);
  return descriptor;
}

std::string head_of(const std::string& note) {
  return "# " + note + "\n" + std::string(kHeader) + "\n";
}

/// Of what is not whole.
void discard_part(const std::filesystem::path& file, int descriptor) {
  ::close(descriptor);
  ::unlink(part_of(file).c_str());
}

/// Syncs, closes and renames, or removes what is not whole; `failed` is the errno of an earlier
/// write.
Result<void> close_part(const std::filesystem::path& file, int descriptor, int failed) {
  const std::filesystem::path part = part_of(file);
  if (failed == 0 && ::fsync(descriptor) != 0) failed = errno;
  if (::close(descriptor) != 0 && failed == 0) failed = errno;
  if (failed == 0 && ::rename(part.c_str(), file.c_str()) != 0) failed = errno;
  if (failed == 0) return {};
  ::unlink(part.c_str());
  return disk_error("write", file, failed);
}

}  // namespace

Recorder::Recorder(std::filesystem::path file, int descriptor)
    : file_(std::move(file)), descriptor_(descriptor), ring_(kRingTicks) {
  assert(descriptor_ >= 0);
}

Result<std::unique_ptr<Recorder>> Recorder::start(const std::filesystem::path& file,
                                                  const std::string& note) {
  const auto descriptor = open_part(file, note);
  if (!descriptor) return descriptor.error();
  std::unique_ptr<Recorder> recorder(new Recorder(file, descriptor.value()));
  recorder->thread_ = std::thread(&Recorder::run, recorder.get(), head_of(note));
  return recorder;
}

void Recorder::run(const std::string& head) {
  std::string text = head;
  const auto write_out = [&] {
    if (errno_ == 0) errno_ = write_all(descriptor_, text);
    text.clear();
  };
  for (bool last = false; !last;) {
    last = stop_.load(std::memory_order_acquire);  // before the ring: what came earlier is in it
    for (ServoTick tick; ring_.pop(tick); ++written_) {
      append_tick(text, tick);
      if (text.size() > kChunk) write_out();
    }
    write_out();
    if (!last) std::this_thread::sleep_for(kIdle);
  }
}

/// The thread drains the ring once more after it has seen `stop_`, so that nothing is lost.
Result<void> Recorder::finish() {
  stop_.store(true, std::memory_order_release);
  if (!thread_.joinable()) return {};
  thread_.join();
  if (dropped() == 0) return close_part(file_, descriptor_, errno_);
  discard_part(file_, descriptor_);
  return Error{ErrorKind::disk, "the recorder lost " + std::to_string(dropped()) +
                                    " ticks, so the recording was not kept; record to a faster "
                                    "disk"};
}

Recorder::~Recorder() {
  if (!thread_.joinable()) return;
  // Not finished: what is there is not a recording and must not replace one.
  stop_.store(true, std::memory_order_release);
  thread_.join();
  discard_part(file_, descriptor_);
}

Result<void> write_recording(const std::filesystem::path& file, const Recording& recording,
                             const Progress& progress) {
  const auto descriptor = open_part(file, recording.note);
  if (!descriptor) return descriptor.error();
  std::string text = head_of(recording.note);
  int failed = 0;
  for (const ServoTick& tick : recording.ticks) {
    if (!may_go_on(progress, "record", tick, recording)) {
      discard_part(file, descriptor.value());
      return interrupted("interrupted; the recording was not kept");
    }
    append_tick(text, tick);
    if (text.size() < kChunk || failed != 0) continue;
    failed = write_all(descriptor.value(), text);
    text.clear();
  }
  if (failed == 0) failed = write_all(descriptor.value(), text);
  return close_part(file, descriptor.value(), failed);
}

Result<Recording> read_recording(const std::filesystem::path& file) {
  const auto bad = [&](std::size_t line, const std::string& what) {
    std::string text = file.string();  // built up by appending: GCC 12 warns of operator+ here
    text.insert(0, 1, '\'').append("' line ").append(std::to_string(line));
    return Error{ErrorKind::bad_input, text.append(": ").append(what)};
  };
  std::ifstream in(file);
  if (!in) return disk_error("read", file, errno);
  Recording recording;
  std::string line;
  if (!std::getline(in, line) || line.rfind("# ", 0) != 0) {
    return bad(1, "not a recording of the servo; make one with 'argil lab SCENE -o RUN.csv'");
  }
  recording.note = line.substr(2);
  std::getline(in, line);
  const bool has_age = line == kHeader;
  if (!in || in.eof() || !(has_age || line == kHeaderWithoutAge)) {
    return bad(2, "the columns are not those of this version; record it again");
  }
  for (std::size_t number = 3; std::getline(in, line); ++number) {
    ServoTick tick;
    if (in.eof() || !parse_tick(line, has_age, tick)) {  // a last line without its end was cut off
      return bad(number, "not a tick; the file is damaged or cut off");
    }
    if (tick.number != recording.ticks.size() + 1) {
      return bad(number, "tick " + std::to_string(recording.ticks.size() + 1) +
                             " is missing: the recorder could not keep up; record it again on a "
                             "faster disk");
    }
    recording.ticks.push_back(tick);
  }
  if (in.bad()) return disk_error("read", file, errno);
  return recording;
}

DeviceReading ReplayDevice::read(double /*now_s*/) noexcept {
  DeviceReading reading;
  reading.is_ready = false;
  if (next_ < recording_.ticks.size()) {
    const ServoTick& tick = recording_.ticks[next_++];
    is_answered_ = false;
    reading = {tick.position_mm, tick.buttons, tick.is_ready};
  }
  return reading;
}

void ReplayDevice::write(const Vec3& force_n) noexcept {
  if (is_answered_) return;  // the zero of a servo that ends was not recorded
  is_answered_ = true;
  assert(next_ > 0 && next_ <= recording_.ticks.size());
  const ServoTick& tick = recording_.ticks[next_ - 1];
  if (same_bits(tick.force_n, force_n)) return;
  ++different_;
  if (first_different_ == 0) first_different_ = tick.number;
}

Result<void> replay(Servo& servo, const Recording& recording,
                    const std::function<Result<void>(const ServoTick&)>& before,
                    const Progress& progress) {
  for (const ServoTick& tick : recording.ticks) {
    if (!may_go_on(progress, "replay", tick, recording)) {
      return interrupted("interrupted; the recording was not replayed to its end");
    }
    if (before) {
      if (auto done = before(tick); !done) return done;
    }
    (tick.faults & kHalted) != 0 ? servo.halt() : servo.resume();
    servo.tick(tick.time_s);
  }
  return {};
}

}  // namespace argil::haptics
