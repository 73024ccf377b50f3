// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/md5.h"

#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace argil::viewer {
namespace {

TEST(Md5, IsThatOfRfc1321) {
  for (const auto& [bytes, digits] :
       {std::pair{"", "d41d8cd98f00b204e9800998ecf8427e"},
        {"a", "0cc175b9c0f1b6a831c399e269772661"},
        {"abc", "900150983cd24fb0d6963f7d28e17f72"},
        {"message digest", "f96b697d7cb7938d525a2f31aaf161d0"},
        {"abcdefghijklmnopqrstuvwxyz", "c3fcd3d76192e4007dfb496cca67e13b"},
        {"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789",
         "d174ab98d277d9f5a5611c2c9f419d9f"},
        {"12345678901234567890123456789012345678901234567890123456789012345678901234567890",
         "57edf4a22be3c955ac49da2e2107b67a"}}) {
    EXPECT_EQ(md5_of(bytes), digits) << bytes;
  }
}

/// Where a block is full, and where the length just fits behind the rest or no longer does; by
/// md5sum.
TEST(Md5, IsTheSameAroundTheEndsOfBlocks) {
  for (const auto& [length, digits] : {std::pair{55U, "ef1772b6dff9a122358552954ad0df65"},
                                       {56U, "3b0c8ac703f828b04c6c197006d17218"},
                                       {57U, "652b906d60af96844ebd21b674f35e93"},
                                       {63U, "b06521f39153d618550606be297466d5"},
                                       {64U, "014842d480b571495a4a0363793f7367"},
                                       {65U, "c743a45e0d2e6a95cb859adae0248435"},
                                       {119U, "8a7bd0732ed6a28ce75f6dabc90e1613"},
                                       {120U, "5f61c0ccad4cac44c75ff505e1f1e537"},
                                       {128U, "e510683b3f5ffe4093d021808bc6ff70"},
                                       {1000U, "cabe45dcc9ae5b66ba86600cca6b8ba8"}}) {
    EXPECT_EQ(md5_of(std::string(length, 'a')), digits) << length;
  }
}

}  // namespace
}  // namespace argil::viewer
