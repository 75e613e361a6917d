// SPDX-License-Identifier: Zlib
#include "python/Json.h"

#include <string>

namespace wetcloth_python {
namespace {

namespace py = pybind11;
using nlohmann::json;

json objectOf(const py::dict& dictionary) {
  json object = json::object();
  for (const auto& [key, value] : dictionary) object[key.cast<std::string>()] = toJson(value);
  return object;
}

json arrayOf(const py::handle& values) {
  json array = json::array();
  for (const py::handle value : values) array.push_back(toJson(value));
  return array;
}

}  // namespace

json toJson(const py::handle& object) {
  if (object.is_none()) return nullptr;
  if (py::isinstance<py::bool_>(object)) return object.cast<bool>();
  if (py::isinstance<py::int_>(object)) return object.cast<long long>();
  if (py::isinstance<py::float_>(object)) return object.cast<double>();
  if (py::isinstance<py::str>(object)) return object.cast<std::string>();
  if (py::isinstance<py::dict>(object)) return objectOf(py::reinterpret_borrow<py::dict>(object));
  if (py::isinstance<py::list>(object) || py::isinstance<py::tuple>(object)) return arrayOf(object);
  if (py::hasattr(object, "tolist")) return toJson(object.attr("tolist")());  // NumPy's arrays and numbers
  throw py::type_error("a scene holds no " + py::str(py::type::of(object)).cast<std::string>());
}

py::object toPython(const json& value) { return py::module_::import("json").attr("loads")(value.dump()); }

}  // namespace wetcloth_python
