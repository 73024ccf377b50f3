// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/bridge_key.h"

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sodium.h>
#include <sys/stat.h>
#include <unistd.h>

#include "descriptor.h"

namespace argil::haptics {
namespace {

namespace fs = std::filesystem;

static_assert(BridgeKey::kBytes >= crypto_generichash_blake2b_KEYBYTES_MIN);
static_assert(BridgeKey::kTagBytes >= crypto_generichash_blake2b_BYTES_MIN);

/// The hash's parameter for the purpose of a tag; examples/blender/argil_bridge.py has the same.
using Purpose = std::array<unsigned char, crypto_generichash_blake2b_PERSONALBYTES>;
constexpr Purpose kByBridge{'a', 'r', 'g', 'i', 'l', ' ', 'b', 'r', 'i', 'd', 'g', 'e'};
constexpr Purpose kBySimulator{'a', 'r', 'g', 'i', 'l', ' ', 's', 'i',
                               'm', 'u', 'l', 'a', 't', 'o', 'r'};

/// Chooses the processor's instructions, once; without it libsodium works, more slowly.
void begin_sodium() noexcept { [[maybe_unused]] static const int begun = sodium_init(); }

Error cannot(const char* what, const fs::path& file, int error) {
  return {ErrorKind::disk, std::string("cannot ") + what + " '" + file.string() +
                               "': " + std::generic_category().message(error) +
                               "; name another place with --key"};
}

/// Whether what lies there may be replaced: nothing, or a key.
bool is_key_or_nothing(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::symlink_status(file, error);
  if (status.type() == fs::file_type::not_found) return true;
  if (status.type() != fs::file_type::regular) return false;
  std::ifstream in(file, std::ios::binary);
  std::string text(2 * BridgeKey::kBytes + 2, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (!text.empty() && text.back() == '\n') text.pop_back();
  return BridgeKey::from_text(text).has_value();
}

/// A folder into which nobody else can put a key of his own.
Result<void> make_private(const fs::path& folder) {
  if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) {
    return cannot("make the folder", folder, errno);
  }
  struct stat status {};
  if (::stat(folder.c_str(), &status) != 0) return cannot("look at", folder, errno);
  const bool is_ours = status.st_uid == ::geteuid() || status.st_uid == 0;
  if (is_ours && (status.st_mode & (S_IWGRP | S_IWOTH)) == 0) return {};
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
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  std::error_code error;
  const bool has_runtime =
      runtime != nullptr && runtime[0] == '/' && fs::is_directory(runtime, error);
  const fs::path folder = has_runtime ? fs::path(runtime) / "argil"
                                      : fs::path("/tmp/argil-" + std::to_string(::geteuid()));
  return folder / ("bridge-" + std::to_string(port) + ".key");
}

Result<BridgeKeyFile> BridgeKeyFile::write(const fs::path& file, const BridgeKey& key) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (auto made = make_private(folder); !made) return made.error();
  if (!is_key_or_nothing(file)) {
    return Error{ErrorKind::bad_input, "'" + file.string() +
                                           "' is there and is no key of a bridge; name a file that "
                                           "is not, with --key"};
  }
  fs::path part = file;
  part += ".part-" + std::to_string(::getpid());
  ::unlink(part.c_str());
  const Descriptor out(
      ::open(part.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC | O_NOFOLLOW, 0600));
  if (out.get() < 0) return cannot("write", file, errno);
  const std::string text = key.text() + "\n";
  const ssize_t written = ::write(out.get(), text.data(), text.size());
  int failed_with = written < 0 ? errno : 0;
  if (written >= 0 && static_cast<std::size_t>(written) != text.size()) failed_with = ENOSPC;
  if (failed_with == 0 && ::rename(part.c_str(), file.c_str()) != 0) failed_with = errno;
  if (failed_with == 0) return BridgeKeyFile(file);
  ::unlink(part.c_str());
  return cannot("write", file, failed_with);
}

BridgeKeyFile::BridgeKeyFile(BridgeKeyFile&& other) noexcept
    : file_(std::exchange(other.file_, {})) {}

BridgeKeyFile::~BridgeKeyFile() {
  if (!file_.empty()) ::unlink(file_.c_str());
}

}  // namespace argil::haptics
