// "shapes": one reader per type, chosen by a table.
#include <iterator>
#include <variant>

#include "scene/families.hpp"
#include "scene/read_parts.hpp"
#include "shared/shape.h"

namespace brume {

namespace {

using Geometry = decltype(ShapeDesc::geometry);
using Folder = std::filesystem::path;

Scale read_scale(const JsonValue& value) {
  const Scale s{value.as_color(Range::any())};
  for (int i = 0; i < 3; ++i)
    if (static_cast<float>(s.factor[i]) == 0) value.fail("a scale of 0 leaves nothing; it must not be 0");
  return s;
}

Rotate read_rotate(const JsonValue& value) {
  const std::vector<JsonValue> v = value.as_list();
  if (v.size() != 4) value.fail("expected [x, y, z, degrees]" + value.got());
  Rotate r;
  for (int i = 0; i < 3; ++i) r.axis[i] = v[i].as_number(Range::any());
  r.degrees = v[3].as_number(Range::any());
  if (is_zero(r.axis)) value.fail("the axis must not be zero");
  return r;
}

std::variant<Scale, Rotate, Translate> read_step(const JsonValue& step) {
  step.expect_object();
  if (step.json().size() != 1)
    step.fail("expected one of {\"scale\": ...}, {\"rotate\": ...} and {\"translate\": ...}" + step.got());
  if (step.has("scale")) return read_scale(step.get("scale"));
  if (step.has("rotate")) return read_rotate(step.get("rotate"));
  if (!step.has("translate")) step.refuse_unread();
  return Translate{step.get("translate").as_vec3(Range::any())};
}

TransformDesc read_steps(const JsonValue& list) {
  TransformDesc steps;
  for (const JsonValue& step : list.as_list()) steps.push_back(read_step(step));
  return steps;
}

Geometry read_sphere(const JsonValue& s, const Folder&) {
  SphereDesc out;
  out.center = s.vec3("center", out.center);
  out.radius = s.number("radius", out.radius, Range::positive());
  return out;
}

Geometry read_cylinder(const JsonValue& s, const Folder&) {
  CylinderDesc out;
  out.base = s.vec3("base", out.base);
  out.top = s.vec3("top", out.top);
  out.radius = s.number("radius", out.radius, Range::positive());
  if (is_zero(out.top - out.base)) s.fail("base and top are the same point; they must differ");
  return out;
}

Geometry read_plane(const JsonValue& s, const Folder&) {
  PlaneDesc out;
  out.point = s.vec3("point", out.point);
  out.normal = s.vec3("normal", out.normal);
  if (is_zero(out.normal)) s.get("normal").fail("the normal must not be zero");
  return out;
}

Geometry read_quad(const JsonValue& s, const Folder&) {
  QuadDesc out;
  out.corner = s.vec3("corner", out.corner);
  out.u = s.vec3("u", out.u);
  out.v = s.vec3("v", out.v);
  if (!spans_area(out.u, out.v)) s.fail("u and v are parallel or zero; they must span an area");
  return out;
}

Geometry read_box(const JsonValue& s, const Folder&) {
  BoxDesc out;
  out.min = s.vec3("min", out.min);
  out.max = s.vec3("max", out.max);
  out.transform = read_transform(s);
  for (int i = 0; i < 3; ++i)
    if (!(out.min[i] < out.max[i])) s.fail("expected min < max on every axis");
  return out;
}

Geometry read_isosurface(const JsonValue& s, const Folder& folder) {
  IsosurfaceDesc out;
  out.density = std::make_shared<DensityDesc>(read_density(s.get("density"), folder));
  out.iso = s.number("iso", out.iso, Range::positive());
  if (s.has("bounds")) out.bounds = read_bounds(s.get("bounds"));
  out.transform = read_transform(s);
  return out;
}

Geometry read_triangle(const JsonValue& s, const Folder&) {
  TriangleDesc out;
  const std::vector<JsonValue> vertices = s.get("vertices").as_list();
  if (vertices.size() != 3) s.get("vertices").fail("expected 3 vertices");
  for (int i = 0; i < 3; ++i) out.vertices[i] = vertices[i].as_vec3(Range::any());
  if (!spans_area(out.vertices[1] - out.vertices[0], out.vertices[2] - out.vertices[0]))
    s.get("vertices").fail("the vertices lie on a line; they must span an area");
  return out;
}

void read_instances(const JsonValue& value, const Folder& folder, MeshDesc& mesh) {
  if (value.is_string()) {
    mesh.instance_file = read_path(value, folder);
    return;
  }
  for (const JsonValue& instance : value.as_list()) mesh.instances.push_back(read_steps(instance));
  if (mesh.instances.empty()) value.fail("expected a transform or more, or the path of a file with 12 numbers a line");
}

Geometry read_mesh(const JsonValue& s, const Folder& folder) {
  MeshDesc out;
  out.file = read_path(s.get("file"), folder);
  out.shading =
      static_cast<MeshShading>(s.member("shading", static_cast<int>(out.shading), mesh_shading_family(), "shading"));
  if (s.has("crease")) out.crease = s.get("crease").as_number(Range::closed(0, 180));
  out.transform = read_transform(s);
  if (s.has("instances")) read_instances(s.get("instances"), folder, out);
  return out;
}

// In the order of shape_family().
constexpr Geometry (*READERS[])(const JsonValue&, const Folder&) = {
    read_sphere, read_cylinder, read_plane, read_quad, read_box, read_isosurface, read_triangle, read_mesh};
static_assert(std::size(READERS) == SHAPE_COUNT + 2 && std::variant_size_v<Geometry> == std::size(READERS),
              "one reader and one struct per row of BRUME_SHAPES, then triangle and mesh");

}  // namespace

int read_material_name(const JsonValue& owner, const std::vector<MaterialDesc>& materials) {
  if (!owner.has("material")) return -1;
  const std::string name = owner.get("material").as_string();
  std::string known;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    if (materials[i].name == name) return static_cast<int>(i);
    known += (known.empty() ? "" : ", ") + materials[i].name;
  }
  owner.get("material").fail("unknown material " + text_quote(name) + "; known: " + (known.empty() ? "none" : known));
}

TransformDesc read_transform(const JsonValue& owner) {
  return owner.has("transform") ? read_steps(owner.get("transform")) : TransformDesc{};
}

std::vector<ShapeDesc> read_shapes(const JsonValue& scene, const std::vector<MaterialDesc>& materials,
                                   const Folder& folder) {
  std::vector<ShapeDesc> shapes;
  for (const JsonValue& s : scene.list("shapes")) {
    ShapeDesc shape;
    shape.place = s.place();
    shape.geometry = READERS[s.get("type").as_member(shape_family(), "shape")](s, folder);
    shape.material = read_material_name(s, materials);
    s.refuse_unread();
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

}  // namespace brume
