#include "case/field_table.hpp"
#include "case/keys.hpp"
#include "case/rules.hpp"

// How it is run: title, settling, time, solver, output.
namespace railwave::case_file {

using scene::Scene;

Section title_keys() {
  Section section;
  section.help = "Above all sections.";
  section.open = [](Scene& scene, const scene::Place&) -> void* { return &scene; };
  section.keys = {key("title", &Scene::title, "what the case is, for people; stored with the results")};
  return section;
}

Section settle_section() {
  using scene::Settle;
  auto section = single_section(
      "settle", &Scene::settle,
      "With this section the scene comes to rest under its static loads before the run; without it the run "
      "starts from the undeformed meshes.");
  section.open = [](Scene& scene, const scene::Place&) -> void* {
    scene.settle.active = true;
    return &scene.settle;
  };
  section.keys = {
      key("active", &Settle::active, "`false` leaves it out, as if the section were absent").otherwise("true"),
      key("method", &Settle::method,
          "`newton` is quick and moves point masses too; `relaxation` damps the motion of the scene until it rests, "
          "with point masses held; `automatic` is Newton's method, and relaxation from the start where that does not "
          "converge")
          .one_of({"automatic", "newton", "relaxation"}),
      key("tolerance", &Settle::tolerance, "residual over applied force at which it counts as settled")
          .within(inside(0, 1)),
      key("max_steps", &Settle::max_steps, "give up after so many evaluations of the forces").within(at_least(1)),
      key("friction", &Settle::friction,
          "`false`: contacts are frictionless while the scene settles, and the run begins without shear, or with the "
          "little that holds nodes in edges between facets (docs/static-start.md). With friction, which a slope needs, "
          "part of the shear remains that arose on the way into equilibrium"),
      key("cache", &Settle::cache,
          "the settled state is kept in a file, settled-HASH.h5, and a later run that settles under the same loads "
          "begins with it"),
      key("cache_folder", &Settle::cache_folder, "where that file lies").otherwise("beside the results"),
      key("keep_unsettled", &Settle::keep_unsettled,
          "the file is also kept when settling was interrupted or came to `max_steps`, and a later run settles on from "
          "there; `false`: neither, so that a run does not depend on what was interrupted before it"),
  };
  return section;
}

Section time_section() {
  using scene::Time;
  auto section = single_section("time", &Scene::time, "How long the run lasts and how it steps.");
  section.required = true;
  section.keys = {
      key("end", &Time::end, "simulated time").in("s").within(above(0)).mostly(between(1e-8, 10)).needed(),
      key("step_scale", &Time::step_scale, "safety factor on the largest stable step").within(above_up_to(0, 1)),
      key("step", &Time::step, "time step; 0 takes it from elements and contact").in("s").within(at_least(0)),
  };
  section.rule = check_time;
  return section;
}

Section checkpoint_section() {
  using scene::Checkpoint;
  auto section = single_section(
      "checkpoint", &Scene::checkpoint,
      "The state of a run is saved from time to time, so that `railwave run CASE --restart` goes on where the run "
      "was stopped or killed. Without this section it is saved too, at the default interval.");
  section.keys = {
      key("interval", &Checkpoint::interval,
          "wall-clock time between checkpoints; 0 is none but the one where the run is stopped from outside or its "
          "`--wall-time` is spent")
          .in("s")
          .within(at_least(0))
          .mostly(at_least(0)),
      key("file", &Checkpoint::file,
          "checkpoint file (HDF5), relative to the folder in which the program runs; the one before it is kept as "
          "`FILE.previous`")
          .otherwise("beside the results: NAME.checkpoint.h5"),
  };
  return section;
}

Section solver_section() {
  using scene::Solver;
  auto section = single_section("solver", &Scene::solver, "How the time loop computes: its numbers and its steps.");
  section.keys = {
      key("precision", &Solver::precision,
          "floating-point numbers of the step: `mixed` computes the elements in single precision and moves the nodes "
          "in double; `float` keeps the nodes in single precision too, as displacements and velocities relative to "
          "the rigid motion with which their part begins, and contact, loads, constraints and the energy account in "
          "double: for bodies that keep that rigid motion, as rounding grows with the distance from it; on a "
          "processor `double` is the fastest")
          .one_of({"double", "mixed", "float"}),
      key("step_estimate", &Solver::step_estimate,
          "what the stable step is taken from: each element's height over the wave speed, each element's highest "
          "eigenvalue (the shortest), or the whole scene's highest frequency (the longest step); `automatic` takes "
          "the last where the steps that it saves are worth more than finding it, else the first. Elements that change "
          "their shape shorten the step by any of them")
          .one_of({"automatic", "element", "eigenvalue", "global"}),
      key("subcycling", &Solver::subcycling,
          "coarse regions take longer steps, 2, 4, ... 32 times the finest, with layers of buffer elements between "
          "the levels; what is in contact or loaded takes the finest step, and so do all elements at multipliers, "
          "ties, prescribed motions and beams. Outputs fall on whole cycles, which are as long as the longest step: "
          "their intervals are rounded to it. Settling does not use it; not with `step_estimate = \"global\"`"),
      key("renew_steps", &Solver::renew_steps,
          "steps between renewals of the whole scene's step; 0 is only as contact (`automatic`) or deformed elements "
          "ask "
          "for it")
          .within(at_least(0)),
  };
  return section;
}

Section output_section() {
  using scene::Output;
  auto section = single_section("output", &Scene::output, "What is written, and how often.");
  section.keys = {
      key("file", &Output::file,
          "results file (HDF5), relative to the folder in which the program runs; its folder must be there")
          .otherwise("results/NAME/NAME.h5, NAME being the case file's name without .toml; the folder is made"),
      key("history_interval", &Output::history_interval,
          "between samples of the histories, evenly spaced to the last; 0 is every step. The step is shortened, by a "
          "tenth at most, so that whole steps make an interval; where the run is no whole number of intervals, these "
          "are shortened so that it is. An interval of few steps, a given `time.step` and a step that is renewed "
          "have samples at the nearest steps. Times in the results are true in any case")
          .in("s")
          .within(at_least(0)),
      key("field_interval", &Output::field_interval,
          "between outputs of the fields, likewise; 0 is only the beginning and the end")
          .in("s")
          .within(at_least(0)),
      key("field_sets", &Output::field_sets, "where fields are written").names(whole_part | element_set | surface),
      key("fields", &Output::fields, "which fields. " + fields_help(FieldRow::fields))
          .one_of(names_of(fields_for(FieldRow::fields))),
      key("history_sets", &Output::history_sets,
          "whose histories are written: of a node set or point mass displacement, velocity and acceleration, mean by "
          "mass; of an element set stress and strain, and plastic strain where the material yields, mean by volume")
          .names(node_set | element_set | point),
      key("history_beams", &Output::history_beams,
          "beams whose section forces are written with the histories, by their names, such as bolts of a track's joint")
          .otherwise("all"),
      key("contact_margin", &Output::contact_margin,
          "of contact surfaces only the nodes are written that lie within this distance of a box around those that "
          "touch; the box goes with the contact. Results stay small, and outputs quick, where these are many. "
          "`railwave "
          "contact` fits creepages in a ring around the patch, for which the margin needs some three times its length")
          .in("m")
          .within(above(0))
          .otherwise("the whole surfaces"),
      key("contact_fields", &Output::contact_fields,
          "what is written of contact surfaces. `railwave contact` needs `normal_force`, `tangential_force` and "
          "`position` or `displacement`; from positions it finds areas and normals, where the margin is an element or "
          "more; without `velocity` of both surfaces it takes `slip_velocity` for the micro-slip, and knows no "
          "creepages. " +
              contact_fields_help())
          .one_of(contact_field_names())
          .otherwise("all"),
      key("contact_sides", &Output::contact_sides, "which surfaces of contacts are written")
          .one_of({"slave", "master"}),
      key("precision", &Output::precision,
          "of the numbers that are written of fields and contacts: `single` has seven digits and takes half the room. "
          "Histories are written in double precision")
          .one_of({"double", "single"}),
      key("significant_digits", &Output::significant_digits,
          "to which fields and contacts are rounded before they are compressed, but for displacements and positions: "
          "4 take some 30 % off the room of `single`, 3 some 40 %. Velocities of bodies that roll need all, if slip is "
          "to be taken from them")
          .within(between(2, 15))
          .otherwise("all"),
      key("progress_interval", &Output::progress_interval, "wall-clock time between lines of progress")
          .in("s")
          .within(above(0))
          .mostly(above(0)),
  };
  section.rule = check_output;
  return section;
}

Section output_window_section() {
  using scene::OutputWindow;
  auto section = named_section(
      "output_windows", "output window", &Scene::output_windows,
      "Parts of the run in which fields are written more often: while a wheel crosses a joint, say. What is written is "
      "as in `[output]`; these outputs are added to those of `output.field_interval`. Where windows overlap, each set "
      "and contact is written by all that have it.");
  section.keys = {
      key("start", &OutputWindow::start, "when the window begins; its first output is at the next step")
          .in("s")
          .within(at_least(0))
          .needed(),
      key("end", &OutputWindow::end, "no output of the window is later")
          .in("s")
          .within(above(0))
          .otherwise("the run's"),
      key("interval", &OutputWindow::interval,
          "between outputs, rounded to whole steps (with `solver.subcycling` to whole cycles); 0 is every step. Times "
          "in the results are true in any case")
          .in("s")
          .within(at_least(0))
          .needed(),
      key("field_sets", &OutputWindow::field_sets, "which of `output.field_sets` are written").otherwise("all"),
      key("contacts", &OutputWindow::contacts, "which contacts are written, by their names").otherwise("all"),
  };
  section.rule = check_output_window;
  return section;
}

}  // namespace railwave::case_file
