#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "case/error.hpp"
#include "library/simulation.hpp"

namespace py = pybind11;
using railwave::Simulation;
using railwave::SimulationState;

namespace {

py::array_t<double> array_of(const std::vector<double>& values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

/// Rows of so many values; one value a row: a plain list of them.
py::array_t<double> rows_of(const std::vector<double>& values, int columns) {
  if (columns == 1) return array_of(values);
  const auto rows = static_cast<py::ssize_t>(values.size()) / columns;
  return py::array_t<double>({rows, static_cast<py::ssize_t>(columns)}, values.data());
}

}  // namespace

PYBIND11_MODULE(railwave, module) {
  module.doc() =
      "Explicit finite elements for the dynamic interaction of wheel and rail, driven from Python.\n\n"
      "import railwave\n"
      "run = railwave.Simulation('cases/first_steps.toml', window=1e-5)\n"
      "while run.advance():\n"
      "    print(run.time, run.values('contact.tread.normal_force'))";
  module.attr("__version__") = RAILWAVE_VERSION;
  py::register_exception<railwave::InputError>(module, "InputError", PyExc_ValueError);
  py::class_<SimulationState>(module, "State", "What a simulation was at an instant, in memory.");
  py::class_<Simulation>(module, "Simulation",
                         "A case that is computed in windows of time. It computes what `railwave run` does, bit for "
                         "bit; nothing is written. SI units.")
      .def(py::init<const std::string&, double, const std::vector<std::string>&>(), py::arg("case_file"),
           py::arg("window"), py::arg("settings") = std::vector<std::string>(),
           "Reads and settles a case. window: s, from one instant at which it can be asked to the next. settings: "
           "'section.key=value', in place of what the case says.")
      .def_property_readonly("time", &Simulation::time, "s, of the present instant")
      .def_property_readonly("window", &Simulation::window, "s")
      .def_property_readonly("end", &Simulation::end, "why the case has ended; empty as long as it goes on")
      .def_property_readonly("histories", &Simulation::histories, "all names that values() knows")
      .def("advance", &Simulation::advance, py::call_guard<py::gil_scoped_release>(),
           "To the end of the next window. False: the case has ended.")
      .def("drive", &Simulation::drive, py::arg("curve"), py::arg("value"),
           "Leads a curve of type 'table' from its present value to this one over the next window.")
      .def(
          "values", [](const Simulation& run, const std::string& name) { return array_of(run.values(name)); },
          py::arg("history"), "A quantity of the present instant, such as 'contact.tread.normal_force'.")
      .def(
          "field",
          [](const Simulation& run, const std::string& name, const std::string& set) {
            return rows_of(run.field(name, set), run.field_components(name));
          },
          py::arg("name"), py::arg("set"), "One of output.fields on one of output.field_sets, a row an entry.")
      .def(
          "coordinates", [](const Simulation& run, const std::string& set) { return rows_of(run.coordinates(set), 3); },
          py::arg("set"), "Undeformed places of the nodes of one of output.field_sets, m.")
      .def("save", &Simulation::save, "The present state.")
      .def("restore", &Simulation::restore, py::arg("state"),
           "Takes up a state of this simulation; what follows is, bit for bit, what followed then.");
}
