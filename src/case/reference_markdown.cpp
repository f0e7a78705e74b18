#include <fmt/format.h>

#include "case/keys.hpp"
#include "case/plausible.hpp"
#include "case/read_value.hpp"
#include "case/reference.hpp"
#include "case/references.hpp"
#include "case/suggest.hpp"

namespace railwave {
namespace {

using namespace case_file;

constexpr const char* introduction = R"(# The case file

A case is one [TOML](https://toml.io) file. `railwave check CASE` reads it and says what a run would be; `railwave run
CASE` runs it. Whatever is not known, of the wrong kind, out of range or refers to nothing is an error that names the
line: nothing is silently ignored. This page is made from the program's own table of keys (`railwave reference
--markdown`).

## Its shape

```toml
title = "a steel block falls on another"

[materials.steel]            # a section with a name of your choice: letters, digits, _ and -
youngs_modulus = 210e9       # SI units everywhere, and no unit is written
poissons_ratio = 0.3
density = 7800

[meshes.cube]
type = "box"                 # the type decides which other keys the section has
size = [0.1, 0.1, 0.1]
divisions = [4, 4, 4]

[parts.lower]                # a part is a mesh of a material, at its place
mesh = "cube"
material = "steel"

[parts.upper]
mesh = "cube"
material = "steel"
position = [0, 0, 0.1001]

[constraints.floor]
target = "lower.z_min"       # part.set: a set of the part's mesh
fixed = ["x", "y", "z"]

[contacts.between]
slave = "upper.z_min"
master = "lower.z_max"
friction = 0.3

[gravity]                    # what has no section is not there, and costs nothing
acceleration = [0, 0, -9.81]

[time]
end = 1e-3
```

- **Axes.** x runs along the rail, and wheels roll towards +x; y is lateral, with the track's centre and the wheel's
  flange towards -y; z points up. A wheel that rolls towards +x turns about +y.
- **Units.** SI: m, kg, s, N, Pa, rad. Only `scale` of a mesh read from a file converts: 0.001 for a mesh in mm.
- **Sizes.** A number beyond what its unit can be in any scene is refused, see [limits by unit](#limits-by-unit). One
  that is allowed but unusual, such as a density of 7.8 kg/m3, is taken with a warning, which names the unit that was
  probably meant.
- **Names.** Each section `[parts.NAME]`, `[materials.NAME]` and so on makes one thing, which others refer to by its
  name. A set of a part's mesh is `part.set`. `ground` is the fixed world, to which connectors may lead.
- **Command line.** `railwave run CASE --set section.key=value` replaces a value: `time.end=1e-3`,
  `parts.wheel.hourglass=stiffness`; `parts.wheel.position[1]=0.01` one entry of a list, counted from 0.
- **Editors.** An editor that knows TOML schemas (taplo, Even Better TOML) completes and checks a case whose first
  line is `#:schema ../docs/case.schema.json`.

## Sets of the built-in meshes

| mesh | node sets | surfaces | element sets |
|---|---|---|---|
)";

constexpr const char* introduction_after_sets = R"(
`tread` and `head` are where bodies usually touch: the contact band over the solution zone, and a margin around it.
`running_surface` goes all along the wheel or rail; `zone` is the solution zone; `middle` is where a half wheelset
ends, a whole one's sets are also there by halves, as `left_tread` and `right_tread`; `centre_section` is the wheel's
plane x = 0 below the axle, when a layer of nodes lies there. A mesh read from a file brings the sets that its file
names. `[node_sets.NAME]` makes more of them, of the nodes in a box or near a place, `[element_sets.NAME]` of the
elements there. A surface is a set of its nodes too.

## A track

`[tracks.NAME]` makes half a track on sleepers; what it makes has names, and the case goes on with them:

```toml
[tracks.track]
start = -5                           # x of the rail's ends
end = 5
pair_position = 0                    # two timber sleepers 0.24 m apart, concrete ones every 0.6 m beside them

[node_sets.struck]                   # a place of the rail, as track_rail.struck
part = "track_rail"
surface = "running_surface"
box = [[-0.01, -0.02, 0], [0.01, 0.02, 1]]

[output]
history_sets = ["track_rail.struck", "track_sleeper_9.z_max"]
```

## A hammer test

```toml
[hammers.mid_span]                   # struck: node set track_rail.mid_span, a load, its history
part = "track_rail"
surface = "running_surface"
position = [0, 0, 0.16]
peak = 1e3
duration = 0.2e-3                    # up to 5 kHz

[probes.row]                         # answers: track_rail.row_1 to track_rail.row_8
part = "track_rail"
surface = "running_surface"
position = [0.3, 0, 0.16]
count = 8
spacing = [0.6, 0, 0]
```

`railwave frf` makes accelerances of them, `railwave decay` the track's decay rate; [hammer.md](hammer.md) shows both.

# Sections and keys

Required keys have no default. Keys of three numbers take them along x, y, z.
)";

std::string sets_table() {
  std::string text;
  for (const auto& row : mesh_sets())
    text += fmt::format("| `{}` | {} | {} |{} |\n", row.type, row.node_sets, row.surfaces,
                        row.element_sets.empty() ? "" : " " + row.element_sets);
  return text;
}

/// Quoted choices as code, and no bar that would end a column.
std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.replace(at, 1, "\\|");
  return text;
}

