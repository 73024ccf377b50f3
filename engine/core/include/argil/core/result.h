// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace argil {

/// What kind of thing went wrong; the command line maps it to its exit status
/// (docs/command_line.md), and a kind that a function can return it names under Errors.
enum class ErrorKind {
  /// A file, number or option that cannot be used; nothing was changed. Exit status 3.
  bad_input,
  /// Hardware absent or faulty; a display without OpenGL counts as such. Exit status 4.
  device,
  /// Would not fit, or did not. Smaller input or a larger limit helps. Exit status 5.
  memory,
  /// A file could not be read, written, synced or renamed; the one before is whole. Exit status 5.
  disk,
  /// The caller asked to stop; nothing was changed. Exit status 130, or 143 after SIGTERM.
  interrupted,
  /// A promise of Argil's own did not hold, or a library's: a bug, say so. Exit status 5.
  internal,
};

/// An error that input, hardware or the machine can cause. `message` is one sentence that names
/// the thing, its value and the remedy, without a trailing full stop or newline.
struct Error {
  /// What a caller may act on; the message is for people.
  ErrorKind kind = ErrorKind::internal;
  std::string message;
};

/// A value or the reason why there is none.
///
/// Shapes       T may be a type that can only be moved (Result.MovesAValueThatCannotBeCopied); T
///              and E must be different types, as a return statement tells by type which is meant.
/// Errors       `value()` on a failure and `error()` on a success are programming errors (assert).
///              One that is dropped unread is a warning of the compiler.
/// Threads      any, as T and E allow. Accessors are noexcept and do not allocate.
template <class T, class E = Error>
class [[nodiscard]] Result {
 public:
  /// From either by `return`, without naming Result: the type decides which is meant.
  Result(T value)
      : state_(std::in_place_index<0>, std::move(value)) {}  // NOLINT: implicit by design
  Result(E error)
      : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT: implicit by design

  /// Whether there is a value; of a Result<bool> that is not yet what the value says. One that was
  /// moved from answers as before.
  bool ok() const noexcept { return state_.index() == 0; }
  explicit operator bool() const noexcept { return ok(); }

  /// The value; only where ok(). A reference to it lasts as long as this. On a temporary it is
  /// handed over to be moved from, as in `std::move(result).value()`.
  T& value() & noexcept {
    assert(ok());
    return *std::get_if<0>(&state_);
  }
  const T& value() const& noexcept {
    assert(ok());
    return *std::get_if<0>(&state_);
  }
  T&& value() && noexcept {
    assert(ok());
    return std::move(*std::get_if<0>(&state_));
  }
  /// The reason; only where not ok(). A Result of another T takes it by `return result.error();`.
  const E& error() const noexcept {
    assert(!ok());
    return *std::get_if<1>(&state_);
  }

 private:
  std::variant<T, E> state_;
};

/// Success without a value, or the reason of failure. `return {};` is success
/// (ResultOfNothing.IsSuccessByDefault). E needs a default, which a success holds unseen.
///
/// Errors       `error()` on a success is a programming error (assert).
/// Threads      any, as E allows. Accessors are noexcept and do not allocate.
template <class E>
class [[nodiscard]] Result<void, E> {
 public:
  Result() = default;
  Result(E error) : failed_(true), error_(std::move(error)) {}  // NOLINT: implicit by design

  bool ok() const noexcept { return !failed_; }
  explicit operator bool() const noexcept { return ok(); }
  /// The reason; only where not ok(). The reference lasts as long as this.
  const E& error() const noexcept {
    assert(failed_);
    return error_;
  }

 private:
  bool failed_ = false;
  E error_{};
};

}  // namespace argil
