// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace argil::io {

/// A forward scan over the elements of an XML text in UTF-8. Names lose their namespace prefix;
/// character data, comments, processing instructions and CDATA are passed over; entities are not
/// decoded, since nothing that is read here uses them.
///
/// Views stay valid as long as the text. Nothing is allocated but the stack of open elements.
class XmlScan {
 public:
  enum class Event { open, close, end, error };
  struct Attribute {
    std::string_view name;
    std::string_view value;
  };

  explicit XmlScan(std::string_view text) : text_(text) {}

  /// The next element that begins (an empty one begins and then closes), or closes. `error` when
  /// the text is not well formed or ends with elements open; `problem()` then says why.
  Event next();

  std::string_view name() const noexcept { return name_; }
  /// The value of an attribute of the element that just began; empty when it has none.
  std::string_view attribute(std::string_view name) const noexcept;
  std::size_t depth() const noexcept { return open_.size(); }
  std::int64_t line() const noexcept;
  const std::string& problem() const noexcept { return problem_; }

 private:
  Event fail(const char* problem);
  bool skip_past(std::string_view mark);
  void skip_blanks() noexcept;
  std::string_view take_name() noexcept;
  Event open_tag();
  Event close_tag();
  bool take_attribute();

  std::string_view text_;
  std::size_t at_ = 0;
  std::string_view name_;
  std::vector<Attribute> attributes_;
  std::vector<std::string_view> open_;
  bool close_pending_ = false;
  bool seen_root_ = false;
  std::string problem_;
};

}  // namespace argil::io
