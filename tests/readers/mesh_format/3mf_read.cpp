// SPDX-License-Identifier: GPL-3.0-or-later
// 3MF as the parts it is made of: names, colors, places; and files that mean harm.
#include <span>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/assembly.h"

#include "mesh_format/mesh_read.h"
#include "support/bytes/zip_maker.h"

namespace argil::io {
namespace {

using test::relations;
using test::stored;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A tetrahedron of volume 4.5; `triangle` goes into each of its triangles.
std::string mesh_text(const std::string& triangle = "") {
  std::string text =
      R"(<mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="3" y="0" z="0"/>)"
      R"(<vertex x="0" y="3" z="0"/><vertex x="0" y="0" z="3"/></vertices><triangles>)";
  for (const char* corners : {R"(v1="0" v2="2" v3="1")", R"(v1="0" v2="1" v3="3")",
                              R"(v1="1" v2="2" v3="3")", R"(v1="2" v2="0" v3="3")"}) {
    text += "<triangle " + std::string(corners) + " " + triangle + "/>";
  }
  return text + "</triangles></mesh>";
}

std::string object_text(int id, const std::string& attributes = "",
                        const std::string& triangle = "") {
  return "<object id=\"" + std::to_string(id) + "\" " + attributes + ">" + mesh_text(triangle) +
         "</object>";
}

std::string model_text(const std::string& resources, const std::string& build,
                       const std::string& unit = "millimeter") {
  return "<model unit=\"" + unit + "\"><resources>" + resources + "</resources><build>" + build +
         "</build></model>";
}

Result<ThreemfAssembly> parse_archive(const std::string& archive) {
  StatedUnit unit;
  return parse_3mf(std::as_bytes(std::span(archive)), "a.3mf", unit);
}

Result<ThreemfAssembly> parse_model(const std::string& model, const std::string& config = "") {
  std::vector<test::PackedEntry> entries{relations(), stored("3D/a.model", model)};
  if (!config.empty()) entries.push_back(stored("Metadata/Slic3r_PE_model.config", config));
  return parse_archive(test::zip_of(entries));
}

ThreemfAssembly parsed(const std::string& model, const std::string& config = "") {
  auto read = parse_model(model, config);
  EXPECT_TRUE(read) << read.error().message;
  return read ? std::move(read).value() : ThreemfAssembly{};
}

std::string refusal(const std::string& model, const std::string& config = "") {
  const auto read = parse_model(model, config);
  if (read) return "accepted";
  EXPECT_EQ(read.error().kind, ErrorKind::bad_input);
  return read.error().message;
}

std::vector<std::string> names_of(const Assembly& assembly) {
  std::vector<std::string> names;
  for (const PlacedPart& part : placed_parts(assembly)) names.push_back(part.name);
  return names;
}

constexpr const char* kColors =
    R"(<basematerials id="1"><base name="r" displaycolor="#FF0000"/>)"
    R"(<base name="none"/><base name="bad" displaycolor="#12"/>)"
    R"(<base name="g" displaycolor="#00ff00FF"/></basematerials>)"
    R"(<m:colorgroup id="2"><m:color color="#0000FF"/></m:colorgroup>)"
    R"(<m:texture2dgroup id="3" texid="9"><m:tex2coord u="0" v="0"/></m:texture2dgroup>)";

TEST(ReadThreemfParts, KeepsNamesItemsAndPlacesInMm) {
  const auto [assembly, notes] = parsed(model_text(
      object_text(1, R"(name="Lid &amp; &#x68;inge")") + object_text(2, R"(name=" Pin ")") +
          R"(<object id="3" name="Lamp"><components><component objectid="1"/>)"
          R"(<component objectid="2" transform="1 0 0 0 1 0 0 0 1 0 0 2"/></components></object>)",
      R"(<item objectid="3" transform="-1 0 0 0 1 0 0 0 1 10 0 0"/><item objectid="2"/>)", "inch"));
  EXPECT_THAT(notes, IsEmpty());
  ASSERT_EQ(assembly.objects.size(), 2U);
  ASSERT_EQ(assembly.items.size(), 2U);
  EXPECT_EQ(assembly.items[0].name, "Lamp");
  EXPECT_EQ(assembly.items[1].name, "");
  EXPECT_THAT(names_of(assembly), ElementsAre("Lid & hinge", "Pin", "Pin (2)"));
  const PlacedObject& pin = assembly.items[0].placements[1];
  EXPECT_EQ(pin.object, 1U);
  EXPECT_NEAR(length(pin.to_mm.rows[3] - 25.4 * Vec3{10, 0, 2}), 0.0, 1e-12);
  // A mirror turns the triangles with it.
  const TriangleMesh mirrored = placed_mesh(assembly.objects[1].mesh, pin.to_mm);
  EXPECT_NEAR(signed_volume(mirrored), 4.5 * 25.4 * 25.4 * 25.4, 1e-6);
}

TEST(ReadThreemfParts, TakeTheColorOfTheObjectOrOfMostTriangles) {
  const std::string item = R"(<item objectid="5"/>)";
  const auto color = [&](const std::string& attributes, const std::string& triangle) {
    return parsed(model_text(kColors + object_text(5, attributes, triangle), item))
        .assembly.objects[0]
        .color;
  };
  EXPECT_EQ(color(R"(pid="1" pindex="0")", ""), (Srgb{255, 0, 0}));
  EXPECT_EQ(color(R"(pid="1")", ""), (Srgb{255, 0, 0}));
  EXPECT_EQ(color(R"(pid="1" pindex="0")", R"(p1="3")"), (Srgb{0, 255, 0}));
  EXPECT_EQ(color("", R"(pid="2" p1="0")"), (Srgb{0, 0, 255}));
  EXPECT_EQ(color("", ""), std::nullopt);
  EXPECT_EQ(color(R"(pid="1" pindex="1")", ""), std::nullopt);
  // Three triangles of one color, one of another.
  std::string painted = object_text(5, R"(name="p" pid="1" pindex="0")");
  painted.insert(painted.rfind("/></triangles>"), R"(pid="2" p1="0")");
  const auto [assembly, notes] = parsed(model_text(kColors + painted, item));
  EXPECT_EQ(assembly.objects[0].color, (Srgb{255, 0, 0}));
  EXPECT_THAT(notes, ElementsAre(HasSubstr("'#12' is not of the form"),
                                 HasSubstr("'p' has 2 colors; that of most of its triangles")));
}

TEST(ReadThreemfParts, SayWhichColorsAreMissing) {
  const auto notes = [](const std::string& attributes) {
    const auto read =
        parsed(model_text(kColors + object_text(5, attributes), R"(<item objectid="5"/>)"));
    EXPECT_EQ(read.assembly.objects[0].color, std::nullopt) << attributes;
    return read.notes.back();
  };
  EXPECT_EQ(notes(R"(pid="7" pindex="0")"),
            "object 5 refers to the colors 7, which the file does not have");
  EXPECT_EQ(notes(R"(name="a" pid="1" pindex="4")"), "'a' refers to color 4 (from 0) of only 4");
  EXPECT_EQ(notes(R"(pid="1" pindex="-1")"), "object 5 refers to color -1 (from 0) of only 4");
  EXPECT_THAT(notes(R"(pid="3" pindex="0")"), HasSubstr("has a texture or a mixture"));
  EXPECT_THAT(notes(R"(pid="1" pindex="99999999999999999999")"), HasSubstr("color -1 (from 0)"));
}

constexpr const char* kTwoInOne =
    R"(<config><object id="5"><metadata key="name" value="Lamp"/>)"
    R"(<volume firstid="0" lastid="0"><metadata key="name" value="Foot"/></volume>)"
    R"(<volume firstid="1" lastid="3"><metadata key="name" value="Head"/>)"
    R"(<metadata key="volume_type" value="ModelPart"/></volume></object></config>)";
const std::string kOneObject = model_text(object_text(5), R"(<item objectid="5"/>)");

TEST(ReadThreemfParts, AreThoseThatPrusaSlicerMerged) {
  const auto [assembly, notes] = parsed(kOneObject, kTwoInOne);
  EXPECT_THAT(notes, IsEmpty());
  EXPECT_THAT(names_of(assembly), ElementsAre("Foot", "Head"));
  ASSERT_EQ(assembly.items.size(), 1U);
  EXPECT_EQ(assembly.items[0].name, "Lamp");
  EXPECT_EQ(assembly.objects[0].mesh.triangles.size(), 1U);
  EXPECT_EQ(assembly.objects[1].mesh.triangles.size(), 3U);
}

TEST(ReadThreemfParts, AreNoModifiersOfASlicer) {
  std::string config = kTwoInOne;
  config.replace(config.find("ModelPart"), 9, "NegativeVolume");
  const auto [assembly, notes] = parsed(kOneObject, config);
  EXPECT_THAT(names_of(assembly), ElementsAre("Foot"));
  EXPECT_THAT(notes, ElementsAre("'Head' of 'Lamp' is a modifier or blocker of the slicer and no "
                                 "part: left out"));
}

TEST(ReadThreemfParts, HaveTheNamesOfBambuStudio) {
  const std::string model = model_text(object_text(1) + object_text(2) +
                                           R"(<object id="8"><components><component objectid="1"/>)"
                                           R"(<component objectid="2"/></components></object>)",
                                       R"(<item objectid="8"/>)");
  const std::string config =
      R"(<config><object id="8"><metadata key="name" value="Lamp"/>)"
      R"(<part id="1" subtype="normal_part"><metadata key="name" value="Foot"/></part>)"
      R"(<part id="2" subtype="modifier_part"><metadata key="name" value="Cube"/></part>)"
      R"(</object></config>)";
  const auto read = parse_archive(test::zip_of({relations(), stored("3D/a.model", model),
                                                stored("Metadata/model_settings.config", config)}));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_THAT(names_of(read.value().assembly), ElementsAre("Foot"));
  EXPECT_EQ(read.value().assembly.items[0].name, "Lamp");
  EXPECT_THAT(read.value().notes, ElementsAre(HasSubstr("'Cube' of 'Lamp' is a modifier")));
}

/// A slicer's file beside the model costs names, never the parts.
TEST(ReadThreemfParts, SurviveDamagedNames) {
  const std::string damaged[] = {
      "<config><object id=\"5\">", "no xml", "<config><object id=\"five\"/></config>",
      "<config><object id=\"5\"><volume firstid=\"0\"/></object></config>",
      "<config><object id=\"5\"><part/></object></config>"};
  for (const std::string& config : damaged) {
    const auto [assembly, notes] = parsed(kOneObject, config);
    EXPECT_THAT(names_of(assembly), ElementsAre("part 1")) << config;
    EXPECT_THAT(notes, ElementsAre(HasSubstr("Slic3r_PE_model.config' cannot be read (line 1:")));
  }
  const std::string name = R"(<config><object id="5"><metadata key="name" value="Lamp"/>)";
  for (const char* ranges :
       {R"(<volume firstid="0" lastid="1"/><volume firstid="1" lastid="3"/>)",
        R"(<volume firstid="0" lastid="1"/><volume firstid="2" lastid="4"/>)",
        R"(<volume firstid="0" lastid="9223372036854775807"/><volume firstid="2" lastid="4"/>)",
        R"(<volume firstid="-1" lastid="1"/><volume firstid="2" lastid="3"/>)",
        R"(<volume firstid="0" lastid="-1"/><volume firstid="0" lastid="3"/>)",
        R"(<volume firstid="0" lastid="1"/><volume firstid="2" lastid="2"/>)"}) {
    const auto [assembly, notes] = parsed(kOneObject, name + ranges + "</object></config>");
    EXPECT_THAT(names_of(assembly), ElementsAre("Lamp")) << ranges;
    EXPECT_THAT(notes, ElementsAre(HasSubstr("parts of 'Lamp' do not fit its triangles")));
  }
  // Of an object that the model does not have.
  EXPECT_THAT(parsed(kOneObject, R"(<config><object id="6"/></config>)").notes, IsEmpty());
}

TEST(ReadThreemfParts, HaveNamesFitForPeopleAndJson) {
  const auto name = [](const std::string& given) {
    return parsed(model_text(object_text(1, "name=\"" + given + "\""), R"(<item objectid="1"/>)"))
        .assembly.objects[0]
        .name;
  };
  EXPECT_EQ(name("a\tb\x01 c\x7F"), "a b  c");
  EXPECT_EQ(name("&#0;&#7;&#xD800;&#x110000;&bad;&"), "&#0; &#xD800;&#x110000;&bad;&");
  EXPECT_EQ(name("\xC3\xA4\xFF\xC3"), "\xC3\xA4??");
  EXPECT_EQ(name("\xE2\x82\xAC \xF0\x9F\x98\x80"), "\xE2\x82\xAC \xF0\x9F\x98\x80");
  EXPECT_EQ(name("\xC0\x80\xED\xA0\x80"), "?????");
  EXPECT_EQ(name("&#228;&#x20AC;&#x1F600;"), "\xC3\xA4\xE2\x82\xAC\xF0\x9F\x98\x80");
  std::string many_euros;
  for (int n = 0; n < 1000; ++n) many_euros += "\xE2\x82\xAC";
  EXPECT_EQ(name(many_euros), many_euros.substr(0, 255));
  EXPECT_EQ(name("a" + many_euros), "a" + many_euros.substr(0, 252));
  EXPECT_THAT(refusal(model_text(object_text(1, "name=\"" + std::string(10 << 20, 'x') + "\""),
                                 R"(<item objectid="1"/>)")),
              HasSubstr("a.3mf: 3D/a.model:1:"));
}

TEST(ReadThreemfParts, WithOneNameAreToldApart) {
  const std::string items = R"(<item objectid="1"/><item objectid="2"/><item objectid="1"/>)";
  const std::string bolts = object_text(1, "name=\"bolt\"") + object_text(2, "name=\"bolt (2)\"");
  EXPECT_THAT(names_of(parsed(model_text(bolts, items)).assembly),
              ElementsAre("bolt", "bolt (2)", "bolt (3)"));
  EXPECT_THAT(names_of(parsed(model_text(object_text(1) + object_text(2), items)).assembly),
              ElementsAre("part 1", "part 2", "part 3"));
}

TEST(ReadThreemfParts, ArePlacedNeitherInCirclesNorWithoutEnd) {
  const auto group = [](int id, int of, int times) {
    std::string text = "<object id=\"" + std::to_string(id) + "\"><components>";
    for (int n = 0; n < times; ++n) text += "<component objectid=\"" + std::to_string(of) + "\"/>";
    return text + "</components></object>";
  };
  EXPECT_THAT(refusal(model_text(group(1, 2, 1) + group(2, 1, 1), R"(<item objectid="1"/>)")),
              HasSubstr("place one another without end"));
  std::string doubling = object_text(1);
  for (int id = 2; id < 62; ++id) doubling += group(id, id - 1, 2);
  EXPECT_THAT(refusal(model_text(doubling, R"(<item objectid="61"/>)")),
              HasSubstr("more than 1000000 times"));
  EXPECT_THAT(refusal(model_text(group(1, 9, 1), R"(<item objectid="1"/>)")),
              HasSubstr("object 9 is missing from '/3D/a.model'"));
  EXPECT_THAT(refusal(model_text(object_text(1), "")), HasSubstr("has no triangles"));
}

TEST(ReadThreemfParts, AreNotedTenTimesAtMost) {
  std::string resources;
  std::string items;
  for (int id = 2; id < 30; ++id) {
    resources += object_text(id, R"(pid="1")");
    items += "<item objectid=\"" + std::to_string(id) + "\"/>";
  }
  const auto notes = parsed(model_text(resources, items)).notes;
  ASSERT_EQ(notes.size(), 11U);
  EXPECT_EQ(notes.back(), "and 18 more of the kind");
}

}  // namespace
}  // namespace argil::io
