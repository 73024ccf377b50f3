// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/session_files.h"

#include <csignal>
#include <filesystem>
#include <random>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "argil/io/session.h"

#include "support/scratch.h"
#include "support/stroke_maker.h"

namespace argil::io {
namespace {

namespace fs = std::filesystem;
using test::content_of;
using test::fill;
using test::ScratchFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// While it lives no file can be longer, as on a disk that is full.
class FullDisk {
 public:
  explicit FullDisk(std::size_t bytes) : heard_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, heard_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  void (*heard_)(int);
  rlimit before_{};
};

/// A file on another file system, to which no link of ours leads.
class Elsewhere {
 public:
  Elsewhere() {
    std::string name = "/dev/shm/argil-test-XXXXXX";
    if (::mkdtemp(name.data()) != nullptr) folder_ = name;
  }
  ~Elsewhere() {
    std::error_code ignored;
    if (!folder_.empty()) fs::remove_all(folder_, ignored);
  }
  Elsewhere(const Elsewhere&) = delete;
  Elsewhere& operator=(const Elsewhere&) = delete;
  bool is_apart_from(const fs::path& other) const {
    struct stat here {};
    struct stat there {};
    return !folder_.empty() && ::stat(folder_.c_str(), &here) == 0 &&
           ::stat(other.c_str(), &there) == 0 && here.st_dev != there.st_dev;
  }
  fs::path file() const { return folder_ / "piece.vdb"; }

 private:
  fs::path folder_;
};

TEST(SessionFiles, AreCopiedWholeOrNotAtAllWhereNoLinkCanBe) {
  const ScratchFolder folder;
  const Elsewhere elsewhere;
  if (!elsewhere.is_apart_from(folder.path())) GTEST_SKIP() << "/dev/shm is no other file system";
  const std::string content(100'000, 'x');
  fill(elsewhere.file(), content);
  {
    const FullDisk full(50'000);
    const auto kept = keep_copy(elsewhere.file(), folder / ".piece.origin.vdb");
    ASSERT_FALSE(kept.ok());
    EXPECT_EQ(kept.error().kind, ErrorKind::disk);
    EXPECT_THAT(folder.names(), IsEmpty()) << "the next save would trust it";
  }
  ASSERT_TRUE(keep_copy(elsewhere.file(), folder / ".piece.origin.vdb").ok());
  EXPECT_EQ(content_of(folder / ".piece.origin.vdb"), content);
  EXPECT_THAT(folder.names(), ElementsAre(".piece.origin.vdb"));
}

TEST(SessionFiles, KeepTheirBytesWhenTheOriginalIsWrittenTo) {
  const ScratchFolder folder;
  fill(folder / "journal", "first");
  ASSERT_TRUE(keep_bytes(folder / "journal", folder / "kept").ok());
  fill(folder / "journal", "second");
  EXPECT_EQ(content_of(folder / "kept"), "first");
  EXPECT_FALSE(keep_bytes(folder / "journal", folder / "kept").ok()) << "the name is taken";
  EXPECT_FALSE(keep_copy(folder / "journal", folder / "kept").ok());
  EXPECT_EQ(content_of(folder / "kept"), "first");
}

/// Steps behind damage are cut off only once they are kept elsewhere.
TEST(SessionFiles, ADamagedJournalIsNotCutWhereItCannotBeKept) {
  const ScratchFolder folder;
  const fs::path journal = folder / "piece.journal.jsonl";
  {
    auto session = Session::create(folder / "piece.vdb", Clay::ball(6.0, {0.5, 0.1}).value());
    ASSERT_TRUE(session) << session.error().message;
    std::mt19937 random(1);
    for (int n = 0; n < 3; ++n) {
      const Stroke stroke = random_dab(random, 6.0);
      ASSERT_TRUE(session.value().clay().apply(stroke));
      session.value().record(stroke);
    }
    ASSERT_TRUE(session.value().flush());
  }
  std::string damaged = content_of(journal);
  const std::size_t second = damaged.find('\n', damaged.find('\n') + 1) + 1;
  char& digit = damaged[damaged.find("\"spacing\":0.", second) + 12];
  digit = digit == '3' ? '4' : '3';
  fill(journal, damaged);
  {
    const FullDisk full(damaged.size() - 1);
    EXPECT_FALSE(Session::open(folder / "piece.vdb"));
  }
  EXPECT_EQ(content_of(journal), damaged);
  for (const std::string& name : folder.names()) EXPECT_THAT(name, Not(HasSubstr("damaged")));
  ASSERT_TRUE(Session::open(folder / "piece.vdb"));
  EXPECT_EQ(content_of(journal.string() + ".damaged-1"), damaged);
}

}  // namespace
}  // namespace argil::io
