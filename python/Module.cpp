// SPDX-License-Identifier: Zlib
// The module of one precision; the package wetcloth chooses which of them it takes.
#include "python/Json.h"
#include "python/PythonScene.h"

#include "command/cli/Errors.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstddef>
#include <exception>
#include <memory>
#include <string>
#include <vector>

namespace wetcloth_python {
namespace {

namespace py = pybind11;
using command::Json;

/// What Python has of a cloth. It keeps the scene alive.
struct PythonCloth {
  std::shared_ptr<PythonScene> scene;
  std::size_t index;

  const btSoftBody& body() const { return scene->body(index); }
  const wetcloth::WetCloth& wet() const { return scene->cloth(index); }
};

/// Without the interpreter's lock: an action that may wait for another thread's step must not stop all threads.
template <class Action>
decltype(auto) withoutLock(const Action& action) {
  const py::gil_scoped_release others;
  return action();
}

// --- arrays -----------------------------------------------------------------------------------------------------

/// To look at, not to write to: Bullet would not notice. It keeps the scene alive.
template <class T>
py::array view(const PythonCloth& cloth, const T* first, std::vector<py::ssize_t> shape,
               std::vector<py::ssize_t> strides) {
  py::array array(py::dtype::of<T>(), std::move(shape), std::move(strides), first, py::cast(cloth.scene));
  array.attr("flags").attr("writeable") = false;
  return array;
}

/// One vector of each node, where Bullet has them.
py::array nodes(const PythonCloth& cloth, const btVector3 btSoftBody::Node::*vector) {
  const btAlignedObjectArray<btSoftBody::Node>& all = cloth.body().m_nodes;
  return view(cloth, (all[0].*vector).m_floats, {all.size(), 3},
              {static_cast<py::ssize_t>(sizeof(btSoftBody::Node)), static_cast<py::ssize_t>(sizeof(btScalar))});
}

py::array water(const PythonCloth& cloth) {
  const std::vector<double>& held = cloth.wet().water().heldByNode();
  return view(cloth, held.data(), {static_cast<py::ssize_t>(held.size())}, {sizeof(double)});
}

py::array colours(const PythonCloth& cloth) {
  const std::vector<float>& colours = withoutLock([&]() -> auto& { return cloth.scene->colours(cloth.index); });
  return view(cloth, colours.data(), {static_cast<py::ssize_t>(colours.size() / 3), 3},
              {3 * sizeof(float), sizeof(float)});
}

py::array_t<int> triangles(const PythonCloth& cloth) {
  const btSoftBody& body = cloth.body();
  py::array_t<int> corners({body.m_faces.size(), 3});
  auto corner = corners.mutable_unchecked<2>();
  for (int f = 0; f < body.m_faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) corner(f, k) = static_cast<int>(body.m_faces[f].m_n[k] - &body.m_nodes[0]);
  }
  return corners;
}

template <class Of>
py::array_t<double> eachNode(const PythonCloth& cloth, const Of& of) {
  py::array_t<double> values(cloth.wet().nodeCount());
  for (int i = 0; i < cloth.wet().nodeCount(); ++i) values.mutable_at(i) = of(cloth.wet(), i);
  return values;
}

py::array_t<int> pins(const PythonCloth& cloth) {
  const std::vector<int>& pins = cloth.scene->pins(cloth.index);
  return py::array_t<int>(static_cast<py::ssize_t>(pins.size()), pins.data());
}

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

void movePins(const PythonCloth& cloth, const Numbers& places) {
  if (places.ndim() != 2 || places.shape(1) != 3) throw std::invalid_argument("places must have the shape (pins, 3)");
  const auto at = places.unchecked<2>();
  std::vector<btVector3> goals;
  for (py::ssize_t i = 0; i < places.shape(0); ++i) {
    goals.emplace_back(btScalar(at(i, 0)), btScalar(at(i, 1)), btScalar(at(i, 2)));
  }
  withoutLock([&] { cloth.scene->movePins(cloth.index, std::move(goals)); });
}

void setWater(const PythonCloth& cloth, const Numbers& held) {
  if (held.ndim() != 1) throw std::invalid_argument("water must have the shape (nodes,)");
  withoutLock([&] { cloth.scene->setWater(cloth.index, std::vector<double>(held.data(), held.data() + held.size())); });
}

// --- ledgers ----------------------------------------------------------------------------------------------------

py::dict ledger(const PythonCloth& cloth) {
  const wetcloth::Ledger ledger = cloth.wet().ledger();
  py::dict numbers;
  numbers["initial"] = ledger.initial;
  numbers["absorbed"] = ledger.absorbed;
  numbers["dripped"] = ledger.dripped;
  numbers["evaporated"] = ledger.evaporated;
  numbers["held"] = ledger.held;
  numbers["run_off"] = ledger.runOff;
  return numbers;
}

py::object worldLedger(const PythonScene& scene) {
  if (scene.world().drops() == nullptr) return py::none();
  const wetcloth::WorldLedger ledger = scene.world().drops()->ledger();
  py::dict numbers;
  numbers["initial"] = ledger.initial;
  numbers["absorbed"] = ledger.absorbed;
  numbers["brought"] = ledger.brought;
  numbers["held"] = ledger.held;
  numbers["in_flight"] = ledger.inFlight;
  numbers["films"] = ledger.films;
  numbers["evaporated"] = ledger.evaporated;
  numbers["left"] = ledger.left;
  return numbers;
}

// --- scenes -----------------------------------------------------------------------------------------------------

std::shared_ptr<PythonScene> openScene(Json description, const std::string& file) {
  const py::gil_scoped_release others;  // dressing takes seconds
  return std::make_shared<PythonScene>(std::move(description), file);
}

/// Other threads run while it steps; Ctrl-C is heard between two steps.
void step(PythonScene& scene, int steps) {
  if (steps < 1) throw std::invalid_argument("steps = " + std::to_string(steps) + ": must be >= 1");
  for (int left = steps; left > 0; --left) {
    {
      const py::gil_scoped_release others;
      scene.step(left);
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
}

py::bytes save(const PythonScene& scene) {
  std::string state;
  {
    const py::gil_scoped_release others;
    state = scene.save();
  }
  return py::bytes(state);
}

void restore(PythonScene& scene, const py::bytes& state) {
  const std::string bytes = state;
  const py::gil_scoped_release others;
  scene.restore(bytes);
}

std::vector<PythonCloth> cloths(const std::shared_ptr<PythonScene>& scene) {
  std::vector<PythonCloth> cloths;
  for (std::size_t i = 0; i < scene->world().cloths().size(); ++i) cloths.push_back({scene, i});
  return cloths;
}

PythonCloth clothNamed(const std::shared_ptr<PythonScene>& scene, const std::string& name) {
  for (const PythonCloth& cloth : cloths(scene)) {
    if (scene->scene().cloths[cloth.index].name == name) return cloth;
  }
  throw py::key_error("the scene has no cloth \"" + name + "\"");
}

/// Errors are those of the package, whichever module raises them.
void translate(std::exception_ptr thrown) {  // NOLINT(performance-unnecessary-value-param): pybind11 wants it
  const auto raise = [](const char* name, const std::exception& error) {
    PyErr_SetString(py::module_::import("wetcloth.errors").attr(name).ptr(), error.what());
  };
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const command::InputError& error) {
    raise("InputError", error);
  } catch (const command::RunError& error) {
    raise("RunError", error);
  } catch (const wetcloth::StateError& error) {
    raise("StateError", error);
  }
}

void bindScene(py::module_& module) {
  py::class_<PythonScene, std::shared_ptr<PythonScene>>(module, "Scene", "A scene that runs. wetcloth.open() makes it.")
      .def("step", step, py::arg("steps") = 1,
           "Runs so many steps of the scene, >= 1. Other threads run meanwhile.\n\nRaises RunError when a cloth blows "
           "up.")
      .def("save", save,
           "The whole state as bytes: a scene that was opened from the same file and restores it goes on bit for "
           "bit.\n\n"
           "Raises StateError for what cannot be saved.")
      .def(
          "restore", restore, py::arg("state"),
          "Goes on from what save() returned. Arrays stay valid and show the restored state.\n\nRaises StateError when "
          "the bytes are no such state; then nothing has changed.")
      .def("__repr__",
           [](const PythonScene& scene) {
             return py::str("<wetcloth.Scene {!r}, {}, {} cloths, t = {:g} s>")
                 .format(scene.scene().name, command::nameOf(command::ownPrecision), scene.world().cloths().size(),
                         scene.world().time());
           })
      .def("__getitem__", clothNamed, py::arg("name"), "The cloth of that name. Raises KeyError.")
      .def_property_readonly("cloths", cloths, "Its cloths, in the order of the file.")
      .def_property_readonly(
          "name", [](const PythonScene& scene) { return scene.scene().name; }, "As the file says.")
      .def_property_readonly(
          "time_s", [](const PythonScene& scene) { return scene.world().time(); }, "Simulated time [s].")
      .def_property_readonly(
          "steps", [](const PythonScene& scene) { return scene.world().steps(); }, "Steps since its start.")
      .def_property_readonly(
          "step_s", [](const PythonScene& scene) { return scene.scene().step; }, "Length of a step [s].")
      .def_property_readonly(
          "duration_s", [](const PythonScene& scene) { return scene.scene().duration; },
          "How long the file wants it to run [s]; step() goes on beyond it.")
      .def_property_readonly(
          "precision", [](const PythonScene&) { return command::nameOf(command::ownPrecision); },
          "Of Bullet's numbers, \"float32\" or \"float64\".")
      .def_property_readonly("ledger", worldLedger,
                             "Where all the water of the world came from and went to [kg], of a scene with drops; None "
                             "without: then each cloth has its own. initial + absorbed + brought == held + in_flight + "
                             "films + evaporated + left, to rounding.")
      .def_property_readonly("_hints", [](const PythonScene& scene) { return scene.scene().hints; });
}

void bindCloth(py::module_& module) {
  py::class_<PythonCloth>(module, "Cloth", "A cloth of a scene, and its water. Nodes are numbered as in Bullet.")
      .def("__repr__",
           [](const PythonCloth& cloth) {
             return py::str("<wetcloth.Cloth {!r}, {} nodes, {:g} kg of water>")
                 .format(cloth.scene->scene().cloths[cloth.index].name, cloth.wet().nodeCount(),
                         cloth.wet().ledger().held);
           })
      .def_property_readonly(
          "name", [](const PythonCloth& cloth) { return cloth.scene->scene().cloths[cloth.index].name; },
          "As the file says.")
      .def_property_readonly(
          "positions", [](const PythonCloth& cloth) { return nodes(cloth, &btSoftBody::Node::m_x); },
          "Places of the nodes [m], shape (nodes, 3): a view of Bullet's own numbers, which follows the steps.")
      .def_property_readonly(
          "velocities", [](const PythonCloth& cloth) { return nodes(cloth, &btSoftBody::Node::m_v); },
          "Velocities of the nodes [m/s], shape (nodes, 3): a view, as positions.")
      .def_property_readonly(
          "normals", [](const PythonCloth& cloth) { return nodes(cloth, &btSoftBody::Node::m_n); },
          "Normals at the nodes, of length 1 after the first step, shape (nodes, 3): a view, as positions.")
      .def_property(
          "water", water, setWater,
          "Water of each node [kg], shape (nodes,), float64: a view of the library's numbers, which follows the steps. "
          "Set it as a whole, finite and >= 0; ValueError names the node that is not.")
      .def_property_readonly(
          "colours", colours,
          "Diffuse colour of each node, linear RGB in [0, 1], shape (nodes, 3), float32: a view that "
          "asking for it fills anew.")
      .def_property_readonly("triangles", triangles, "Corners of the triangles, shape (triangles, 3): a copy.")
      .def_property_readonly(
          "dry_mass",
          [](const PythonCloth& cloth) {
            return eachNode(cloth, [](const wetcloth::WetCloth& wet, int node) { return wet.dryMass(node); });
          },
          "Mass of each node without water [kg], shape (nodes,): a copy.")
      .def_property_readonly(
          "capacity",
          [](const PythonCloth& cloth) {
            return eachNode(cloth, [](const wetcloth::WetCloth& wet, int node) { return wet.capacity(node); });
          },
          "Water that each node holds at saturation [kg], shape (nodes,): a copy.")
      .def_property_readonly(
          "saturation",
          [](const PythonCloth& cloth) {
            return eachNode(cloth, [](const wetcloth::WetCloth& wet, int node) { return wet.saturation(node); });
          },
          "water / capacity of each node, shape (nodes,): a copy.")
      .def_property_readonly("ledger", ledger,
                             "Where its water came from and went to [kg]: initial + absorbed == dripped + evaporated + "
                             "held, to rounding; run_off struck it and was not taken in.")
      .def_property_readonly("pins", pins, "Numbers of the pinned nodes, shape (pins,): a copy.")
      .def(
          "move_pins", movePins, py::arg("places"),
          "Where the pinned nodes are to be [m], shape (pins, 3), when the next call of step() ends; they go there at "
          "an "
          "even speed.\n\nRaises ValueError when the shape is another one, a number is not finite, or the scene itself "
          "moves them.")
      .def_property_readonly(
          "effects",
          [](const PythonCloth& cloth) {
            return toPython(withoutLock([&] { return cloth.scene->effects(cloth.index); }));
          },
          "Its effects as in a scene file, a dictionary: a copy.")
      .def(
          "change",
          [](const PythonCloth& cloth, const std::string& effect, const py::kwargs& parameters) {
            const Json patch = toJson(parameters);
            withoutLock([&] { cloth.scene->change(cloth.index, effect, patch); });
          },
          py::arg("effect"),
          "Changes parameters of an effect, from the next step on, by the keys of a scene file: "
          "change(\"wind\", velocity_m_s=[4, 0, 1]). What is not named stays; None takes a key away. An effect that "
          "the "
          "cloth does not have is added.\n\nRaises InputError as a file would; then nothing has changed.")
      .def(
          "remove",
          [](const PythonCloth& cloth, const std::string& effect) {
            withoutLock([&] { cloth.scene->remove(cloth.index, effect); });
          },
          py::arg("effect"), "Takes an effect away. Raises ValueError when the cloth does not have it.");
}

}  // namespace

PYBIND11_MODULE(WETCLOTH_PYTHON_MODULE, module) {
  module.doc() = "Scenes in one of Bullet's precisions. Use the package wetcloth.";
  py::register_exception_translator(translate);
  bindScene(module);
  bindCloth(module);
  module.def(
      "open_file", [](const std::string& file) { return openScene(command::loadJson(file), file); }, py::arg("file"));
  module.def(
      "open_description",
      [](const py::dict& description, const std::string& name) { return openScene(toJson(description), name); },
      py::arg("description"), py::arg("name"));
}

}  // namespace wetcloth_python
