// SPDX-License-Identifier: GPL-3.0-or-later
// What libraries print does not reach stdout, which belongs to the result.
#include <cstdlib>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/cli_files.h"
#include "cli/run_argil.h"
#include "support/built.h"
#include "support/scratch.h"

namespace argil::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A run beside a library that warns whenever a file is written, by each of the ways to stdout.
Ended run_with_warnings(const std::vector<std::string>& arguments) {
  // NOLINTBEGIN(concurrency-mt-unsafe): this test has one thread
  ::setenv("LD_PRELOAD", faulty_disk_library(), 1);
  ::setenv("ARGIL_FAULT_WARNS", "1", 1);
  Ended run = run_argil(arguments);
  ::unsetenv("LD_PRELOAD");
  ::unsetenv("ARGIL_FAULT_WARNS");
  // NOLINTEND(concurrency-mt-unsafe)
  return run;
}

TEST(CliStdout, HasTheObjectAloneWhateverLibrariesPrint) {
  const ScratchFolder folder;
  fill(folder / "s.strokes.jsonl", kSmallScript);
  const Ended run = run_with_warnings({"sculpt", "--strokes", (folder / "s.strokes.jsonl").string(),
                                       "-o", (folder / "q.vdb").string(), "--json"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.json()["strokes"], 3);
  EXPECT_THAT(run.err, AllOf(HasSubstr("warning by a call"), HasSubstr("warning by stdio"),
                             HasSubstr("warning by a stream")));
}

TEST(CliStdout, HasTheTextAloneWhateverLibrariesPrint) {
  const ScratchFolder folder;
  fill(folder / "s.strokes.jsonl", kSmallScript);
  const Ended run = run_with_warnings({"sculpt", "--strokes", (folder / "s.strokes.jsonl").string(),
                                       "-o", (folder / "q.vdb").string()});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("strokes"), Not(HasSubstr("warning"))));
}

}  // namespace
}  // namespace argil::test
