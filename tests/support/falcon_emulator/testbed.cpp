// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/falcon_emulator/testbed.h"

#include <stdexcept>

#include <umockdev.h>

namespace argil::test {
namespace {

constexpr const char* kPlace = "/sys/devices/pci0000:00/0000:00:14.0/usb1/1-2";
constexpr const char* kNode = "/dev/bus/usb/001/002";

/// Device, configuration, interface, and the two bulk endpoints.
constexpr const char* kDescriptors =
    "1201000200000008030448CB000601020301"
    "09022000010100A02D"
    "0904000002FFFFFF00"
    "0705810240000007050202400000";

std::string description() {
  return std::string(
             "P: /devices/pci0000:00/0000:00:14.0/usb1/1-2\n"
             "N: bus/usb/001/002\n"
             "E: SUBSYSTEM=usb\n"
             "E: DEVTYPE=usb_device\n"
             "E: BUSNUM=001\n"
             "E: DEVNUM=002\n"
             "E: DEVNAME=/dev/bus/usb/001/002\n"
             "E: MAJOR=189\n"
             "E: MINOR=1\n"
             "A: busnum=1\\n\n"
             "A: devnum=2\\n\n"
             "A: speed=12\\n\n"
             "A: bConfigurationValue=1\\n\n"
             "H: descriptors=") +
         kDescriptors + "\n";
}

}  // namespace

UsbTestbed& UsbTestbed::instance() {
  static UsbTestbed testbed;
  return testbed;
}

UsbTestbed::UsbTestbed() : testbed_(umockdev_testbed_new()) {
  // Asked before there is a testbed it would say no, and remember that.
  if (umockdev_in_mock_environment() == 0) {
    throw std::runtime_error("libumockdev-preload is not linked before libusb");
  }
}

std::string UsbTestbed::root() const {
  gchar* folder = umockdev_testbed_get_root_dir(testbed_);
  std::string root = folder;
  g_free(folder);
  return root;
}

std::string UsbTestbed::node_path() const { return root() + kNode; }

void UsbTestbed::add() {
  GError* error = nullptr;
  if (umockdev_testbed_add_from_string(testbed_, description().c_str(), &error) == 0) {
    throw std::runtime_error(error->message);
  }
}

void UsbTestbed::remove() {
  umockdev_testbed_uevent(testbed_, kPlace, "remove");
  umockdev_testbed_remove_device(testbed_, kPlace);
}

}  // namespace argil::test
