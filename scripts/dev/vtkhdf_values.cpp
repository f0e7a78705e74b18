// What VTK's own reader makes of a VTKHDF file, for scripts/dev/check_vtkhdf: VTKHDF_VALUES FILE FOLDER writes the
// numbers of each array into a file of the folder, and prints the steps' times and the arrays' names and sizes.
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkUnstructuredGrid.h>

#include <fstream>
#include <iostream>
#include <string>

#include "vtkHDFReader.h"

namespace {

/// Folder and step: where the numbers go, and the first words of each line.
struct Place {
  std::string folder;
  int step;
};

void write(const Place& place, const std::string& name, vtkDataArray* array) {
  std::ofstream out(place.folder + "/" + std::to_string(place.step) + "." + name, std::ios::binary);
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    for (int c = 0; c < array->GetNumberOfComponents(); ++c) {
      const double value = array->GetComponent(i, c);
      out.write(reinterpret_cast<const char*>(&value), sizeof value);
    }
  std::cout << "array " << place.step << ' ' << name << ' ' << array->GetNumberOfTuples() << ' '
            << array->GetNumberOfComponents() << '\n';
}

void write(const Place& place, const std::string& kind, vtkDataSetAttributes* arrays) {
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
    write(place, kind + "." + arrays->GetArrayName(i), arrays->GetArray(i));
}

/// A line for each: its type, then its points.
void write_cells(const Place& place, vtkUnstructuredGrid* grid) {
  std::ofstream out(place.folder + "/" + std::to_string(place.step) + ".cells");
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
    out << grid->GetCellType(c);
    for (vtkIdType k = 0; k < grid->GetCell(c)->GetNumberOfPoints(); ++k) out << ' ' << grid->GetCell(c)->GetPointId(k);
    out << '\n';
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  vtkNew<vtkHDFReader> reader;
  if (!reader->CanReadFile(argv[1])) {
    std::cerr << "vtkHDFReader cannot read " << argv[1] << '\n';
    return 1;
  }
  reader->SetFileName(argv[1]);
  reader->UpdateInformation();
  vtkInformation* about = reader->GetOutputInformation(0);
  vtkInformationDoubleVectorKey* times = vtkStreamingDemandDrivenPipeline::TIME_STEPS();
  const int steps = about->Has(times) ? about->Length(times) : 0;
  std::cout.precision(17);
  for (int k = 0; k < (steps > 0 ? steps : 1); ++k) {
    if (steps > 0)
      reader->UpdateTimeStep(about->Get(times, k));
    else
      reader->Update();
    auto* grid = vtkUnstructuredGrid::SafeDownCast(reader->GetOutputDataObject(0));
    if (grid == nullptr) return 1;
    if (steps > 0) std::cout << "time " << about->Get(times, k) << '\n';
    const Place place{argv[2], k};
    write(place, "points", grid->GetPoints()->GetData());
    write(place, "point", grid->GetPointData());
    write(place, "cell", grid->GetCellData());
    write_cells(place, grid);
  }
}
