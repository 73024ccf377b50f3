// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/support/lib3mf_file.h"

#include <array>
#include <cstdio>

#include "io/support/lib3mf_handle.h"

namespace argil::test {
namespace {

using namespace NMR;  // NOLINT: the C functions live there

double mm_of(DWORD unit) {
  switch (unit) {
    case MODELUNIT_MICROMETER:
      return 0.001;
    case MODELUNIT_MILLIMETER:
      return 1.0;
    case MODELUNIT_CENTIMETER:
      return 10.0;
    case MODELUNIT_INCH:
      return 25.4;
    case MODELUNIT_FOOT:
      return 304.8;
    default:
      return 1000.0;
  }
}

/// Calls lib3mf until a call fails.
class Reader {
 public:
  explicit Reader(Lib3mfFile& file) : file_(file) {}

  bool run(const std::filesystem::path& path) {
    Lib3mfHandle<PLib3MFModelReader> reader;
    DWORD unit = 0;
    const bool read = done(lib3mf_createmodel(model_.out())) &&
                      done(lib3mf_model_queryreader(model_, "3mf", reader.out())) &&
                      done(lib3mf_reader_readfromfileutf8(reader, path.c_str())) &&
                      done(lib3mf_model_getunit(model_, &unit));
    unit_mm_ = mm_of(unit);
    return read && take_metadata() && take_meshes() && take_components() && take_items();
  }

 private:
  static bool done(LIB3MFRESULT result) { return result == 0U; }
  bool take_metadata();
  bool take_meshes();
  bool take_mesh(PLib3MFModelMeshObject* mesh);
  std::string color_of(PLib3MFModelMeshObject* mesh);
  bool take_components();
  bool take_items();

  Lib3mfFile& file_;
  Lib3mfHandle<PLib3MFModel> model_;
  double unit_mm_ = 0.0;
};

bool Reader::take_metadata() {
  DWORD count = 0;
  if (!done(lib3mf_model_getmetadatacount(model_, &count))) return false;
  for (DWORD i = 0; i < count; ++i) {
    std::array<char, 256> key{};
    std::array<char, 256> value{};
    ULONG needed = 0;
    if (!done(lib3mf_model_getmetadatakeyutf8(model_, i, key.data(), 256, &needed)) ||
        !done(lib3mf_model_getmetadatavalueutf8(model_, i, value.data(), 256, &needed))) {
      return false;
    }
    file_.metadata[key.data()] = value.data();
  }
  return true;
}

std::string Reader::color_of(PLib3MFModelMeshObject* mesh) {
  Lib3mfHandle<PLib3MFDefaultPropertyHandler> property;
  Lib3mfHandle<PLib3MFModelBaseMaterial> group;
  DWORD id = 0;
  DWORD index = 0;
  BYTE red = 0;
  BYTE green = 0;
  BYTE blue = 0;
  BYTE alpha = 0;
  if (!done(lib3mf_object_createdefaultpropertyhandler(mesh, property.out())) ||
      !done(lib3mf_defaultpropertyhandler_getbasematerial(property, &id, &index)) ||
      !done(lib3mf_model_getbasematerialbyid(model_, id, group.out())) ||
      !done(lib3mf_basematerial_getdisplaycolor(group, index, &red, &green, &blue, &alpha))) {
    return "";
  }
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%02X%02X%02X", red, green, blue);
  return text.data();
}

bool Reader::take_mesh(PLib3MFModelMeshObject* mesh) {
  std::array<char, 256> name{};
  ULONG needed = 0;
  DWORD vertices = 0;
  DWORD triangles = 0;
  BOOL manifold = 0;
  if (!done(lib3mf_object_getnameutf8(mesh, name.data(), 256, &needed)) ||
      !done(lib3mf_meshobject_getvertexcount(mesh, &vertices)) ||
      !done(lib3mf_meshobject_gettrianglecount(mesh, &triangles)) ||
      !done(lib3mf_meshobject_ismanifoldandoriented(mesh, &manifold))) {
    return false;
  }
  Lib3mfObject object{name.data(), vertices, triangles, manifold != 0, {}, color_of(mesh)};
  std::vector<MODELMESHVERTEX> places(vertices);
  if (!done(lib3mf_meshobject_getvertices(mesh, places.data(), vertices, nullptr))) return false;
  for (const MODELMESHVERTEX& at : places) {
    const auto& [x, y, z] = at.m_fPosition;
    object.box_mm.include(unit_mm_ * Vec3{double{x}, double{y}, double{z}});
  }
  file_.objects.push_back(object);
  return true;
}

bool Reader::take_meshes() {
  Lib3mfHandle<PLib3MFModelResourceIterator> objects;
  if (!done(lib3mf_model_getmeshobjects(model_, objects.out()))) return false;
  BOOL more = 0;
  while (done(lib3mf_resourceiterator_movenext(objects, &more))) {
    if (more == 0) return true;
    Lib3mfHandle<PLib3MFModelResource> mesh;
    if (!done(lib3mf_resourceiterator_getcurrent(objects, mesh.out())) || !take_mesh(mesh)) {
      return false;
    }
  }
  return false;
}

bool Reader::take_components() {
  Lib3mfHandle<PLib3MFModelResourceIterator> objects;
  if (!done(lib3mf_model_getcomponentsobjects(model_, objects.out()))) return false;
  BOOL more = 0;
  while (done(lib3mf_resourceiterator_movenext(objects, &more))) {
    if (more == 0) return true;
    Lib3mfHandle<PLib3MFModelResource> object;
    DWORD count = 0;
    if (!done(lib3mf_resourceiterator_getcurrent(objects, object.out())) ||
        !done(lib3mf_componentsobject_getcomponentcount(object, &count))) {
      return false;
    }
    file_.components += static_cast<int>(count);
  }
  return false;
}

bool Reader::take_items() {
  Lib3mfHandle<PLib3MFModelBuildItemIterator> items;
  if (!done(lib3mf_model_getbuilditems(model_, items.out()))) return false;
  BOOL more = 0;
  while (done(lib3mf_builditemiterator_movenext(items, &more))) {
    if (more == 0) return true;
    Lib3mfHandle<PLib3MFModelBuildItem> item;
    BOOL moves = 0;
    if (!done(lib3mf_builditemiterator_getcurrent(items, item.out())) ||
        !done(lib3mf_builditem_hasobjecttransform(item, &moves))) {
      return false;
    }
    ++file_.items;
    file_.moves = file_.moves || moves != 0;
  }
  return false;
}

}  // namespace

Lib3mfFile lib3mf_file(const std::filesystem::path& threemf) {
  Lib3mfFile file;
  file.is_read = Reader(file).run(threemf);
  return file;
}

bool rewrite_by_lib3mf(const std::filesystem::path& from, const std::filesystem::path& to) {
  Lib3mfHandle<PLib3MFModel> model;
  Lib3mfHandle<PLib3MFModelReader> reader;
  Lib3mfHandle<PLib3MFModelWriter> writer;
  return lib3mf_createmodel(model.out()) == 0U &&
         lib3mf_model_queryreader(model, "3mf", reader.out()) == 0U &&
         lib3mf_reader_readfromfileutf8(reader, from.c_str()) == 0U &&
         lib3mf_model_querywriter(model, "3mf", writer.out()) == 0U &&
         lib3mf_writer_writetofileutf8(writer, to.c_str()) == 0U;
}

}  // namespace argil::test
