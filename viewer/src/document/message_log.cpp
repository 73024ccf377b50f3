// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/message_log.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

namespace argil::viewer {

void MessageLog::add(Notice notice, double now_s, std::string clock) {
  const bool is_error = notice.kind == Notice::Kind::error;
  for (Message& former : messages_) {
    const bool is_of_its_kind = is_error && former.notice.kind == Notice::Kind::error &&
                                former.notice.error == notice.error;
    if (is_of_its_kind || former.notice.text == notice.text) {
      former.is_shown = false;
    }
  }
  // Errors stay until they are dismissed.
  const double until_s = is_error ? std::numeric_limits<double>::infinity() : now_s + kShownS;
  messages_.push_back({std::move(notice), std::move(clock), until_s, true});
  if (messages_.size() > kMost) messages_.pop_front();
  assert(messages_.size() <= kMost);
}

void MessageLog::tick(double now_s) {
  for (Message& message : messages_) {
    if (message.until_s < now_s) message.is_shown = false;
  }
}

double MessageLog::next_s() const noexcept {
  double next = std::numeric_limits<double>::infinity();
  for (const Message& message : messages_) {
    if (message.is_shown) next = std::min(next, message.until_s);
  }
  return next;
}

}  // namespace argil::viewer
