// SPDX-License-Identifier: Zlib
#pragma once

#include <pybind11/pybind11.h>

#include <nlohmann/json.hpp>

namespace wetcloth_python {

/// What a Python object is as JSON: dictionaries, lists, tuples, arrays, numbers, texts, True, False and None. Throws
/// pybind11::type_error that names the type of anything else.
nlohmann::json toJson(const pybind11::handle& object);

/// The other way round.
pybind11::object toPython(const nlohmann::json& value);

}  // namespace wetcloth_python
