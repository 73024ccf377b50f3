// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/input_script.h"

#include <cassert>
#include <charconv>
#include <fstream>
#include <set>
#include <sstream>
#include <system_error>
#include <utility>

#include "base/text.h"
#include "input/key_name.h"
#include "input/pen.h"

namespace argil::viewer {
namespace {

constexpr int kUsualMoves = 12;
constexpr int kMostMoves = 10'000;

/// From where to where a number may go: what a window can be told, with room to spare.
struct Range {
  double least;
  double most;
  const char* text;  ///< both, with the unit, for the message
};
constexpr Range kPixels{-1e5, 1e5, "a number from -100000 to 100000 pixels"};
constexpr Range kScrollSteps{-100.0, 100.0, "a number from -100 to 100"};
constexpr Range kPressure{0.0, 1.0, "a number from 0 to 1"};
constexpr Range kPuckFraction{-1.0, 1.0, "a number from -1 to 1"};
constexpr Range kPuckSeconds{0.0, 10.0, "a number from 0 to 10 seconds"};
constexpr Range kFinger{1.0, 10.0, "a whole number from 1 to 10"};
constexpr Range kCount{1.0, kMostMoves, "a whole number from 1 to 10000"};
constexpr Range kWidth{320.0, 8192.0, "a whole number from 320 to 8192 pixels"};
constexpr Range kHeight{240.0, 8192.0, "a whole number from 240 to 8192 pixels"};

/// What a line could not be read as.
struct Misread {
  std::string what;
};

/// Reads one line of a script into steps. Throws Misread for what it does not understand: errors of
/// nested parts need no way back of their own, and read_input_script turns them into an Error.
class LineReader {
 public:
  /// What earlier lines have left.
  struct State {
    PenState pen;
    std::set<int> fingers;  ///< that are down
  };

  /// `state`, which this line may change for all that follow.
  LineReader(const std::string& line, int number, State& state, std::vector<ScriptStep>& steps)
      : words_(line), number_(number), pen_(state.pen), fingers_(state.fingers), steps_(steps) {}

  void read() {
    std::string command;
    if (!(words_ >> command) || command[0] == '#') return;
    if (command == "move") {
      const double x = value("X", kPixels);
      const double y = value("Y", kPixels);
      move(x, y, {});
    } else if (command == "press" || command == "release") {
      const MouseButton with = button();
      press(with, command == "press", modifiers());
    } else if (command == "drag") {
      drag();
    } else if (command == "scroll") {
      event(InputEvent::Kind::scroll).steps = value("STEPS", kScrollSteps);
    } else if (command == "pen") {
      pen();
    } else if (command == "puck") {
      puck();
    } else if (command == "finger") {
      finger();
    } else if (command == "key") {
      key();
    } else if (command == "hold") {
      const KeyChord held = read_chord();
      InputEvent& pressed = event(InputEvent::Kind::key_down);
      pressed.key = held.key;
      pressed.modifiers = held.modifiers;
    } else if (command == "let") {
      event(InputEvent::Kind::key_up).key = read_chord().key;
    } else if (command == "type") {
      type(rest("TEXT"));
    } else if (command == "click") {
      // Two frames each: the panels take the pointer of one frame into account in the next.
      add(PointAt{rest("LABEL")});
      add(WaitFrames{2});
      press(MouseButton::left, true, {});
      press(MouseButton::left, false, {});
      add(WaitFrames{2});
    } else if (command == "settle") {
      add(Settle{});
    } else if (command == "frames") {
      add(WaitFrames{whole("N", kCount)});
    } else if (command == "resize") {
      const int width = whole("WIDTH", kWidth);
      add(Resize{width, whole("HEIGHT", kHeight)});
    } else if (command == "drop") {
      event(InputEvent::Kind::drop).files = {rest("FILE")};
    } else if (command == "shot") {
      add(Shot{rest("FILE.png")});
    } else if (command == "close") {
      event(InputEvent::Kind::close);
    } else {
      throw Misread{in_quotes(command) + " is no command"};
    }
    std::string more;
    if (words_ >> more && more[0] != '#') throw Misread{in_quotes(more) + " is one word too many"};
  }

 private:
  template <class What>
  void add(What what) {
    assert(number_ > 0);
    ScriptStep& step = steps_.emplace_back();
    step.line = number_;
    step.what.template emplace<What>(std::move(what));
  }

  void pen() {
    pen_.pressure = value("PRESSURE", kPressure);
    std::string end;
    pen_.is_eraser = static_cast<bool>(words_ >> end);
    if (pen_.is_eraser && end != "eraser") {
      throw Misread{in_quotes(end) + " is no end of a pen; must be eraser, or nothing"};
    }
  }

  /// A press happens where the pointer is then.
  InputEvent& event(InputEvent::Kind kind) {
    PlayEvent played;
    played.event.kind = kind;
    played.event.pressure = pen_.pressure;
    played.event.is_eraser = pen_.is_eraser;
    add(std::move(played));
    return std::get<PlayEvent>(steps_.back().what).event;
  }

  /// `name` as docs/viewer.md calls the argument, for the message.
  double value(const char* name, const Range& range) {
    std::string word;
    words_ >> word;
    try {
      std::size_t used = 0;
      const double number = std::stod(word, &used);
      const bool is_in_range = number >= range.least && number <= range.most;  // a NaN is not
      if (used == word.size() && is_in_range) return number;
    } catch (const std::exception&) {
    }
    throw misread(name, word, range);
  }

  static Misread misread(const char* name, const std::string& word, const Range& range) {
    return {std::string(name) + " is " + in_quotes(word) + "; must be " + range.text};
  }