std::string code_list(const std::vector<std::string>& choices) {
  std::vector<std::string> quoted;
  for (const auto& choice : choices) quoted.push_back("`\"" + choice + "\"`");
  return joined(quoted);
}

std::string value_cell(const Key& key) {
  const bool several = key.kind == Kind::texts;
  if (!key.choices.empty()) return (several ? "list of " : "one of ") + code_list(key.choices);
  if (key.refers_to != refers_to_nothing)
    return (key.may_be_one ? "name or list of names: "
            : several      ? "list of names: "
                           : "name of ") +
           reference_text(key.refers_to);
  return expectation(key, false);
}

std::string default_cell(const Key& key) {
  if (key.required) return "required";
  const auto text = default_text(key);
  if (text.empty()) return "none";
  return key.default_text.empty() ? "`" + text + "`" : text;
}

std::string table(const std::vector<Key>& keys) {
  std::string text = "\n| key | value | unit | allowed | default | meaning |\n|---|---|---|---|---|---|\n";
  for (const auto& key : keys) {
    text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", key.name, cell(value_cell(key)), key.unit,
                        range_text(key.range), cell(default_cell(key)), cell(key.help));
  }
  return text;
}

/// The keys of all types, or those that only some types have.
std::vector<Key> keys_of(const Section& section, const std::string& type) {
  std::vector<Key> keys;
  for (const auto& key : section.keys) {
    const bool wanted = type.empty() ? key.types.empty() : !key.types.empty() && key.belongs_to(type);
    if (wanted) keys.push_back(key);
  }
  return keys;
}

std::string section_text(const Section& section) {
  std::string text = "\n## " + (section.name.empty() ? "Above all sections" : "`" + section.title() + "`") + "\n";
  if (!section.name.empty())
    text += "\n" + section.help +
            (!section.required         ? ""
             : section.name == "parts" ? " Required, unless there is a track."
                                       : " Required.") +
            "\n";
  text += table(keys_of(section, ""));
  const auto* type = section.type_key();
  if (!type) return text;
  for (const auto& one : type->choices) {
    const auto keys = keys_of(section, one);
    if (!keys.empty()) text += "\n### `type = \"" + one + "\"`\n" + table(keys);
  }
  return text;
}

}  // namespace

std::string case_reference_markdown() {
  std::string text = introduction + sets_table() + introduction_after_sets;
  for (const auto& section : sections()) text += section_text(section);
  return text +
         "\n# Limits by unit\n\nBesides what the tables above allow, for every key that has the unit; those of "
         "`[monitor]` may be larger.\n\n" +
         unit_limits_markdown();
}

}  // namespace railwave
