// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/bridge/bridge_key.h"

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstdlib>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sodium.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "bridge/descriptor.h"

namespace argil::haptics {
namespace {

namespace fs = std::filesystem;

static_assert(BridgeKey::kBytes >= crypto_generichash_blake2b_KEYBYTES_MIN);
static_assert(BridgeKey::kTagBytes >= crypto_generichash_blake2b_BYTES_MIN);

/// The hash's personalisation, by side; examples/blender/argil_bridge.py has the same.
using Purpose = std::array<unsigned char, crypto_generichash_blake2b_PERSONALBYTES>;
constexpr Purpose kByBridge{'a', 'r', 'g', 'i', 'l', ' ', 'b', 'r', 'i', 'd', 'g', 'e'};
constexpr Purpose kBySimulator{'a', 'r', 'g', 'i', 'l', ' ', 's', 'i',
                               'm', 'u', 'l', 'a', 't', 'o', 'r'};

/// Chooses the processor's instructions, once; without this libsodium works, more slowly.
void begin_sodium() noexcept { [[maybe_unused]] static const int begun = sodium_init(); }

Error cannot(const char* what, const fs::path& file, int error) {
  return {ErrorKind::disk, std::string("cannot ") + what + " '" + file.string() +
                               "': " + std::generic_category().message(error) +
                               "; name another file with --key"};
}

Error held_by_another(const fs::path& file) {
  return {ErrorKind::bad_input, "a bridge that is running has its key in '" + file.string() +
                                    "'; end that one, or name another file with --key"};
}

Error no_key(const fs::path& file) {
  return {ErrorKind::bad_input,
          file.string().insert(0, 1, '\'') +
              "' is there and is no key of a bridge; name a file that is not, with --key"};
}

bool holds_key(int file) {
  struct stat status {};
  if (::fstat(file, &status) != 0 || !S_ISREG(status.st_mode)) return false;
  std::array<char, 2 * BridgeKey::kBytes + 2> text{};
  const ssize_t got = ::read(file, text.data(), text.size());
  std::string_view said(text.data(), got < 0 ? 0 : static_cast<std::size_t>(got));
  if (said.ends_with('\n')) said.remove_suffix(1);
  return BridgeKey::from_text(said).has_value();
}

/// Whether the file at that path is still the one that was opened.
bool lies_at(const fs::path& file, int opened) noexcept {
  struct stat there {};
  struct stat ours {};
  return ::lstat(file.c_str(), &there) == 0 && ::fstat(opened, &ours) == 0 &&
         there.st_dev == ours.st_dev && there.st_ino == ours.st_ino;
}

/// Whether another process holds it; never where the file system has no locks.
bool is_locked(int file) noexcept {
  return ::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

/// The key of a bridge that has ended, locked so that only one process replaces it; no descriptor
/// where there is no file.
Result<Descriptor> take_stale_key(const fs::path& file) {
  Descriptor stale(::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (stale.get() < 0 && errno == ENOENT) return stale;
  if (stale.get() < 0 || !holds_key(stale.get())) return no_key(file);
  // Where it was replaced meanwhile, a living bridge has done so.
  if (is_locked(stale.get()) || !lies_at(file, stale.get())) return held_by_another(file);
  return stale;
}

/// 0 or the error.
int write_key(int file, const BridgeKey& key) {
  const std::string text = key.text() + "\n";
  const ssize_t written = ::write(file, text.data(), text.size());
  if (written < 0) return errno;
  return static_cast<std::size_t>(written) == text.size() ? 0 : ENOSPC;
}

/// Makes a folder into which nobody else can put a key, and which nobody else can replace.
Result<void> make_private(const fs::path& folder) {
  if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) {
    return cannot("make the folder", folder, errno);
  }
  struct stat itself {};  // which may be a link
  struct stat status {};
  if (::lstat(folder.c_str(), &itself) != 0 || ::stat(folder.c_str(), &status) != 0) {
    return cannot("look at", folder, errno);
  }
  const auto is_ours = [](const struct stat& of) {
    return of.st_uid == ::geteuid() || of.st_uid == 0;
  };
  if (is_ours(itself) && is_ours(status) && (status.st_mode & (S_IWGRP | S_IWOTH)) == 0) return {};
  return Error{ErrorKind::bad_input,
               "others may write to '" + folder.string() +
                   "', where the bridge's key would lie; name a file in a folder of your own with "
                   "--key"};
}

}  // namespace

BridgeKey::BridgeKey(const std::array<unsigned char, kBytes>& bytes) noexcept : bytes_(bytes) {
  begin_sodium();
}

BridgeKey::Nonce BridgeKey::nonce() noexcept {
  begin_sodium();
  Nonce nonce;
  randombytes_buf(nonce.data(), nonce.size());
  return nonce;
}

BridgeKey BridgeKey::random() noexcept {
  begin_sodium();
  std::array<unsigned char, kBytes> bytes;
  randombytes_buf(bytes.data(), bytes.size());
  return BridgeKey(bytes);
}

std::optional<BridgeKey> BridgeKey::from_text(std::string_view text) noexcept {
  std::array<unsigned char, kBytes> bytes;
  std::size_t got = 0;
  const char* end = nullptr;
  if (text.size() != 2 * kBytes || sodium_hex2bin(bytes.data(), bytes.size(), text.data(),
                                                  text.size(), nullptr, &got, &end) != 0) {
    return std::nullopt;
  }
  if (got != kBytes || end != text.data() + text.size()) return std::nullopt;
  return BridgeKey(bytes);
}

std::string BridgeKey::text() const {
  std::string text(2 * kBytes + 1, '\0');
  sodium_bin2hex(text.data(), text.size(), bytes_.data(), bytes_.size());
  text.pop_back();  // the zero at its end
  return text;
}

BridgeKey::Tag BridgeKey::tag(BridgeSender sender,
                              std::span<const std::byte> message) const noexcept {
  const Purpose& purpose = sender == BridgeSender::bridge ? kByBridge : kBySimulator;
  Tag tag;
  [[maybe_unused]] const int failed = crypto_generichash_blake2b_salt_personal(
      reinterpret_cast<unsigned char*>(tag.data()), tag.size(),
      reinterpret_cast<const unsigned char*>(message.data()), message.size(), bytes_.data(),
      bytes_.size(), nullptr, purpose.data());
  assert(failed == 0);
  return tag;
}

bool BridgeKey::fits(BridgeSender sender, std::span<const std::byte> message,
                     std::span<const std::byte> tag) const noexcept {
  if (tag.size() != kTagBytes) return false;
  Tag given;
  std::ranges::copy(tag, given.begin());
  return is_same(given, this->tag(sender, message));
}

bool is_same(const BridgeKey::Tag& a, const BridgeKey::Tag& b) noexcept {
  return sodium_memcmp(a.data(), b.data(), a.size()) == 0;
}

fs::path usual_key_file(std::uint16_t port) {
  // NOLINTNEXTLINE(concurrency-mt-unsafe): read only
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  std::error_code error;
  const bool has_runtime =
      runtime != nullptr && runtime[0] == '/' && fs::is_directory(runtime, error);
  const fs::path folder = has_runtime ? fs::path(runtime) / "argil"
                                      : fs::path("/tmp/argil-" + std::to_string(::geteuid()));
  return folder / ("bridge-" + std::to_string(port) + ".key");
}

/// A key file of ours, which is locked as long as it is open.
struct BridgeKeyFile::Held {
  Held(fs::path at, Descriptor opened) noexcept
      : file(std::move(at)), descriptor(std::move(opened)) {
    assert(descriptor.get() >= 0);
  }
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;
  ~Held() {
    if (lies_at(file, descriptor.get())) ::unlink(file.c_str());
  }
  fs::path file;
  Descriptor descriptor;
};

Result<BridgeKeyFile> BridgeKeyFile::write(const fs::path& file, const BridgeKey& key) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (auto made = make_private(folder); !made) return made.error();
  const auto stale = take_stale_key(file);
  if (!stale) return stale.error();
  fs::path part = file;
  part += ".part-" + std::to_string(::getpid());
  ::unlink(part.c_str());
  Descriptor out(::open(part.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC | O_NOFOLLOW, 0600));
  if (out.get() < 0) return cannot("write", file, errno);
  int failed_with = is_locked(out.get()) ? EWOULDBLOCK : write_key(out.get(), key);
  if (failed_with == 0) {
    // A stale key is locked by us. Otherwise a link does not take a name that is taken meanwhile.
    const bool replaces = stale.value().get() >= 0;
    const int put =
        replaces ? ::rename(part.c_str(), file.c_str()) : ::link(part.c_str(), file.c_str());
    if (put != 0) failed_with = errno;
  }
  ::unlink(part.c_str());
  if (failed_with == EEXIST) return held_by_another(file);
  if (failed_with != 0) return cannot("write", file, failed_with);
  return BridgeKeyFile(std::make_unique<Held>(file, std::move(out)));
}

BridgeKeyFile::BridgeKeyFile(std::unique_ptr<Held> held) noexcept : held_(std::move(held)) {}
BridgeKeyFile::BridgeKeyFile(BridgeKeyFile&&) noexcept = default;
BridgeKeyFile::~BridgeKeyFile() = default;

const fs::path& BridgeKeyFile::path() const noexcept { return held_->file; }

}  // namespace argil::haptics
