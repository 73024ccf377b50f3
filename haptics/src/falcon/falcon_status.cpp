// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/falcon/falcon_status.h"

namespace argil::haptics {

const char* falcon_state_name(FalconState state) noexcept {
  switch (state) {
    case FalconState::closed:
      return "closed";
    case FalconState::probing:
      return "probing";
    case FalconState::uploading:
      return "uploading";
    case FalconState::unhomed:
      return "unhomed";
    case FalconState::active:
      return "active";
    case FalconState::fault:
      break;
  }
  return "fault";
}

const char* falcon_fault_text(FalconFault fault) noexcept {
  switch (fault) {
    case FalconFault::none:
      break;
    case FalconFault::no_usb:
      return "this machine shows no USB devices; plug the Falcon into a real machine, or pass its "
             "USB through to this one";
    case FalconFault::not_found:
      return "no Falcon (USB 0403:cb48) is attached; check its cable, plug it straight into the "
             "machine, and see 'argil falcon list'";
    case FalconFault::no_permission:
      return "this user may not open the Falcon; install the udev rule ('sudo cmake --install' "
             "does, or "
             "copy 70-argil-falcon.rules to /etc/udev/rules.d), run 'sudo udevadm control "
             "--reload' "
             "and plug it in again";
    case FalconFault::busy:
      return "another program uses the Falcon; end it, and see 'fuser /dev/bus/usb/*/*'";
    case FalconFault::unplugged:
      return "the Falcon was unplugged; plug it in and run 'argil falcon home'";
    case FalconFault::stalled:
      return "the Falcon refused a USB transfer; run 'argil falcon home', and if it comes again, "
             "unplug and plug in both its cables";
    case FalconFault::babbled:
      return "the Falcon sent more than USB allows; plug it straight into the machine without a "
             "hub and run 'argil falcon home'";
    case FalconFault::usb_failed:
      return "a USB transfer failed; plug the Falcon straight into the machine with another cable "
             "and run 'argil falcon home'";
    case FalconFault::no_firmware:
      return "the Falcon's firmware does not run, and there is none to send; name the file with "
             "--firmware or ARGIL_FALCON_FIRMWARE (docs/falcon.md says where it comes from)";
    case FalconFault::no_greeting:
      return "the Falcon's boot loader does not answer; check its power adapter, unplug and plug "
             "in both its cables and run 'argil falcon home'";
    case FalconFault::bad_echo:
      return "the firmware did not reach the Falcon whole in ten attempts; plug it straight into "
             "the machine, or into a powered hub, and run 'argil falcon home'";
    case FalconFault::not_started:
      return "the Falcon took the firmware and does not answer; try another firmware file, and "
             "check its power adapter";
    case FalconFault::silent:
      return "the Falcon no longer answers; check its cable and its power adapter and run 'argil "
             "falcon home'";
    case FalconFault::force_not_finite:
      return "a force that is not a number was asked of the Falcon; run 'argil falcon home', and "
             "please report this as a bug";
    case FalconFault::other_serial:
      return "no Falcon with that serial number is attached; check it against 'argil falcon list'";
    case FalconFault::internal:
      return "the Falcon's driver failed, perhaps for want of memory; run 'argil falcon home', and "
             "please report this as a bug";
  }
  return "";
}

Error falcon_error(FalconFault fault) { return {ErrorKind::device, falcon_fault_text(fault)}; }

}  // namespace argil::haptics
