#include "commands/import.hpp"

#include <fmt/format.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>

#include "case/activity.hpp"
#include "case/error.hpp"
#include "case/read_case.hpp"
#include "commands/threads.hpp"
#include "deck/import_deck.hpp"
#include "model/assembly.hpp"
#include "model/model.hpp"
#include "output/atomic_file.hpp"
#include "output/output_place.hpp"

namespace railwave {
namespace {

namespace fs = std::filesystem;
using Form = FileKind::Form;

FileKind mesh_kind() { return {Form::text, "a mesh of 'railwave import'", deck::imported_mesh_mark, ""}; }
FileKind report_kind() { return {Form::text, "a report of 'railwave import'", deck::imported_report_mark, ""}; }
/// People go on with a case in an editor: none is replaced, unless it is the same to the letter.
FileKind case_kind() { return {Form::text, "a case that may be replaced", "\n\n\n<no case has this>", ""}; }

struct ImportFiles {
  std::string text, mesh, report;
};

ImportFiles files_of(const ImportRequest& request) {
  const fs::path text =
      request.out.empty() ? fs::path(request.deck).filename().replace_extension(".toml") : fs::path(request.out);
  fs::path mesh = text, report = text;
  mesh.replace_extension(".inp");
  // Beside an Abaqus input of that name.
  std::error_code ignored;
  if (fs::weakly_canonical(mesh, ignored) == fs::weakly_canonical(request.deck, ignored))
    mesh.replace_filename(text.stem().string() + "_mesh.inp");
  return {text.string(), mesh.string(), report.replace_extension(".import.txt").string()};
}

bool holds(const std::string& path, const std::string& text) {
  std::error_code trouble;
  if (!fs::is_regular_file(path, trouble) || fs::file_size(path, trouble) != text.size()) return false;
  std::ifstream file(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(file), {}) == text;
}

/// A folder of its own for as long as this lives.
struct PassingFolder {
  std::string path = (fs::temp_directory_path() / "railwave-import-XXXXXX").string();
  PassingFolder() {
    if (mkdtemp(path.data()) == nullptr)
      throw std::runtime_error(fmt::format("no folder can be made in {}; see whether it may be written",
                                           fs::temp_directory_path().string()));
  }
  ~PassingFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  std::string write(const std::string& name, const std::string& text) const {
    const std::string file = path + "/" + name;
    std::ofstream out(file, std::ios::binary);
    if (!(out << text) || !out.flush())
      throw std::runtime_error(fmt::format("{} cannot be written; free room there", file));
    return file;
  }
};

/// Refuses a deck whose case would be refused: as `railwave check` does, but for what concerns its results.
/// @return warnings and notes
std::vector<std::string> try_case(const ImportFiles& files, const deck::Import& import, const std::string& deck) {
  const Activity checking("checking the case of " + deck);
  const PassingFolder folder;
  folder.write(fs::path(files.mesh).filename().string(), import.mesh);
  const std::string path = folder.write(fs::path(files.text).filename().string(), import.text);
  std::vector<std::string> notes;
  try {
    const scene::Scene scene = read_case(path, {}, &notes);
    const KokkosScope kokkos;
    Model model;
    build_model(scene, assemble(scene, notes), model);
  } catch (const InputError& error) {
    std::string said = error.what();
    for (auto at = said.find(folder.path + "/"); at != std::string::npos; at = said.find(folder.path + "/"))
      said.erase(at, folder.path.size() + 1);
    throw InputError(fmt::format("{}: its case would be refused, so nothing was written: {}", deck, said));
  }
  for (std::string& note : notes)
    for (auto at = note.find(folder.path + "/"); at != std::string::npos; at = note.find(folder.path + "/"))
      note.erase(at, folder.path.size() + 1);
  return notes;
}

}  // namespace

void add_import_command(CLI::App& app, ImportRequest& request, const std::function<void()>& run) {
  CLI::App* command =
      app.add_subcommand("import", "make a mesh and a case of an LS-DYNA keyword deck or an Abaqus input");
  command
      ->add_option("deck", request.deck,
                   "keyword deck (.k, .key, .dyn ...) or Abaqus input (.inp); docs/decks.md lists their keywords")
      ->required();
  command->add_option("--out", request.out,
                      "case file to write; its mesh (.inp) and a report (.import.txt), line by line what was taken, "
                      "replaced and dropped, lie beside it; default: the deck's name with .toml, in this folder");
  command->add_option("--units", request.units,
                      "the deck's units of length, mass and time, such as mm,t,s; default: SI, if its materials can be "
                      "in these");
  command
      ->add_option(
          "--drop", request.drop,
          "leave out a keyword that is refused, such as MAT_ADD_EROSION, or a part of one, such as CONTACT.BT; "
          "may be repeated")
      ->allow_extra_args(false);
  command->add_flag("--overwrite", request.overwrite,
                    "replace files that are there even if railwave has not written them; never what the command reads");
  command->callback(run);
}

void import_command(const ImportRequest& request, std::ostream& out) {
  const ImportFiles files = files_of(request);
  const auto check = [&](const std::string& text) {
    if (holds(files.text, text)) give(files.text);
    OutputPlaces places(request.overwrite);
    places.reads(request.deck, "the deck");
    places.writes(files.text, case_kind(), "--out", "the case file");
    places.writes(files.mesh, mesh_kind(), "--out", "the mesh of the case");
    places.writes(files.report, report_kind(), "--out", "the report of the import");
    places.check();
  };
  deck::ImportOptions options;
  options.units = request.units;
  options.drop = request.drop;
  options.mesh_file = fs::path(files.mesh).filename().string();
  const Activity reading("reading " + request.deck);
  const deck::Import import = deck::import_deck(request.deck, options);
  check(import.text);
  const auto notes = try_case(files, import, request.deck);
  write_whole_file(files.mesh, import.mesh, mesh_kind());
  write_whole_file(files.report, import.report, report_kind());
  write_whole_file(files.text, import.text, case_kind());
  for (const auto* some : {&import.notes, &notes})
    for (const std::string& note : *some) out << "note: " << note << '\n';
  out << files.text << ": " << import.parts << (import.parts == 1 ? " part, " : " parts, ") << import.elements
      << " hexahedra in " << files.mesh << '\n'
      << files.report << ": " << import.taken << " entries taken, " << import.replaced << " replaced, "
      << import.dropped << " dropped\n"
      << "Look through that report, then: railwave check " << files.text << '\n';
}

}  // namespace railwave
