// SPDX-License-Identifier: GPL-3.0-or-later
// The program: makes sure of its standard streams, then runs the command line.
#include <fcntl.h>
#include <unistd.h>

#include "command_line.h"

namespace {

/// Where stdin, stdout or stderr is closed, the next file that is opened would take its place, and
/// messages would go into it.
void open_standard_streams() {
  int handle = 0;
  do {
    handle = ::open("/dev/null", O_RDWR);
  } while (handle >= 0 && handle <= STDERR_FILENO);
  if (handle > STDERR_FILENO) ::close(handle);
}

}  // namespace

int main(int argc, char** argv) {
  open_standard_streams();
  return argil::cli::run_command_line(argc, argv);
}
