// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace argil::io {

/// A forward scan over the elements of an XML text in UTF-8 that comes piece by piece. Names lose
/// their namespace prefix; character data, comments, processing instructions and CDATA are passed
/// over; entities are not decoded, since nothing that is read here uses them.
///
/// Views stay valid until the next call of next(). Memory holds a tag, a piece of the text and the
/// names of the open elements, whatever the text is.
class XmlScan {
 public:
  enum class Event { open, close, end, error };
  struct Attribute {
    std::string_view name;
    std::string_view value;
  };

  /// Appends the next piece of the text; false when there is none.
  using TakePiece = std::function<bool(std::string& text)>;
  explicit XmlScan(TakePiece take) : take_(std::move(take)) {}

  /// A tag may be so long, and elements stand in one another so deep.
  static constexpr std::size_t kLongestTag = 1 << 20;
  static constexpr std::size_t kDeepestElement = 256;

  /// The next element that begins (an empty one begins and then closes), or closes. `error` when
  /// the text is not well formed, beyond the limits, or ends with elements open; `problem()` then
  /// says why.
  Event next();

  /// An empty element of three attributes as most programs write it: the texts of it before,
  /// between and behind the values, as in `<vertex x="`, `" y="`, `" z="`, `"`.
  using PlainForm = std::array<std::string_view, 4>;
  /// Whether an element of this very form comes next, all of it in what was taken of the text, and
  /// then its values. It stays next; pass_plain() passes it. Of others next() tells.
  bool is_plain(const PlainForm& form, std::array<std::string_view, 3>& values) noexcept;
  void pass_plain() noexcept { at_ = plain_end_; }

  std::string_view name() const noexcept { return name_; }
  /// The value of an attribute of the element that just began; empty when it has none.
  std::string_view attribute(std::string_view name) const noexcept;
  std::size_t depth() const noexcept { return open_.size(); }
  std::int64_t line() const noexcept;
  const std::string& problem() const noexcept { return problem_; }

 private:
  Event fail(const std::string& problem);
  void forget_read();
  bool skip_past(std::string_view mark);
  bool find_tag();
  bool skip_declaration();
  Event whole_tag();
  void skip_blanks() noexcept;
  std::string_view take_name() noexcept;
  Event open_tag();
  Event close_tag();
  bool take_attribute();

  TakePiece take_;
  std::string text_;  ///< from the first tag that is not forgotten on
  std::size_t at_ = 0;
  std::size_t plain_end_ = 0;      ///< of the element that is_plain() found
  std::int64_t lines_before_ = 0;  ///< `text_`
  std::string_view name_;
  std::vector<Attribute> attributes_;
  std::vector<std::string> open_;
  bool close_pending_ = false;
  bool seen_root_ = false;
  std::string problem_;
};

}  // namespace argil::io