  int whole(const char* name, const Range& range) {
    std::string word;
    words_ >> word;
    int number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    const bool is_whole = error == std::errc() && end == word.data() + word.size();
    if (!is_whole || number < range.least || number > range.most) throw misread(name, word, range);
    return number;
  }

  /// All that is left of the line, blanks and # included: labels and file names may have them.
  std::string rest(const char* name) {
    std::string text;
    std::getline(words_ >> std::ws, text);
    if (text.empty()) throw Misread{std::string(name) + " is missing"};
    return text;
  }

  MouseButton button() {
    std::string word;
    words_ >> word;
    if (word == "left") return MouseButton::left;
    if (word == "right") return MouseButton::right;
    if (word == "middle") return MouseButton::middle;
    throw Misread{"the button is " + in_quotes(word) + "; must be left, right or middle"};
  }

  /// The last word, if there is one: "ctrl+shift", read as a chord with some key.
  Modifiers modifiers() {
    std::string word;
    if (!(words_ >> word)) return {};
    const auto chord = chord_of(word + "+Space");
    if (!chord) throw Misread{in_quotes(word) + " names no ctrl, shift or alt"};
    return chord->modifiers;
  }

  void move(double x, double y, const Modifiers& held) {
    InputEvent& moved = event(InputEvent::Kind::move);
    moved.x = x;
    moved.y = y;
    moved.modifiers = held;
  }

  void press(MouseButton with, bool is_down, const Modifiers& held) {
    InputEvent& pressed = event(is_down ? InputEvent::Kind::press : InputEvent::Kind::release);
    pressed.button = with;
    pressed.modifiers = held;
  }

  /// Press, moves along a straight line, release. Count and modifiers may stand in either order.
  void drag() {
    const MouseButton with = button();
    const double x0 = value("X", kPixels);
    const double y0 = value("Y", kPixels);
    const double x1 = value("X", kPixels);
    const double y1 = value("Y", kPixels);
    int moves = kUsualMoves;
    Modifiers held;
    std::string word;
    while (words_ >> word) {
      const auto chord = chord_of(word + "+Space");
      if (chord) {
        held = chord->modifiers;
      } else {
        std::istringstream again(word);
        std::swap(words_, again);
        moves = whole("N", kCount);
        std::swap(words_, again);
      }
    }
    move(x0, y0, held);
    add(WaitFrames{2});
    press(with, true, held);
    assert(moves > 0 && moves <= kMostMoves);
    for (int n = 1; n <= moves; ++n) {
      const double fraction = static_cast<double>(n) / moves;
      move(x0 + fraction * (x1 - x0), y0 + fraction * (y1 - y0), held);
    }
    press(with, false, {});
  }

  Vec3 vector(const char* x, const char* y, const char* z) {
    Vec3 read;
    read.x = value(x, kPuckFraction);
    read.y = value(y, kPuckFraction);
    read.z = value(z, kPuckFraction);
    return read;
  }

  void puck() {
    const Vec3 shift = vector("X", "Y", "Z");
    const Vec3 turn = vector("RX", "RY", "RZ");
    const double seconds = value("S", kPuckSeconds);
    InputEvent& pushed = event(InputEvent::Kind::puck);
    pushed.puck_shift = shift;
    pushed.puck_turn = turn;
    pushed.puck_s = seconds;
  }

  /// "finger 1 X Y" puts it down there, or moves it; "finger 1 up" lifts it.
  void finger() {
    const int number = whole("N", kFinger);
    const auto begin = words_.tellg();
    std::string word;
    words_ >> word;
    if (word == "up") {
      if (fingers_.erase(number) == 0) {
        throw Misread{"the finger " + std::to_string(number) + " is not down"};
      }
      event(InputEvent::Kind::finger_up).finger = static_cast<unsigned>(number);
      return;
    }
    words_.clear();
    words_.seekg(begin);
    const double x = value("X", kPixels);
    const double y = value("Y", kPixels);
    const bool is_new = fingers_.insert(number).second;
    InputEvent& moved =
        event(is_new ? InputEvent::Kind::finger_down : InputEvent::Kind::finger_move);
    moved.finger = static_cast<unsigned>(number);
    moved.x = x;
    moved.y = y;
  }

  KeyChord read_chord() {
    std::string word;
    words_ >> word;
    const auto chord = chord_of(word);
    if (!chord) throw Misread{in_quotes(word) + " is no key"};
    return *chord;
  }

  void key() {
    const KeyChord meant = read_chord();
    InputEvent& pressed = event(InputEvent::Kind::key_down);
    pressed.key = meant.key;
    pressed.modifiers = meant.modifiers;
    event(InputEvent::Kind::key_up).key = meant.key;  // and with it what was held
  }

  /// One event a byte: scripts type ASCII.
  void type(const std::string& text) {
    for (const char c : text) {
      event(InputEvent::Kind::text).character = static_cast<unsigned char>(c);
    }
  }

  std::istringstream words_;
  int number_;
  PenState& pen_;
  std::set<int>& fingers_;
  std::vector<ScriptStep>& steps_;
};

}  // namespace

Result<std::vector<ScriptStep>> read_input_script(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) {
    return Error{ErrorKind::disk, "cannot read the input script " + in_quotes(file.string())};
  }
  std::vector<ScriptStep> steps;
  std::string line;
  LineReader::State state;
  for (int number = 1; std::getline(in, line); ++number) {
    try {
      LineReader(line, number, state, steps).read();
    } catch (const Misread& wrong) {
      return Error{ErrorKind::bad_input,
                   file.string() + ":" + std::to_string(number) + ": " + wrong.what};
    }
  }
  return steps;
}

}  // namespace argil::viewer
