// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/falcon_emulator/usb_bus.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <utility>

namespace argil::test {
namespace {

constexpr unsigned char kIn = 0x81;
constexpr std::size_t kSetupBytes = 8;
/// A bulk transfer waits for a microframe of the hub.
constexpr double kTransferS = 1.25e-4;

template <class Queue>
bool take_out(Queue& queue, usbdevfs_urb* urb) {
  const auto found = std::find(queue.begin(), queue.end(), urb);
  if (found == queue.end()) return false;
  queue.erase(found);
  return true;
}

/// String descriptors: the language, then maker, product and serial number.
std::string string_descriptor(unsigned index) {
  constexpr std::array<const char*, 4> kTexts{"", "Argil", "FALCON HAPTIC", "EMULATED1"};
  std::string text;
  if (index == 0) text = "\x09\x04";
  for (const char* c = kTexts[index]; *c != '\0'; ++c) text.append(1, *c).append(1, '\0');
  return std::string{static_cast<char>(2 + text.size()), '\x03'} + text;
}

}  // namespace

void UsbBus::plug(const std::string& node_path) {
  const std::lock_guard lock(mutex_);
  node_.emplace(node_path);
  is_plugged_ = true;
  is_claimed_ = false;
}

void UsbBus::unplug() {
  const std::lock_guard lock(mutex_);
  is_plugged_ = false;
  events_.clear();
  for (auto* queue : {&in_, &stuck_}) {
    for (usbdevfs_urb* urb : std::exchange(*queue, {})) complete(urb, -ESHUTDOWN, 0);
  }
}

void UsbBus::ring() {
  if (node_) node_->ring(!done_.empty() || !is_plugged_);
}

void UsbBus::complete(usbdevfs_urb* urb, int status, std::size_t bytes) {
  urb->status = status;
  urb->actual_length = static_cast<int>(bytes);
  done_.push_back(urb);
  ring();
}

int UsbBus::submit(usbdevfs_urb* urb, File file) {
  const std::lock_guard lock(mutex_);
  if (!is_plugged_) return -ENODEV;
  advance_locked();
  files_[urb] = file;
  if (urb->type == USBDEVFS_URB_TYPE_CONTROL) {
    const int done = control(urb);
    complete(urb, std::min(done, 0), static_cast<std::size_t>(std::max(done, 0)));
  } else if (urb->endpoint == kIn) {
    in_.push_back(urb);
    serve_in(clock_());
  } else {
    begin_out(urb, clock_());
  }
  changed_.notify_all();
  return 0;
}

/// To the chip, over the line to the processor, and what that answers back over the line.
void UsbBus::begin_out(usbdevfs_urb* urb, double now_s) {
  stuck_.push_back(urb);
  if (faults_.out_error != 0) {
    take_out(stuck_, urb);
    complete(urb, faults_.out_error, 0);
    return;
  }
  const std::string bytes(static_cast<const char*>(urb->buffer),
                          static_cast<std::size_t>(urb->buffer_length));
  const double there_s = now_s + kTransferS;
  events_.emplace(there_s + faults_.out_late_s, [this, urb] {
    if (take_out(stuck_, urb)) complete(urb, 0, static_cast<std::size_t>(urb->buffer_length));
  });
  const double heard_s = there_s + chip_.seconds_for(bytes.size());
  events_.emplace(heard_s, [this, bytes, heard_s] {
    std::string answer;
    for (const char byte : bytes) {
      answer += chip_.dsp.receive(static_cast<std::uint8_t>(byte), heard_s, faults_);
    }
    if (answer.empty()) return;
    const bool is_late = faults_.late_replies > 0;
    if (is_late) --faults_.late_replies;
    const double back_s =
        heard_s + chip_.seconds_for(answer.size()) + (is_late ? faults_.late_s : 0.0);
    events_.emplace(back_s, [this, answer, back_s] { chip_.put(answer, back_s); });
  });
}

/// Fills the waiting IN transfers with the packets that are due.
void UsbBus::serve_in(double now_s) {
  while (!in_.empty()) {
    const bool fails = faults_.in_error != 0 || faults_.babbles > 0;
    if (!fails && chip_.packet_due_s() > now_s) return;
    usbdevfs_urb* urb = in_.front();
    in_.pop_front();
    if (faults_.in_error != 0) {
      complete(urb, faults_.in_error, 0);
      continue;
    }
    const std::string packet = chip_.take_packet(now_s, faults_);
    const bool babbles = faults_.babbles > 0 || packet.size() > std::size_t(urb->buffer_length);
    if (babbles) {  // what was sent is gone
      faults_.babbles = std::max(0, faults_.babbles - 1);
      complete(urb, -EOVERFLOW, 0);
      continue;
    }
    std::memcpy(urb->buffer, packet.data(), packet.size());
    complete(urb, 0, packet.size());
  }
}

int UsbBus::control(usbdevfs_urb* urb) {
  auto* setup = static_cast<unsigned char*>(urb->buffer);
  std::string answer;
  const int done = answer_control(setup, answer);
  if (done < 0) return done;
  const std::size_t room = std::min<std::size_t>(
      setup[6] + 256U * setup[7], static_cast<std::size_t>(urb->buffer_length) - kSetupBytes);
  const std::size_t bytes = std::min(room, answer.size());
  std::copy_n(answer.begin(), bytes, setup + kSetupBytes);
  return static_cast<int>(bytes);
}

int UsbBus::answer_control(const unsigned char* setup, std::string& answer) {
  constexpr unsigned char kStandardIn = 0x80;
  constexpr unsigned char kGetDescriptor = 6;
  constexpr unsigned char kString = 3;
  const auto value = static_cast<std::uint16_t>(setup[2] + 256U * setup[3]);
  if (setup[0] == kStandardIn && setup[1] == kGetDescriptor && setup[3] == kString) {
    if (setup[2] > 3) return -EPIPE;
    answer = string_descriptor(setup[2]);
    return 0;
  }
  if (faults_.control_error != 0) return faults_.control_error;
  return chip_.control(setup[0], setup[1], value, answer);
}

usbdevfs_urb* UsbBus::reap(File file) {
  const std::lock_guard lock(mutex_);
  if (is_plugged_) advance_locked();
  const auto found = std::find_if(done_.begin(), done_.end(),
                                  [&](usbdevfs_urb* urb) { return files_.at(urb) == file; });
  if (found == done_.end()) return nullptr;
  usbdevfs_urb* urb = *found;
  done_.erase(found);
  files_.erase(urb);
  ring();
  return urb;
}

int UsbBus::discard(usbdevfs_urb* urb) {
  const std::lock_guard lock(mutex_);
  if (!take_out(in_, urb) && !take_out(stuck_, urb)) return -EINVAL;
  complete(urb, -ENOENT, 0);
  return 0;
}

void UsbBus::forget(File file) {
  const std::lock_guard lock(mutex_);
  for (auto* queue : {&in_, &stuck_, &done_}) {
    std::erase_if(*queue, [&](usbdevfs_urb* urb) { return files_.at(urb) == file; });
  }
  std::erase_if(files_, [&](const auto& entry) { return entry.second == file; });
  ring();
}

int UsbBus::claim(bool takes_from_driver) {
  const std::lock_guard lock(mutex_);
  if (!is_plugged_) return -ENODEV;
  if (faults_.is_taken || is_claimed_) return -EBUSY;
  if (faults_.has_driver && !takes_from_driver) return -EBUSY;
  had_driver_ = std::exchange(faults_.has_driver, false);
  is_claimed_ = true;
  return 0;
}

int UsbBus::release() {
  const std::lock_guard lock(mutex_);
  if (!is_plugged_) return -ENODEV;
  is_claimed_ = false;
  return 0;
}

int UsbBus::attach_driver() {
  const std::lock_guard lock(mutex_);
  faults_.has_driver = had_driver_;
  return had_driver_ ? 1 : 0;
}

int UsbBus::clear_halt(unsigned endpoint) {
  const std::lock_guard lock(mutex_);
  (endpoint == kIn ? faults_.in_error : faults_.out_error) = 0;
  return 0;
}

std::vector<VendorRequest> UsbBus::requests() {
  const std::lock_guard lock(mutex_);
  return chip_.requests();
}

bool UsbBus::has_driver() {
  const std::lock_guard lock(mutex_);
  return faults_.has_driver;
}

bool UsbBus::is_plugged() {
  const std::lock_guard lock(mutex_);
  return is_plugged_;
}

bool UsbBus::is_node_of(int fd) {
  const std::lock_guard lock(mutex_);
  return node_ && node_->is_node_of(fd);
}

std::size_t UsbBus::under_way() {
  const std::lock_guard lock(mutex_);
  return files_.size();
}

double UsbBus::next_event_locked() const {
  double next_s = events_.empty() ? kNever : events_.begin()->first;
  if (!in_.empty()) next_s = std::min(next_s, chip_.packet_due_s());
  return next_s;
}

void UsbBus::advance_locked() {
  const double now_s = clock_();
  while (true) {
    const double next_s = next_event_locked();
    if (next_s > now_s) return;
    if (!events_.empty() && events_.begin()->first <= next_s) {
      const auto event = events_.extract(events_.begin());
      event.mapped()();
    } else {
      serve_in(std::max(next_s, 0.0));
    }
  }
}

void UsbBus::advance() {
  const std::lock_guard lock(mutex_);
  advance_locked();
}

double UsbBus::next_event_s() {
  const std::lock_guard lock(mutex_);
  return next_event_locked();
}

void UsbBus::run_in_real_time() {
  std::unique_lock lock(mutex_);
  while (!is_stopped_) {
    advance_locked();
    constexpr double kIdleS = 0.05;
    const double wait_s = std::clamp(next_event_locked() - clock_(), 0.0, kIdleS);
    changed_.wait_for(lock, std::chrono::duration<double>(wait_s));
  }
}

void UsbBus::stop() {
  const std::lock_guard lock(mutex_);
  is_stopped_ = true;
  changed_.notify_all();
}

}  // namespace argil::test
