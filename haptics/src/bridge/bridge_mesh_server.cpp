// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/bridge/bridge_mesh_server.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cerrno>
#include <chrono>
#include <list>
#include <new>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include "bridge/descriptor.h"
#include "bridge/listen.h"
#include "bridge/mesh_mirror.h"

namespace argil::haptics {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kLookMs = 100;
constexpr std::chrono::milliseconds kFinishLook{2};
/// Size of a socket's buffer: what lies there is sent even when it is out of date, so it is small.
constexpr int kSocketBytes = 1 << 18;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A listening socket, and its port.
Result<std::pair<Descriptor, std::uint16_t>> listen_at(const BridgeAddress& at) {
  Descriptor listener(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (listener.get() < 0) return cannot_listen(at);
  // A connection that ended a minute ago does not keep the port busy.
  const int yes = 1;
  ::setsockopt(listener.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  const std::uint16_t bound = bind_to(listener.get(), at);
  if (bound == 0 || ::listen(listener.get(), BridgeMeshServer::kMostReaders) != 0) {
    return cannot_listen(at);
  }
  return std::pair(std::move(listener), bound);
}

std::size_t total_bytes(const std::deque<MeshBytes>& messages) {
  std::size_t bytes = 0;
  for (const MeshBytes& message : messages) bytes += message->size();
  return bytes;
}

}  // namespace

struct BridgeMeshServer::State {
  /// One connection.
  struct Connection {
    explicit Connection(Descriptor accepted) noexcept : socket(std::move(accepted)) {}
    Descriptor socket;
    BridgeKey::Nonce nonce = BridgeKey::nonce();
    Clock::time_point since = Clock::now();
    std::vector<std::byte> said;             ///< of its MeshAsk and the tag
    MeshMirror::Waiting* waiting = nullptr;  ///< once it has asked
    std::deque<MeshBytes> messages;          ///< being sent
    std::size_t sent = 0;                    ///< of the first of them
    bool has_end = false;                    ///< MeshEnd is the last of them
    bool is_over = false;                    ///< to be dropped
  };

  State(Descriptor at, std::uint16_t port_number, const BridgeKey& shared_key,
        const MeshPlace& where)
      : listener(std::move(at)), port(port_number), key(shared_key), place(where) {}

  Descriptor listener;
  std::uint16_t port;
  BridgeKey key;
  MeshPlace place;
  Descriptor wake{::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)};
  MeshMirror mirror;
  std::list<Connection> readers;  ///< the thread's
  std::atomic<bool> is_ending = false;
  std::atomic<bool> is_finishing = false;
  std::atomic<bool> has_finished = false;  ///< the thread has nothing more to do
  std::atomic<double> most_silence_s = 0.0;
  Clock::time_point progress;  ///< the thread's: when it last sent something, or had not to finish
  std::atomic<std::uint64_t> asked = 0;
  std::atomic<std::uint64_t> malformed = 0;
  std::atomic<std::uint64_t> forged = 0;
  std::atomic<std::uint64_t> refused = 0;
  std::atomic<std::uint64_t> blocks = 0;
  std::atomic<std::uint64_t> bytes = 0;
  std::atomic<std::size_t> queued_bytes = 0;
  std::thread thread;

  void run() noexcept;
  bool round();
  bool look();
  void make_place();
  void accept_all();
  void hear(Connection& reader);
  void answer(Connection& reader);
  void queue(Connection& reader, std::vector<std::byte> words);
  void refill(Connection& reader);
  void send(Connection& reader);
  void drop_over();
  void rouse() const noexcept;
};

/// Wakes the thread.
void BridgeMeshServer::State::rouse() const noexcept {
  const std::uint64_t one = 1;
  // It can only fail when the thread is to wake already.
  [[maybe_unused]] const ssize_t written = ::write(wake.get(), &one, sizeof one);
}

/// The thread: rounds until the end.
void BridgeMeshServer::State::run() noexcept {
  bool goes_on = true;
  while (goes_on && !is_ending) {
    try {
      goes_on = round();
    } catch (const std::bad_alloc&) {  // drops all readers, whose memory that was; they may return
      for (Connection& reader : readers) reader.is_over = true;
      drop_over();
    }
  }
  for (Connection& reader : readers) reader.is_over = true;
  drop_over();
  has_finished = true;
}

/// Does what can be done now, and waits for more. False when it was the last round.
bool BridgeMeshServer::State::round() {
  const bool is_last = is_finishing;
  if (is_last) {
    listener.close();  // new connections wait for the next bridge
  } else {
    accept_all();
    progress = Clock::now();
  }
  for (Connection& reader : readers) {
    hear(reader);
    if (!reader.is_over) send(reader);
    if (is_last && reader.waiting == nullptr) reader.is_over = true;
  }
  drop_over();
  if (is_last && (readers.empty() || seconds_since(progress) > most_silence_s)) return false;
  return look();
}

/// Waits until there is something to do.
bool BridgeMeshServer::State::look() {
  std::vector<pollfd> polled{{wake.get(), POLLIN, 0}, {listener.get(), POLLIN, 0}};
  for (const Connection& reader : readers) {
    const int wanted = reader.messages.empty() ? POLLIN : POLLIN | POLLOUT;
    polled.push_back({reader.socket.get(), static_cast<short>(wanted), 0});
  }
  if (::poll(polled.data(), polled.size(), kLookMs) < 0 && errno != EINTR) return false;
  std::uint64_t woken = 0;
  [[maybe_unused]] const ssize_t read = ::read(wake.get(), &woken, sizeof woken);
  return true;
}

/// Drops the oldest of the connections that have not asked, so that they keep nobody out who will.
void BridgeMeshServer::State::make_place() {
  const auto is_silent = [](const Connection& reader) { return reader.waiting == nullptr; };
  if (std::ranges::count_if(readers, is_silent) < kMostSilent) return;
  std::ranges::find_if(readers, is_silent)->is_over = true;
  ++malformed;
  drop_over();
}

void BridgeMeshServer::State::accept_all() {
  for (;;) {
    Descriptor socket(::accept4(listener.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (socket.get() < 0) return;
    make_place();
    ::setsockopt(socket.get(), SOL_SOCKET, SO_SNDBUF, &kSocketBytes, sizeof kSocketBytes);
    Connection& reader = readers.emplace_back(std::move(socket));
    queue(reader, {reader.nonce.begin(), reader.nonce.end()});
  }
}

/// Reads what a connection says: a reader asks, once, and says nothing more.
void BridgeMeshServer::State::hear(Connection& reader) {
  std::array<std::byte, kAskBytes + 1> buffer;
  for (;;) {
    const ssize_t got = ::recv(reader.socket.get(), buffer.data(), buffer.size(), 0);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) break;
    if (got <= 0) {
      reader.is_over = true;
      return;
    }
    reader.said.insert(reader.said.end(), buffer.begin(), buffer.begin() + got);
    if (reader.said.size() > kAskBytes) break;
  }
  if (reader.said.size() >= kAskBytes && reader.waiting == nullptr) answer(reader);
  if (reader.is_over) return;
  const bool is_late = reader.waiting == nullptr && seconds_since(reader.since) > kAskWithinS;
  reader.is_over = is_late || reader.said.size() > kAskBytes;
  if (reader.is_over) ++malformed;
}

/// Checks key and message of a connection that asked, and makes it a reader; else it is dropped.
void BridgeMeshServer::State::answer(Connection& reader) {
  assert(reader.said.size() >= kAskBytes && reader.waiting == nullptr);
  const std::span<const std::byte> said(reader.said);
  const auto words = said.first(kMeshAskBytes);
  reader.is_over = true;
  std::array<std::byte, sizeof(BridgeKey::Nonce) + kMeshAskBytes> proven;
  std::ranges::copy(words, std::ranges::copy(reader.nonce, proven.begin()).out);
  if (!key.fits(BridgeSender::simulator, proven,
                said.subspan(kMeshAskBytes, BridgeKey::kTagBytes))) {
    ++forged;
    return;
  }
  const auto message = decode_mesh(words);
  if (!message || !std::holds_alternative<MeshAsk>(*message)) {
    ++malformed;
    return;
  }
  if (std::ranges::count_if(readers, [](const auto& one) { return one.waiting != nullptr; }) >=
      kMostReaders) {
    ++refused;
    return;
  }
  reader.is_over = false;
  ++asked;
  const BridgeKey::Tag proof = key.tag(BridgeSender::bridge, proven);
  queue(reader, {proof.begin(), proof.end()});
  queue(reader, encode(place));
  reader.waiting = &mirror.join();
}

void BridgeMeshServer::State::queue(Connection& reader, std::vector<std::byte> words) {
  reader.messages.push_back(std::make_shared<const std::vector<std::byte>>(std::move(words)));
  queued_bytes += reader.messages.back()->size();
}

/// Queues the next state, or the end, for a reader that has asked.
void BridgeMeshServer::State::refill(Connection& reader) {
  if (reader.waiting == nullptr) return;
  if (reader.has_end) {
    reader.is_over = true;
    return;
  }
  // Asked before the state is taken: what is published before it finishes is in that state.
  const bool is_last = is_finishing;
  MeshMirror::News news = mirror.take(*reader.waiting);
  reader.messages = std::move(news.messages);
  queued_bytes += total_bytes(reader.messages);
  blocks += news.blocks;
  if (!reader.messages.empty() || !is_last) return;
  queue(reader, encode(MeshEnd{mirror.updates()}));
  reader.has_end = true;
}

/// Sends as much as the reader's socket takes.
void BridgeMeshServer::State::send(Connection& reader) {
  while (!is_ending) {
    if (reader.messages.empty()) refill(reader);
    if (reader.messages.empty()) return;
    const std::vector<std::byte>& message = *reader.messages.front();
    const ssize_t sent = ::send(reader.socket.get(), message.data() + reader.sent,
                                message.size() - reader.sent, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) {
      reader.is_over = errno != EAGAIN && errno != EWOULDBLOCK;
      return;
    }
    bytes += static_cast<std::uint64_t>(sent);
    progress = Clock::now();
    reader.sent += static_cast<std::size_t>(sent);
    assert(reader.sent <= message.size());
    if (reader.sent < message.size()) continue;
    assert(queued_bytes >= message.size());
    queued_bytes -= message.size();
    reader.messages.pop_front();
    reader.sent = 0;
  }
}

/// Removes the connections that are over, and what was queued for them.
void BridgeMeshServer::State::drop_over() {
  for (Connection& reader : readers) {
    if (!reader.is_over) continue;
    if (reader.waiting != nullptr) mirror.leave(*reader.waiting);
    queued_bytes -= total_bytes(reader.messages);
  }
  readers.remove_if([](const Connection& reader) { return reader.is_over; });
}

Result<std::unique_ptr<BridgeMeshServer>> BridgeMeshServer::open(const BridgeAddress& at,
                                                                 const BridgeKey& key,
                                                                 const MeshPlace& place) {
  auto listening = listen_at(at);
  if (!listening) return listening.error();
  auto& [listener, bound] = listening.value();
  auto state = std::make_unique<State>(std::move(listener), bound, key, place);
  try {
    state->thread = std::thread([served = state.get()] { served->run(); });
  } catch (const std::system_error&) {
    return Error{ErrorKind::internal,
                 "the system gives no thread to send the clay; end other programs and try again"};
  }
  return std::unique_ptr<BridgeMeshServer>(new BridgeMeshServer(std::move(state)));
}

BridgeMeshServer::BridgeMeshServer(std::unique_ptr<State> state) noexcept
    : state_(std::move(state)) {}

BridgeMeshServer::~BridgeMeshServer() { end(); }

void BridgeMeshServer::end() noexcept {
  state_->is_ending = true;
  state_->rouse();
  if (state_->thread.joinable()) state_->thread.join();
}

std::uint16_t BridgeMeshServer::port() const noexcept { return state_->port; }

void BridgeMeshServer::publish(std::vector<MeshBlock> changed, std::span<const MeshBlockId> gone) {
  state_->mirror.publish(std::move(changed), gone);
  state_->rouse();
}

void BridgeMeshServer::publish(MeshNote note) {
  note.text.resize(std::min(note.text.size(), kMostMeshText));
  state_->mirror.publish(std::move(note));
  state_->rouse();
}

void BridgeMeshServer::finish(double most_silence_s, const std::function<bool()>& goes_on) {
  assert(most_silence_s >= 0.0);
  state_->most_silence_s = most_silence_s;
  state_->is_finishing = true;
  state_->rouse();
  while (!state_->has_finished && (!goes_on || goes_on())) std::this_thread::sleep_for(kFinishLook);
  end();
}

MeshCounts BridgeMeshServer::counts() const noexcept {
  const State& state = *state_;
  return {state.mirror.updates(), state.asked,  state.malformed, state.forged,
          state.refused,          state.blocks, state.bytes};
}

std::size_t BridgeMeshServer::held_bytes() const noexcept {
  return state_->mirror.bytes() + state_->queued_bytes;
}

}  // namespace argil::haptics
